#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace queries {

// The binary format of COPY (chapter "COPY" of PostgreSQL's manual): a signature, flags and an extension; rows, each
// the number of its fields and for each field its length, or -1 for NULL, and its bytes; and -1 at the end. Numbers are
// big-endian.

/// Appends the lowest `size` bytes of a number.
void append_big_endian(std::string& bytes, std::uint64_t number, std::size_t size);
/// The number of up to eight bytes.
std::uint64_t big_endian(std::string_view bytes);

std::string_view copy_beginning();
std::string_view copy_end();
void append_copy_row(std::string& bytes, const std::vector<std::optional<std::string>>& fields);

/// Takes rows apart that a server sends, each whole in a message. Errors: database_corrupt.
class CopyReader {
 public:
  using Fields = std::vector<std::optional<std::string_view>>;

  /// `field_count`: of each row.
  explicit CopyReader(std::size_t field_count) : fields_(field_count) {}

  /// The fields of the row in a message, which are valid as long as its bytes; nothing if it has none.
  algebra3d::Result<const Fields*> take(std::string_view message);

 private:
  bool has_begun_ = false;
  bool has_ended_ = false;
  Fields fields_;
};

}  // namespace queries
