#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <streambuf>
#include <string>

#include "algebra3d/base/error.h"
#include "base/input_file.h"

namespace algebra3d {

/// A buffer of a std::istream over a file, pipe, terminal or device whose waiting for bytes can be ended: by a flag,
/// whichever thread gets the signal that sets it. Then the stream ends, as at the end of the file.
class PolledInput : public std::streambuf {
 public:
  /// Opens a file; of a named pipe it waits for a writer when it is read, not here. `cancel` may be null, and outlives
  /// the object. Errors: file_missing, with the system's reason.
  static Result<Descriptor> open(const std::filesystem::path& path);

  /// Reads a descriptor, which stays open.
  PolledInput(int descriptor, const std::atomic<bool>* cancel) : descriptor_(descriptor), cancel_(cancel) {}

  /// Whether the stream has ended because of the flag.
  bool is_interrupted() const { return is_interrupted_; }
  /// All that follows, up to `limit` bytes. Errors: interrupted; limit_exceeded; io_error. `name` is for messages.
  Result<std::string> read_all(std::size_t limit, const std::string& name);

 protected:
  int_type underflow() override;

 private:
  bool fill();

  int descriptor_;
  const std::atomic<bool>* cancel_;
  bool is_interrupted_ = false;
  int error_ = 0;
  std::array<char, std::size_t{1} << 16U> buffer_;  // NOLINT(cppcoreguidelines-pro-type-member-init): read into
};

}  // namespace algebra3d
