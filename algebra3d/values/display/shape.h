#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"
#include "base/indices.h"
#include "base/large_allocator.h"

namespace algebra3d {

/// The drawing of a value: vertices, and triangles, lines and points of them, as a graphics card takes them.
/// Positions are floats relative to an origin, so that shapes far from zero keep their form; they and the normals are
/// for the eye, never for decisions. The fields are those of docs/http-api.md, "Shapes".
struct DrawnShape {
  using Position = std::array<float, 3>;
  /// A direction times 127, rounded; the fourth number fills up to four bytes.
  using Normal = std::array<std::int8_t, 4>;
  using Line = std::array<std::uint32_t, 2>;

  std::string kind;                  ///< name of the type of the value
  Box3 box;                          ///< of the value; empty if there is nothing to draw
  std::uint64_t triangle_count = 0;  ///< of the value, also where fewer are shown
  Vec3 origin;                       ///< the middle of the box

  LargeVector<Position> positions;
  LargeVector<Normal> normals;           ///< per position; empty without triangles
  LargeVector<IndexTriangle> triangles;  ///< counter-clockwise seen from the front
  LargeVector<Line> edges;               ///< between two faces; of solids and surfaces only those that are not coplanar
  LargeVector<Line> boundary;            ///< edges with one face
  LargeVector<Line> nonmanifold;         ///< edges that are neither
  LargeVector<Line> lines;               ///< of boxes, vectors and planes, outlines of regions
  LargeVector<std::uint32_t> points;     ///< positions that are drawn as points

  LargeVector<std::uint32_t> face_ids;    ///< per triangle: the face of the value; empty if the triangle's own number
  LargeVector<std::uint32_t> vertex_ids;  ///< per position: the vertex of the value; empty if the position's own number
  LargeVector<std::byte> tree;            ///< of the triangles (triangle_tree.h); may be empty
  std::optional<double> deviation;        ///< of a coarser level: no vertex was moved farther than this

  bool is_empty() const { return positions.empty(); }
};

/// Bytes of the arrays of a shape.
std::size_t content_bytes(const DrawnShape& shape);

}  // namespace algebra3d
