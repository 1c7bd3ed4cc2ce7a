#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d {

enum class JsonKind : std::uint8_t { object, array, key, string, number, boolean, null };

/// How errors give places in a JSON text.
struct JsonPlaces {
  std::size_t first_line = 1;  ///< the line in which the text begins
  bool has_bytes = true;       ///< whether the byte is given, too
};

/// A parsed JSON text. Each part is a range of the text, which is not copied and must outlive the tree: so numbers keep
/// their digits and members their order. Memory: 32 bytes per part. Parts are identified by their index; part 0 is the
/// whole. The parts of an array are its elements; those of an object are alternately keys and values:
///   for (std::size_t part = tree.first(array); part != tree.end(array); part = tree.after(part))
/// Concurrent calls of const members are safe.
class JsonTree {
 public:
  static constexpr std::size_t kWholeDepth = std::numeric_limits<std::size_t>::max();

  /// Parses a text up to nesting `depth`; arrays and objects at that depth look empty, but all of the text is checked.
  /// Domain: any bytes, of any nesting; no recursion. Errors: file_format with what was found and expected, about
  /// "line 3, byte 57" (both from 1); interrupted. Cost: linear. Source: [rfc8259]; nlohmann-json checks the syntax.
  static Result<JsonTree> parse(std::string_view text, std::size_t depth = kWholeDepth, const Monitor& monitor = {},
                                const JsonPlaces& places = {});

  JsonKind kind(std::size_t part) const { return parts_[part].kind; }
  /// The offset of the part in the text, in bytes.
  std::size_t begin(std::size_t part) const { return parts_[part].begin; }
  /// The text of a part, keys and strings with their quotes.
  std::string_view text(std::size_t part) const {
    return text_.substr(parts_[part].begin, parts_[part].end - parts_[part].begin);
  }

  static std::size_t first(std::size_t part) { return part + 1; }
  std::size_t end(std::size_t part) const { return parts_[part].next; }
  std::size_t after(std::size_t part) const { return parts_[part].next; }

  /// The value of a key in an object, the last one of several; nothing for other parts.
  std::optional<std::size_t> member(std::size_t part, std::string_view key) const;
  /// The value of a key, if it has this kind.
  std::optional<std::size_t> member(std::size_t part, std::string_view key, JsonKind kind) const;
  /// The content of a key or string, without quotes and escapes.
  std::string content(std::size_t part) const;

 private:
  friend class JsonTreeMaker;
  struct Part {
    std::size_t begin = 0, end = 0;  // in the text
    std::size_t next = 0;            // the part after this one and its parts
    JsonKind kind = JsonKind::null;
  };

  std::string_view text_;
  std::vector<Part> parts_;
};

/// The JSON text without white space between its parts.
std::string compact_json(std::string_view json);

}  // namespace algebra3d
