#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/context.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/temporary_file.h"

namespace algebra3d {
class ByteReader;
}

namespace queries {

/// A temporary file of tuples of one type, written in order and read from any position. Small values are written;
/// deferred values stay deferred. A tuple that is read equals the appended one, with its id. Shared by its writer and
/// readers while their statement runs.
class TupleFile : public std::enable_shared_from_this<TupleFile> {
 public:
  class Scan;

  /// Creates the file in the folder of the context's work memory. Errors: disk_full, io_error.
  static Result<std::shared_ptr<TupleFile>> make(const algebra3d::Context& context);
  TupleFile(const TupleFile&) = delete;
  TupleFile& operator=(const TupleFile&) = delete;

  Status append(const Tuple& tuple);
  /// The position where the next tuple will begin.
  std::uint64_t end() const { return file_->size() + unwritten_.size(); }
  /// A stream of the tuples from `begin` up to `end`; both are ends of tuples or 0.
  std::shared_ptr<Scan> scan(std::uint64_t begin, std::uint64_t end);

  /// Buffer size of a scan and of writing.
  static constexpr std::size_t kBufferBytes = std::size_t{32} * 1024;

 private:
  explicit TupleFile(std::unique_ptr<TemporaryFile> file) : file_(std::move(file)) {}
  void append_value(const Value& value);
  void append_deferred(const algebra3d::DeferredValue& value);
  Status flush();

  std::unique_ptr<TemporaryFile> file_;
  std::string unwritten_;
  std::vector<const algebra3d::Type*> types_;  // of the attributes, from the first tuple
  std::vector<std::shared_ptr<const algebra3d::DeferredSource>> sources_;
};

/// Reads forward through a buffer.
class TupleFile::Scan final : public TupleStream {
 public:
  Scan(std::shared_ptr<TupleFile> file, std::uint64_t begin, std::uint64_t end)
      : file_(std::move(file)), next_(begin), end_(end) {}
  Result<TuplePtr> next() override;
  /// The position where the next tuple begins.
  std::uint64_t position() const { return next_; }
  /// The tuple that begins at a position; `next` goes on behind it. Cost: that of reading a few kilobytes, unless it
  /// was read with the tuple before.
  Result<TuplePtr> at(std::uint64_t position);

 private:
  Result<std::string_view> bytes(std::uint64_t count);
  Status refill(std::uint64_t count);
  Result<Value> read_value(const algebra3d::Type& type, algebra3d::ByteReader& reader) const;

  std::shared_ptr<TupleFile> file_;
  std::uint64_t next_;  // position of the next tuple
  std::uint64_t end_;
  std::string buffer_;
  std::size_t position_ = 0;
  std::size_t read_ahead_ = kBufferBytes;
};

}  // namespace queries
