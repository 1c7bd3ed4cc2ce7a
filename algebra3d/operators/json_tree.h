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

/// A JSON text, taken apart. Each part is a stretch of the text, which is not copied and must outlive the tree: so
/// numbers keep their digits, members their order, and 32 bytes per part are all that is kept. Parts are named by their
/// index; part 0 is the whole. The parts of an array are its elements; those of an object a key, its value, and so on:
///   for (std::size_t part = tree.first(array); part != tree.end(array); part = tree.after(part))
/// Const members may be called by several threads at once.
class JsonTree {
 public:
  static constexpr std::size_t kWholeDepth = std::numeric_limits<std::size_t>::max();

  /// Takes apart what is nested at most `depth` deep; arrays and objects at that depth look empty. All of the text is
  /// checked whatever the depth. Domain: any bytes, nested as deep as they may be: nothing is recursive.
  /// Errors: file_format, "line 3, byte 57: ..." (both from 1) with what was found and expected; interrupted.
  /// Cost: linear. Source: [rfc8259]; the syntax is checked by nlohmann-json.
  static Result<JsonTree> parse(std::string_view text, std::size_t depth = kWholeDepth, const Monitor& monitor = {});

  JsonKind kind(std::size_t part) const { return parts_[part].kind; }
  /// Where in the text the part begins, in bytes from 0.
  std::size_t begin(std::size_t part) const { return parts_[part].begin; }
  /// As it is written, keys and strings with their quotes.
  std::string_view text(std::size_t part) const {
    return text_.substr(parts_[part].begin, parts_[part].end - parts_[part].begin);
  }

  static std::size_t first(std::size_t part) { return part + 1; }
  std::size_t end(std::size_t part) const { return parts_[part].next; }
  std::size_t after(std::size_t part) const { return parts_[part].next; }

  /// The value of that key in an object, the last one if there are several; nothing in anything else.
  std::optional<std::size_t> member(std::size_t part, std::string_view key) const;
  /// The same if it is of that kind.
  std::optional<std::size_t> member(std::size_t part, std::string_view key, JsonKind kind) const;
  /// What a key or string says, without quotes and escapes.
  std::string content(std::size_t part) const;

 private:
  friend class JsonTreeMaker;
  struct Part {
    std::size_t begin = 0, end = 0;  // in the text
    std::size_t next = 0;            // the part after this one and all parts of it
    JsonKind kind = JsonKind::null;
  };

  std::string_view text_;
  std::vector<Part> parts_;
};

/// The same JSON without white space between its parts.
std::string compact_json(std::string_view json);

}  // namespace algebra3d
