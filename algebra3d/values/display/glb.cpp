#include "algebra3d/values/display/glb.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "algebra3d/values/display/detail/glb_chunks.h"

namespace algebra3d {
namespace {

using detail::BufferTarget;
using detail::ComponentType;
using detail::GlbChunks;
using Json = GlbChunks::Json;

/// Numbers that glTF gives the modes of primitives.
enum class Mode : std::uint8_t { points = 0, lines = 1, triangles = 4 };

/// The numbers in an array of numbers, pairs or triples.
template <typename Element>
std::span<const std::uint32_t> numbers_in(const LargeVector<Element>& elements) {
  return {reinterpret_cast<const std::uint32_t*>(elements.data()), sizeof(Element) / 4 * elements.size()};
}

/// Writes the mesh of one shape.
class MeshWriter {
 public:
  MeshWriter(const DrawnShape& shape, GlbChunks& chunks) : shape_(shape), chunks_(chunks) {}

  /// The number of the mesh.
  std::size_t write() {
    positions_ = add_positions();
    if (!shape_.triangles.empty()) add_faces();
    add(Mode::lines, "edges", shape_.edges);
    add(Mode::lines, "boundary", shape_.boundary);
    add(Mode::lines, "nonmanifold", shape_.nonmanifold);
    add(Mode::lines, "lines", shape_.lines);
    add(Mode::points, "points", shape_.points);
    Json& meshes = chunks_.json()["meshes"];
    meshes.push_back({{"primitives", std::move(primitives_)}});
    return meshes.size() - 1;
  }

 private:
  std::size_t add_positions() {
    DrawnShape::Position min, max;
    min.fill(std::numeric_limits<float>::infinity());
    max.fill(-std::numeric_limits<float>::infinity());
    for (const DrawnShape::Position& position : shape_.positions)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis] = std::min(min[axis], position[axis]);
        max[axis] = std::max(max[axis], position[axis]);
      }
    const std::size_t accessor = add_vertices(shape_.positions, ComponentType::single);
    Json& description = chunks_.json()["accessors"][accessor];
    description["min"] = min;
    description["max"] = max;
    return accessor;
  }

  template <typename Element>
  std::size_t add_vertices(const LargeVector<Element>& elements, ComponentType component) {
    const std::size_t view =
        chunks_.add_view(std::as_bytes(std::span(elements)), BufferTarget::vertices, sizeof(Element));
    return chunks_.add_accessor(view, component, elements.size(), "VEC3");
  }

  std::size_t add_normals() {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      chunks_.json()[list] = Json::array({"KHR_mesh_quantization"});
    const std::size_t accessor = add_vertices(shape_.normals, ComponentType::signed_byte);
    chunks_.json()["accessors"][accessor]["normalized"] = true;
    return accessor;
  }

  /// Numbers that viewers look up, and do not draw.
  std::size_t add_ids(const LargeVector<std::uint32_t>& ids) {
    return chunks_.add_accessor(chunks_.add_view(std::as_bytes(std::span(ids)), BufferTarget::none),
                                ComponentType::unsigned_int, ids.size(), "SCALAR");
  }

  void add_faces() {
    add(Mode::triangles, "faces", shape_.triangles);
    Json& faces = primitives_.back();
    faces["attributes"]["NORMAL"] = add_normals();
    Json& extras = faces["extras"];
    if (!shape_.tree.empty()) extras["tree"] = chunks_.add_view(shape_.tree, BufferTarget::none);
    if (!shape_.face_ids.empty()) extras["faceIds"] = add_ids(shape_.face_ids);
    if (!shape_.vertex_ids.empty()) extras["vertexIds"] = add_ids(shape_.vertex_ids);
    if (shape_.deviation) extras["deviation"] = *shape_.deviation;
  }

  template <typename Element>
  void add(Mode mode, const char* role, const LargeVector<Element>& elements) {
    if (elements.empty()) return;
    const std::size_t indices = chunks_.add_indices(numbers_in(elements), shape_.positions.size() - 1);
    primitives_.push_back({{"attributes", {{"POSITION", positions_}}},
                           {"indices", indices},
                           {"mode", static_cast<int>(mode)},
                           {"extras", {{"role", role}}}});
  }

  const DrawnShape& shape_;
  GlbChunks& chunks_;
  Json primitives_ = Json::array();
  std::size_t positions_ = 0;
};

Json extras_of(const GlbNode& node) {
  const DrawnShape& shape = *node.shape;
  Json extras = {
      {"row", node.row}, {"triangles", shape.triangle_count}, {"shown", shape.triangles.size()}, {"kind", shape.kind}};
  const auto& [min, max] = shape.box;
  if (!shape.box.is_empty()) extras["box"] = {min.x, max.x, min.y, max.y, min.z, max.z};
  return extras;
}

}  // namespace

Result<std::string> glb_of(std::span<const GlbNode> nodes) {
  GlbChunks chunks;
  for (const GlbNode& node : nodes) {
    Json description = Json::object();
    if (!node.shape->is_empty()) {
      description["mesh"] = MeshWriter(*node.shape, chunks).write();
      description["translation"] = {node.shape->origin.x, node.shape->origin.y, node.shape->origin.z};
    }
    description["extras"] = extras_of(node);
    chunks.json()["nodes"].push_back(std::move(description));
  }
  if (nodes.empty()) return std::move(chunks).file();
  Json roots = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
  chunks.json()["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
  chunks.json()["scene"] = 0;
  return std::move(chunks).file();
}

std::size_t glb_bytes(const DrawnShape& shape) {
  constexpr std::size_t kDescription = 1500;
  return kDescription + content_bytes(shape);
}

}  // namespace algebra3d
