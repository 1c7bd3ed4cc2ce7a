#include "algebra3d/kernel/soup/weld.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "algebra3d/kernel/exact/point_table.h"
#include "base/interruption_scope.h"

namespace algebra3d {
namespace {

/// Corners of a few triangles: their hashes are known, and their slots on the way from memory, before they are looked
/// up.
constexpr std::size_t kBlock = 32;

}  // namespace

WeldedTriangles weld(std::span<const TriangleSoup::Triangle> triangles) {
  assert(triangles.size() <= TriangleMesh::kMaxFaces);
  // A closed mesh has half as many points as triangles; a soup without common corners grows the table.
  PointTable table(triangles.size() / 2);
  WeldedTriangles result;
  result.triangles.resize(triangles.size());
  std::array<Vec3, 3 * kBlock> corners;
  std::array<std::uint64_t, 3 * kBlock> hashes{};
  for (std::size_t start = 0; start < triangles.size(); start += kBlock) {
    poll_interruption();
    const std::size_t count = std::min(kBlock, triangles.size() - start);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const Vec3& corner = triangles[start + i / 3][i % 3];
      // -0 + 0 is 0 when rounding to nearest; all other values stay.
      corners[i] = {corner.x + 0.0, corner.y + 0.0, corner.z + 0.0};
      hashes[i] = hash_of(corners[i]);
      table.prefetch(hashes[i]);
    }
    for (std::size_t i = 0; i < 3 * count; ++i)
      result.triangles[start + i / 3][i % 3] = table.intern(PointRef(corners[i]), hashes[i]);
  }
  result.points = PointArray(std::move(table).take_doubles());
  return result;
}

WeldedTriangles weld(std::span<const Vec3> points, std::span<const TriangleMesh::Triangle> triangles) {
  std::vector<TriangleSoup::Triangle> soup;
  soup.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) soup.push_back({points[a], points[b], points[c]});
  return weld(soup);
}

WeldedTriangles weld(std::span<const std::array<ExactPoint, 3>> triangles) {
  assert(triangles.size() <= TriangleMesh::kMaxFaces);
  PointTable table;
  WeldedTriangles result;
  result.triangles.reserve(triangles.size());
  for (const auto& corners : triangles) {
    poll_interruption();
    TriangleMesh::Triangle& triangle = result.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = table.intern(corners[i].ref());
      if (triangle[i] == result.points.size()) result.points.push_back(corners[i]);
    }
  }
  return result;
}

}  // namespace algebra3d
