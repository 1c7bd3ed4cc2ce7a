#include "algebra3d/values/display/glb.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace algebra3d {
namespace {

/// Numbers that glTF 2.0 gives its words.
enum class ComponentType : std::uint16_t {
  signed_byte = 5120,
  unsigned_short = 5123,
  unsigned_int = 5125,
  single = 5126
};
enum class BufferTarget : std::uint16_t { none = 0, vertices = 34962, indices = 34963 };

/// The two chunks of a binary glTF file while they grow: the description as JSON, and the arrays that it refers to,
/// which must outlive this object.
class GlbChunks {
 public:
  using Json = nlohmann::ordered_json;

  GlbChunks();

  /// The description; its lists are complete but for `buffers`.
  Json& json() { return json_; }

  /// Appends an array and a view of it; the number of the view. `stride` is 0 where elements are not vertices.
  std::size_t add_view(std::span<const std::byte> bytes, BufferTarget target, std::size_t stride = 0);
  /// An accessor of the elements of a new view; its number. `type` is SCALAR or VEC3.
  std::size_t add_accessor(std::size_t view, ComponentType component, std::size_t count, const char* type);
  /// An accessor of numbers up to `largest`, in the narrowest type that can be drawn.
  std::size_t add_indices(std::span<const std::uint32_t> indices, std::size_t largest);

  /// The whole file. Errors: limit_exceeded.
  Result<std::string> file() &&;

 private:
  /// A view's bytes; numbers of 32 bits are written with 16 if `is_narrowed`.
  struct Piece {
    std::span<const std::byte> bytes;
    bool is_narrowed;

    std::size_t size() const { return is_narrowed ? bytes.size() / 2 : bytes.size(); }
  };
  std::size_t add_piece(const Piece& piece, BufferTarget target, std::size_t stride);

  Json json_;
  std::vector<Piece> pieces_;
  std::size_t size_ = 0;  // of the arrays, each filled up to four bytes
};

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;  // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::size_t filled_up(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

void append_word(std::string& file, std::size_t word) {
  const auto narrow = static_cast<std::uint32_t>(word);
  file.append(std::string_view(reinterpret_cast<const char*>(&narrow), sizeof narrow));
}

void append_narrowed(std::string& file, std::span<const std::byte> numbers) {
  const std::size_t begin = file.size(), count = numbers.size() / 4;
  file.resize(begin + 2 * count);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(file.data() + begin + 2 * i, numbers.data() + 4 * i, 2);
}

GlbChunks::GlbChunks() {
  json_["asset"] = {{"version", "2.0"}, {"generator", "algebra3d"}};
}

std::size_t GlbChunks::add_piece(const Piece& piece, BufferTarget target, std::size_t stride) {
  Json view = {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", piece.size()}};
  if (stride != 0) view["byteStride"] = stride;
  if (target != BufferTarget::none) view["target"] = static_cast<int>(target);
  pieces_.push_back(piece);
  size_ += filled_up(piece.size());
  Json& views = json_["bufferViews"];
  views.push_back(std::move(view));
  return views.size() - 1;
}

std::size_t GlbChunks::add_view(std::span<const std::byte> bytes, BufferTarget target, std::size_t stride) {
  return add_piece({bytes, false}, target, stride);
}

std::size_t GlbChunks::add_accessor(std::size_t view, ComponentType component, std::size_t count, const char* type) {
  Json& accessors = json_["accessors"];
  accessors.push_back(
      {{"bufferView", view}, {"componentType", static_cast<int>(component)}, {"count", count}, {"type", type}});
  return accessors.size() - 1;
}

std::size_t GlbChunks::add_indices(std::span<const std::uint32_t> indices, std::size_t largest) {
  // The largest number of a type cannot be an index: it restarts primitives.
  const bool is_narrow = largest < std::numeric_limits<std::uint16_t>::max();
  const std::size_t view = add_piece({std::as_bytes(indices), is_narrow}, BufferTarget::indices, 0);
  return add_accessor(view, is_narrow ? ComponentType::unsigned_short : ComponentType::unsigned_int, indices.size(),
                      "SCALAR");
}

Result<std::string> GlbChunks::file() && {
  if (size_ > 0) json_["buffers"] = Json::array({{{"byteLength", size_}}});
  std::string json = json_.dump();
  json.resize(filled_up(json.size()), ' ');
  const std::size_t total =
      kHeaderBytes + kChunkHeaderBytes + json.size() + (size_ > 0 ? kChunkHeaderBytes + size_ : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    return Error(ErrorCode::limit_exceeded, "binary glTF of {} bytes; the format allows less than 4 GB", total);
  std::string file;
  file.reserve(total);
  for (const std::size_t word : {std::size_t{kMagic}, std::size_t{kVersion}, total, json.size(), std::size_t{kJson}})
    append_word(file, word);
  file += json;
  if (size_ == 0) return file;
  append_word(file, size_);
  append_word(file, kBinary);
  for (const Piece& piece : pieces_) {
    if (piece.is_narrowed)
      append_narrowed(file, piece.bytes);
    else
      file.append(reinterpret_cast<const char*>(piece.bytes.data()), piece.bytes.size());
    file.resize(filled_up(file.size()), '\0');
  }
  return file;
}

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
