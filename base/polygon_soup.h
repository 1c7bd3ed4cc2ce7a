#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/base/vec3.h"
#include "base/soup_attributes.h"

namespace algebra3d {

/// The points and polygons of a mesh file, in the order of the file (corners counter-clockwise seen from outside, if
/// the file is correct). Nothing is assumed of the shapes: corners may repeat or be collinear, polygons may be
/// non-planar or self-intersecting, points may be equal or unused. Invariants, which readers keep and writers check:
/// coordinates are finite; `face_starts` begins with 0, ascends, and ends with the number of corners; every corner is
/// the index of a point.
struct PolygonSoup {
  std::vector<Vec3> points;
  /// Per face: the index of its first corner; and the number of corners at the end.
  std::vector<std::uint32_t> face_starts = {0};
  /// Indices of points, face by face.
  std::vector<std::uint32_t> corners;
  /// Name of the first object, as written; may be empty.
  std::string name;
  /// Attributes of corners and faces, if they were asked for and the file has some; else null.
  std::shared_ptr<const SoupAttributes> attributes = nullptr;

  [[nodiscard]] std::size_t face_count() const { return face_starts.size() - 1; }
  /// The corners of a face, at least 3 in soups from readers. Cost: constant.
  [[nodiscard]] std::span<const std::uint32_t> face(std::size_t index) const {
    assert(index < face_count());
    return {corners.data() + face_starts[index], corners.data() + face_starts[index + 1]};
  }
  /// Domain: the corners of all faces together are fewer than 2^32.
  void add_face(std::span<const std::uint32_t> face_corners) {
    corners.insert(corners.end(), face_corners.begin(), face_corners.end());
    face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

}  // namespace algebra3d
