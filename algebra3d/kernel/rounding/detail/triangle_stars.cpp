#include "algebra3d/kernel/rounding/detail/triangle_stars.h"

#include <utility>

namespace algebra3d {

TriangleStars::TriangleStars(const TriangleMesh& mesh) : mesh_(mesh), list_of_(mesh.vertex_count(), kNone) {
  triangles_.reserve(mesh.face_count());
  for (const FaceId face : faces(mesh)) triangles_.push_back(mesh.triangle(face));
}

std::vector<std::uint32_t> TriangleStars::at(std::uint32_t vertex) const {
  std::vector<std::uint32_t> star;
  for_each_at(vertex, [&](std::uint32_t triangle) { star.push_back(triangle); });
  return star;
}

std::vector<std::uint32_t>& TriangleStars::list(std::uint32_t vertex) {
  if (list_of_[vertex] == kNone) {
    lists_.push_back(at(vertex));
    list_of_[vertex] = static_cast<std::uint32_t>(lists_.size() - 1);
  }
  return lists_[list_of_[vertex]];
}

void TriangleStars::merge(std::uint32_t vertex, std::uint32_t target) {
  std::vector<std::uint32_t>& grown = list(target);
  for_each_at(vertex, [&](std::uint32_t triangle) {
    IndexTriangle& t = triangles_[triangle];
    if (std::ranges::find(t, target) != t.end()) {
      t = {kNone, kNone, kNone};
    } else {
      std::ranges::replace(t, vertex, target);
      grown.push_back(triangle);
    }
  });
}

void TriangleStars::flip(std::uint32_t first, std::uint32_t c, std::uint32_t second, std::uint32_t d) {
  list(c).push_back(second);
  list(d).push_back(first);
  IndexTriangle& t = triangles_[first];
  const auto i = static_cast<std::size_t>(std::ranges::find(t, c) - t.begin());
  const std::uint32_t a = t[(i + 1) % 3], b = t[(i + 2) % 3];
  t = {c, a, d};
  triangles_[second] = {d, b, c};
}

std::vector<std::uint32_t> TriangleStars::unchanged() const {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(triangles_.size());
  for (std::uint32_t t = 0; t < size(); ++t)
    if (triangles_[t][0] != kNone) numbers.push_back(triangles_[t] == mesh_.triangle(FaceId(t)) ? t : kNone);
  return numbers;
}

TriangleMesh TriangleStars::mesh() const {
  PointArray points;
  std::vector<std::uint32_t> numbers(mesh_.vertex_count(), kNone);
  std::vector<IndexTriangle> triangles;
  for (IndexTriangle t : triangles_) {
    if (t[0] == kNone) continue;
    for (std::uint32_t& corner : t) {
      if (numbers[corner] == kNone) {
        numbers[corner] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh_.points()[corner]);
      }
      corner = numbers[corner];
    }
    triangles.push_back(t);
  }
  return {std::move(points), triangles};
}

}  // namespace algebra3d
