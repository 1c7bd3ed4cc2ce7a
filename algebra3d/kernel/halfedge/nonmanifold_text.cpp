#include "algebra3d/kernel/halfedge/nonmanifold_text.h"

#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace algebra3d {
namespace {

std::string counted(std::size_t count, const char* what, const char* plural) {
  return fmt::format("{} {}", count, count == 1 ? what : plural);
}

}  // namespace

std::string nonmanifold_text(const PolygonMesh& mesh) {
  std::string text;
  if (const std::size_t count = mesh.nonmanifold_edge_count(); count > 0) {
    const HalfedgeId first = mesh.nonmanifold_edge(0).front();
    text =
        fmt::format("{} (first between vertices {} and {})", counted(count, "non-manifold edge", "non-manifold edges"),
                    mesh.origin(first).index(), mesh.target(first).index());
  }
  if (const std::vector<VertexId> found = mesh.nonmanifold_vertices(); !found.empty())
    text += fmt::format("{}{} (first {})", text.empty() ? "" : " and ",
                        counted(found.size(), "non-manifold vertex", "non-manifold vertices"), found[0].index());
  return text;
}

}  // namespace algebra3d
