#include "algebra3d/values/types/detail/polygons_codec.h"

#include <utility>
#include <vector>

#include "algebra3d/values/types/detail/codec_points.h"

namespace algebra3d {

namespace {

/// How many each part has, from where each ends.
void write_counts(ByteWriter& writer, const std::vector<std::uint32_t>& ends) {
  writer.varint(ends.size());
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) writer.varint(end - std::exchange(begin, end));
}

/// Ends at `total`.
std::vector<std::uint32_t> read_counts(ByteReader& reader, std::uint64_t smallest, std::uint64_t total) {
  std::vector<std::uint32_t> ends(reader.count(1));
  std::uint64_t end = 0;
  for (std::uint32_t& place : ends) {
    const std::uint64_t count = reader.varint();
    if (count < smallest || count > total - end) {
      reader.fail("cycles and faces that fit the corners");
      return {};
    }
    end += count;
    place = static_cast<std::uint32_t>(end);
  }
  reader.require(end == total, "cycles and faces that fit the corners");
  return ends;
}

}  // namespace

void write_polygons(ByteWriter& writer, const Polygons& polygons) {
  write_points(writer, polygons.corners);
  write_counts(writer, polygons.cycle_ends);
  write_counts(writer, polygons.face_ends);
}

Polygons read_polygons(ByteReader& reader) {
  Polygons polygons;
  polygons.corners = read_points(reader);
  polygons.cycle_ends = read_counts(reader, 3, polygons.corners.size());
  polygons.face_ends = read_counts(reader, 1, polygons.cycle_ends.size());
  return polygons;
}

bool is_in_plane(const PointArray& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].approx.z != 0 || points[i].coordinate(2).sign() != 0) return false;
  return true;
}

}  // namespace algebra3d
