#include "algebra3d/values/types/face_blocks.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/spatial.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

// The format is that of docs/file_format.md, "Face blocks", which is changed first.

namespace algebra3d {
namespace {

constexpr auto kListVersion = 1U;
constexpr std::size_t kBytesOfBlock = 52;  // in the list

Error corrupt_blocks(std::string_view expectation) {
  return {ErrorCode::database_corrupt, "face blocks: expected {}", expectation};
}

/// Consecutive faces in the order of the hierarchy.
using BlockFaces = std::span<const FaceId>;

/// Half the surface of a box.
double surface_of(const Box3& box) {
  const Vec3 sizes = box.max - box.min;
  return sizes.x * sizes.y + sizes.y * sizes.z + sizes.z * sizes.x;
}

/// Where to divide faces with these boxes: the place with the smallest boxes before and behind it; nothing if they are
/// not much smaller than that around all. Each part has some faces.
std::optional<std::size_t> place_to_divide(std::span<const Box3> boxes) {
  constexpr std::size_t kFewest = 16;
  constexpr double kMuch = 1.25;
  if (boxes.size() < 2 * kFewest) return std::nullopt;
  std::vector<double> before(boxes.size());  // by place: of the box around all before it
  Box3 box;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i > 0) before[i] = surface_of(box);
    box.extend(boxes[i]);
  }
  double least = surface_of(box) / kMuch;
  std::optional<std::size_t> place;
  box = {};
  for (std::size_t i = boxes.size(); i-- > kFewest;) {
    box.extend(boxes[i]);
    if (boxes.size() - i < kFewest || before[i] + surface_of(box) >= least) continue;
    least = before[i] + surface_of(box);
    place = i;
  }
  return place;
}

/// Makes a block of faces, or several where the curve of the hierarchy has left a part of the surface and gone on in
/// another: else a box would reach from the one to the other.
void divide(const TriangleMesh& mesh, BlockFaces all, FaceBlockList& list, std::vector<BlockFaces>& faces_of) {
  std::vector<Box3> boxes;
  for (const FaceId face : all) boxes.push_back(box_of_triangle(mesh.corners(face)));
  struct Part {
    std::size_t first, end;
  };
  std::vector<Part> stack{{0, all.size()}};
  while (!stack.empty()) {
    const auto [first, end] = stack.back();
    stack.pop_back();
    const auto of_part = std::span(boxes).subspan(first, end - first);
    if (const auto place = place_to_divide(of_part)) {
      stack.push_back({first + *place, end});
      stack.push_back({first, first + *place});
      continue;
    }
    Box3 box;
    for (const Box3& each : of_part) box.extend(each);
    list.blocks.push_back({box, static_cast<decltype(FaceBlockList::Block::face_count)>(end - first)});
    faces_of.push_back(all.subspan(first, end - first));
  }
}

std::string encoded_list(const FaceBlockList& list) {
  std::string bytes;
  ByteWriter writer(bytes);
  writer.u32(kListVersion);
  writer.varint(list.blocks.size());
  for (const FaceBlockList::Block& block : list.blocks) {
    for (const Vec3& corner : {block.box.min, block.box.max})
      for (std::size_t axis = 0; axis < 3; ++axis) writer.f64(corner[axis]);
    writer.u32(block.face_count);
  }
  writer.raw(encode(Value::of(Points3d(list.seeds))));
  return bytes;
}

FaceBlockList::Block read_block(ByteReader& reader) {
  FaceBlockList::Block block;
  for (Vec3* const corner : {&block.box.min, &block.box.max})
    for (std::size_t axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.f64();
  block.face_count = reader.u32();
  reader.require(!block.box.is_empty() && block.face_count > 0 && block.face_count <= kFacesOfBlock,
                 "a box and a number of faces");
  return block;
}

}  // namespace

Status encode_face_blocks(const Geometry& geometry, const std::function<Status(std::string_view bytes)>& visit_list,
                          const std::function<Status(std::size_t block, std::string_view bytes)>& visit_block,
                          std::size_t faces_of_block) {
  const TriangleMesh& mesh = geometry.mesh;
  const EdgeComponents& components = geometry.components();
  if (mesh.face_count() == 0 || components.count() > kMostSeeds) return {};
  const BoxHierarchy& hierarchy = geometry.hierarchy();
  std::vector<FaceId> faces;  // in the order of the hierarchy
  faces.reserve(mesh.face_count());
  for (std::size_t i = 0; i < mesh.face_count(); ++i) faces.emplace_back(hierarchy.placed(i).face());
  FaceBlockList list;
  std::vector<BlockFaces> faces_of;  // by block
  for (std::size_t first = 0; first < faces.size(); first += faces_of_block) {
    poll_interruption();
    const BlockFaces next = std::span(faces).subspan(first, std::min(faces_of_block, faces.size() - first));
    divide(mesh, next, list, faces_of);
  }
  for (std::size_t i = 0; i < components.count(); ++i) {
    const FaceId first = components.first_face(EdgeComponentId(i));
    list.seeds.push_back(mesh.points().point(mesh.triangle(first)[0]));
  }
  A3D_TRY(visit_list(encoded_list(list)));
  // Each task makes tables as long as the mesh.
  constexpr std::size_t kBlocksOfTask = 256;
  std::vector<std::string> bytes(list.blocks.size());
  parallel_for((bytes.size() + kBlocksOfTask - 1) / kBlocksOfTask, 1, [&](std::size_t task) {
    SubmeshMaker maker(mesh);
    for (std::size_t i = task * kBlocksOfTask; i < std::min(bytes.size(), (task + 1) * kBlocksOfTask); ++i) {
      poll_interruption();
      bytes[i] = encode(Value::of(Surface3d::trusted(maker.make(faces_of[i]))));
    }
  });
  for (std::size_t i = 0; i < bytes.size(); ++i) A3D_TRY(visit_block(i, bytes[i]));
  return {};
}

Result<FaceBlockList> decode_face_block_list(std::string_view bytes, const Box3& box, std::uint32_t face_count) {
  ByteReader reader(bytes, "face blocks");
  const auto version = reader.u32();
  if (version != kListVersion) return corrupt_blocks(fmt::format("version {}, found {}", kListVersion, version));
  FaceBlockList list;
  list.blocks.resize(reader.count(kBytesOfBlock));
  Box3 all;
  std::size_t faces = 0;
  for (FaceBlockList::Block& block : list.blocks) {
    block = read_block(reader);
    all.extend(block.box);
    faces += block.face_count;
  }
  const std::string_view seeds = reader.raw(reader.remaining());
  A3D_TRY(reader.finish());
  if (!(all == box)) return corrupt_blocks("the bounding box of the value");
  if (faces != face_count) return corrupt_blocks(fmt::format("{} faces in all, found {}", face_count, faces));
  A3D_ASSIGN(const Value points, decode(TypeOf<Points3d>::type(), seeds, Origin::own_store));
  if (!points.is_defined()) return corrupt_blocks("a vertex of each component");
  list.seeds = points.get<Points3d>().points();
  if (list.seeds.empty() || list.seeds.size() > kMostSeeds) return corrupt_blocks("a vertex of each component");
  return list;
}

Result<TriangleMesh> decode_face_block(std::string_view bytes, const FaceBlockList::Block& block) {
  A3D_ASSIGN(const Value value, decode(TypeOf<Surface3d>::type(), bytes, Origin::own_store));
  if (!value.is_defined()) return corrupt_blocks("the faces of a block");
  const GeometryHeader header = value.header();
  if (!(header.box == block.box) || header.size != block.face_count)
    return corrupt_blocks("a block of the faces that the list says");
  return value.get<Surface3d>().mesh();
}

std::size_t FaceBlocks::face_count(std::span<const std::uint32_t> blocks) const {
  std::size_t count = 0;
  for (const auto block : blocks) count += list_.blocks[block].face_count;
  return count;
}

Result<TriangleMesh> FaceBlocks::faces(std::span<const std::uint32_t> blocks) const {
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(face_count(blocks));
  for (const auto block : blocks) {
    poll_interruption();
    A3D_ASSIGN(const TriangleMesh mesh, faces_of(block));
    const auto first = VertexId(points.size()).index();
    points.append(mesh.points(), 0, mesh.points().size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto [a, b, c] = mesh.triangle(FaceId(f));
      triangles.push_back({first + a, first + b, first + c});
    }
  }
  return TriangleMesh(std::move(points), triangles);
}

}  // namespace algebra3d
