// corpus_oracle FILE... [--largest TRIANGLES]: unites, intersects and subtracts each of the STL files and its
// neighbour, turned by an irrational angle, and asks CGAL's polygon mesh processing, with exact coordinates, whether
// the results are closed, free of self-intersections and bound a volume (support/cgal_verdict.h). Pairs with more
// triangles than the largest number are left out, and counted.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/repair/solid_from_soup.h"
#include "algebra3d/kernel/validity/validity.h"
#include "stl/stl_reader.h"
#include "support/cgal_verdict.h"

namespace {

using namespace algebra3d;

std::optional<TriangleMesh> solid_of(const std::filesystem::path& path) {
  const auto file = mesh_formats::read_stl_file(path);
  if (!file.ok()) return std::nullopt;
  auto solid = solid_from_soup(file->soup);
  if (!solid.ok()) return std::nullopt;
  return std::move(solid->mesh);
}

Box3 bounds_of(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3& p : mesh.points().approx()) box.extend(p);
  return box;
}

TriangleMesh mapped(const TriangleMesh& mesh, const AffineMap& map) {
  PointArray points;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) points.push_back(map.apply_rounded(mesh.points()[i]));
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  return {std::move(points), triangles};
}

/// Turned, brought to the size of the other one, and moved into it.
TriangleMesh moved_into(const TriangleMesh& mesh, const TriangleMesh& other) {
  const Box3 from = bounds_of(mesh), to = bounds_of(other);
  const auto size = [](const Box3& box) { return std::sqrt(dot(box.max - box.min, box.max - box.min)); };
  const RationalVec3 centre(0.5 * (from.min + from.max)), target(0.5 * (to.min + to.max));
  const RationalVec3 axis(Vec3{1, std::sqrt(2.0), std::sqrt(3.0)});
  const Rational factor(size(to) / size(from));
  return mapped(mesh, AffineMap::rotation(centre, axis, 37.7)
                          ->then(AffineMap::scaling(centre, RationalVec3(factor, factor, factor)))
                          .then(AffineMap::translation(target - centre)));
}

struct Operation {
  const char* name;
  KeepRule rule;
};

const std::array<Operation, 3> kOperations{
    {{"union", [](const WindingVector& h) { return h[0] + h[1] > 0; }},
     {"intersection", [](const WindingVector& h) { return h[0] > 0 && h[1] > 0; }},
     {"difference", [](const WindingVector& h) { return h[0] > 0 && h[1] == 0; }}}};

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> files;
  std::size_t largest = SIZE_MAX;
  for (int i = 1; i < count; ++i) {
    if (std::string_view(arguments[i]) == "--largest" && i + 1 < count)
      largest = std::strtoull(arguments[++i], nullptr, 10);
    else
      files.emplace_back(arguments[i]);
  }
  std::vector<std::pair<std::string, TriangleMesh>> solids;
  for (const std::string& file : files)
    if (auto solid = solid_of(file); solid && !solid->is_empty()) solids.emplace_back(file, *std::move(solid));
  std::size_t passed = 0, failed = 0, left_out = 0;
  for (std::size_t i = 0; i + 1 < solids.size(); ++i) {
    const auto& [first_name, first] = solids[i];
    const auto& [second_name, given] = solids[i + 1];
    if (first.face_count() + given.face_count() > largest) {
      ++left_out;
      continue;
    }
    const TriangleMesh second = moved_into(given, first);
    if (!prove_volume(second)->is_valid()) {
      ++left_out;  // rounding broke it: no operand
      continue;
    }
    const std::array<Operand, 2> operands{{{&first, 0}, {&second, 1}}};
    for (const auto& [name, rule] : kOperations) {
      const auto result = combine_solids(operands, rule);
      const std::string text = result.ok() ? oracle::complaint(*result) : result.error().message;
      text.empty() ? ++passed : ++failed;
      if (!text.empty())
        std::printf("%s and %s, %s: %s\n", first_name.c_str(), second_name.c_str(), name, text.c_str());
      std::fflush(stdout);
    }
  }
  std::printf("%zu passed, %zu failed, %zu pairs left out\n", passed, failed, left_out);
  return failed == 0 ? 0 : 1;
}
