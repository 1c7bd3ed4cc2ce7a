#include "mesh_files/mesh_content.h"

#include <limits>

#include <fmt/format.h>

#include "algebra3d/base/text.h"

namespace mesh_files {
namespace {

// Programs that write while they do not know the count yet leave 0 or the largest number; these say nothing.
bool is_placeholder(std::uint64_t count) {
  return count == 0 || count == std::numeric_limits<std::uint32_t>::max() ||
         count == std::numeric_limits<std::int32_t>::max();
}

}  // namespace

std::string WrongCount::text() const {
  if (missing_ends > 0)
    return fmt::format("missing endsolid{}: the file may be cut short",
                       missing_ends == 1 ? "" : fmt::format(" in {} solids", missing_ends));
  if (trailing_bytes > 0)
    return fmt::format("wrong count: header announces {}, after which {}", algebra3d::counted(announced, "triangle"),
                       trailing_bytes == 1 ? "1 byte follows" : fmt::format("{} bytes follow", trailing_bytes));
  return fmt::format("wrong count: header announces {}, file has {}{}{}", algebra3d::counted(announced, "triangle"),
                     read == by_size ? "" : "room for ", by_size,
                     announced > by_size && !is_placeholder(announced) ? ", and may be cut short" : "");
}

}  // namespace mesh_files
