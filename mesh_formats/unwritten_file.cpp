#include "mesh_formats/unwritten_file.h"

#include <optional>
#include <string>

#include "base/propagate.h"
#include "base/text.h"
#include "mesh_formats/off/off_header.h"
#include "stl/stl_binary_reader.h"
#include "stl/stl_reader.h"

namespace mesh_formats {

using algebra3d::counted;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::InputFile;
using algebra3d::Status;

namespace {

/// Less than this is read: the zeros are facets without area, which are reported, or a format error.
constexpr std::uint64_t kMostUnwritten = std::uint64_t{1} << 20;
constexpr std::size_t kHeadBytes = 1024;

/// The number of facets that the header of a binary STL file announces; nothing for any other file.
std::optional<std::size_t> announced_in(std::string_view head) {
  if (head.size() < kBinaryPrefixBytes || off_header(head)) return std::nullopt;
  const auto format = detect_encoding(head, head.size(), "");
  if (!format || *format != Encoding::binary) return std::nullopt;
  return announced_facet_count(head);
}

}  // namespace

Status refuse_unwritten(const InputFile& file) {
  if (file.hole_bytes(kMostUnwritten) < kMostUnwritten) return {};
  const std::uint64_t holes = file.hole_bytes(file.size());
  A3D_ASSIGN(const std::string head, file.head(kHeadBytes));
  std::string announced;
  if (const auto count = announced_in(head))
    announced = fmt::format("header announces {} ({} bytes), ", counted(*count, "triangle"),
                            kBinaryPrefixBytes + *count * kBinaryFacetBytes);
  return Error{ErrorCode::file_format, "{}file has {} bytes, of which {} were never written (it is sparse)", announced,
               file.size(), holes}
      .about(file.path().string());
}

}  // namespace mesh_formats
