#include "algebra3d/values/types/mesh3d.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/detail/corner_code.h"
#include "algebra3d/values/types/detail/mesh_attribute_codec.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Box3 box_around(const PointArray& points) {
  Box3 box;
  for (std::size_t i = 0; i < points.size(); ++i) box.extend(box_of(points[i]));
  return box;
}

Result<PointArray> points_from_nested(const NestedList& list) {
  PointArray points;
  points.reserve(list.elements().size());
  for (const NestedList& element : list.elements()) {
    A3D_ASSIGN(const ExactPoint point, point_from_nested(element, fmt::format("mesh3d: vertex {}", points.size())));
    points.push_back(point);
  }
  return points;
}

/// Appends the corners of face `number`. Errors: invalid_value; limit_exceeded for too many corners in all.
Status add_face(const NestedList& list, std::size_t number, std::size_t point_count,
                LargeVector<std::uint32_t>& corners) {
  if (!list.is_list() || list.elements().size() < 3)
    return Error{ErrorCode::invalid_value, "mesh3d: face {}: expected the numbers of three or more vertices, got {}",
                 number, list.print_short()};
  if (list.elements().size() > PolygonMesh::kMaxHalfedges - corners.size())
    return Error{ErrorCode::limit_exceeded, "mesh3d: expected at most {} corners of faces", PolygonMesh::kMaxHalfedges};
  for (const NestedList& vertex : list.elements()) {
    if (!vertex.is_int() || vertex.as_int() < 0 || static_cast<std::uint64_t>(vertex.as_int()) >= point_count)
      return Error{ErrorCode::invalid_value, "mesh3d: face {}: expected the number of a vertex below {}, got {}",
                   number, point_count, vertex.print_short()};
    corners.push_back(static_cast<std::uint32_t>(vertex.as_int()));
  }
  return {};
}

void write_faces(ByteWriter& writer, const PolygonMesh& mesh) {
  writer.varint(mesh.face_count());
  writer.varint(mesh.common_degree());
  if (mesh.common_degree() == 0) {
    std::vector<std::uint64_t> degrees;
    degrees.reserve(mesh.face_count());
    for (const FaceId f : faces(mesh)) degrees.push_back(mesh.degree(f));
    writer.planes(degrees, 1);
  }
  std::vector<std::uint64_t> codes;
  codes.reserve(mesh.halfedge_count());
  CornerCode code;
  for (const std::uint32_t corner : mesh.origins()) codes.push_back(code.encode(corner));
  writer.planes(codes, 1);
}

/// The first half-edge of each face, and the end; empty if the reader fails.
LargeVector<std::uint32_t> read_starts(ByteReader& reader) {
  const std::size_t face_count = reader.count(3);  // three corners at least
  const std::uint64_t common_degree = reader.varint();
  reader.require(common_degree == 0 || common_degree >= 3, "faces with at least three corners");
  std::vector<std::uint64_t> degrees;
  if (common_degree == 0) degrees = reader.planes(face_count, 1, 4);
  if (!reader.ok()) return {};
  LargeVector<std::uint32_t> starts;
  starts.reserve(face_count + 1);
  std::uint64_t end = 0;
  for (std::size_t f = 0; f <= face_count; ++f) {
    starts.push_back(static_cast<std::uint32_t>(end));
    if (f == face_count) break;
    const std::uint64_t degree = common_degree == 0 ? degrees[f] : common_degree;
    end += degree;
    // Each corner takes a byte at least, so that a wrong degree cannot exhaust memory.
    if (degree < 3 || end > reader.remaining() || end > PolygonMesh::kMaxHalfedges) {
      reader.fail("faces with three or more corners that follow");
      return {};
    }
  }
  return starts;
}

LargeVector<std::uint32_t> read_corners(ByteReader& reader, std::size_t count, std::size_t point_count) {
  LargeVector<std::uint32_t> corners;
  corners.reserve(count);
  CornerCode code;
  for (const std::uint64_t coded : reader.planes(count, 1, 5)) {
    const std::uint64_t vertex = code.decode(coded);
    if (vertex >= point_count) {
      reader.fail("corners that are vertices");
      return {};
    }
    corners.push_back(static_cast<std::uint32_t>(vertex));
  }
  return corners;
}

class Mesh3dType final : public DescribedType {
 public:
  Mesh3dType()
      : DescribedType({.name = "mesh3d",
                       .doc = "Vertices with exact coordinates, and faces of three or more corners, which may be bent, "
                              "may cross and may be non-manifold; numbered from 0. Elements may have attributes.",
                       .notation = "(((x y z)*) ((vertex vertex vertex+)*)), a vertex as its number; perhaps with a "
                                   "third list of attributes ((element \"name\" kind (value*))*)",
                       .example = "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))",
                       .kinds = {Kind::data, Kind::spatial3d},
                       .is_large = true,
                       .summary_unit = "face",
                       .coordinates = Coordinates::mesh}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    const auto is_list = [](const NestedList& part) { return part.is_list(); };
    if (!list.is_list() || (list.elements().size() != 2 && list.elements().size() != 3) ||
        !std::ranges::all_of(list.elements(), is_list))
      return expected("((points) (faces)) or ((points) (faces) (attributes))", list);
    A3D_ASSIGN(PointArray points, points_from_nested(list.elements()[0]));
    LargeVector<std::uint32_t> corners;
    LargeVector<std::uint32_t> starts{0};
    const NestedList::List& faces = list.elements()[1].elements();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      A3D_TRY(add_face(faces[f], f, points.size(), corners));
      starts.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    PolygonMesh mesh(std::move(points), PolygonLayout(std::move(starts)), std::move(corners));
    if (list.elements().size() == 2) return Value::of(Mesh3d(std::move(mesh)));
    A3D_ASSIGN(MeshAttributes attributes, attributes_from_nested(list.elements()[2], mesh));
    return Value::of(Mesh3d(std::move(mesh), std::move(attributes)));
  }

  NestedList to_nested(const Value& value) const override {
    const PolygonMesh& mesh = mesh_of(value);
    NestedList::List points;
    points.reserve(mesh.vertex_count());
    for (const VertexId v : vertices(mesh)) points.push_back(point_to_nested(mesh.point(v)));
    NestedList::List all_faces;
    all_faces.reserve(mesh.face_count());
    for (const FaceId f : faces(mesh)) {
      poll_interruption_at(f.index());
      NestedList::List corners;
      for (const VertexId v : vertices_of(mesh, f)) corners.push_back(NestedList(std::int64_t{v.index()}));
      all_faces.emplace_back(std::move(corners));
    }
    if (attributes_of(value).is_empty())
      return NestedList::list(NestedList(std::move(points)), NestedList(std::move(all_faces)));
    return NestedList::list(NestedList(std::move(points)), NestedList(std::move(all_faces)),
                            attributes_to_nested(attributes_of(value)));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto order = compare_meshes(mesh_of(a), mesh_of(b));
    return std::is_eq(order) ? attributes_of(a) <=> attributes_of(b) : order;
  }
  static std::strong_ordering compare_meshes(const PolygonMesh& p, const PolygonMesh& q) {
    if (&p == &q) return std::strong_ordering::equal;
    if (const auto order = p.vertex_count() <=> q.vertex_count(); std::is_neq(order)) return order;
    if (const auto order = p.face_count() <=> q.face_count(); std::is_neq(order)) return order;
    for (const VertexId v : vertices(p))
      if (const auto order = algebra3d::compare(p.point(v), q.point(v)); std::is_neq(order)) return order;
    for (const FaceId f : faces(p))
      if (const auto order = p.degree(f) <=> q.degree(f); std::is_neq(order)) return order;
    return std::lexicographical_compare_three_way(p.origins().begin(), p.origins().end(), q.origins().begin(),
                                                  q.origins().end());
  }
  std::size_t hash(const Value& value) const override {
    const PolygonMesh& mesh = mesh_of(value);
    std::size_t result = combine_hashes(mesh.vertex_count(), mesh.face_count());
    // The rounded coordinates do: equal points have equal ones.
    for (const Vec3& p : mesh.points().approx())
      for (const double coordinate : {p.x, p.y, p.z}) result = combine_hashes(result, hash_real(coordinate));
    for (const std::uint32_t corner : mesh.origins()) result = combine_hashes(result, corner);
    return combine_hashes(result, attributes_of(value).hash());
  }

  std::size_t heap_bytes(const Value& value) const override {
    return 2 * object_bytes<Mesh3d>() + sizeof(PolygonMesh) + mesh_of(value).heap_bytes() +
           attributes_of(value).heap_bytes();
  }
  GeometryHeader header(const Value& value) const override {
    return {value.get<Mesh3d>().box(), static_cast<std::uint32_t>(mesh_of(value).face_count())};
  }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_points(writer, mesh_of(value).points());
    write_faces(writer, mesh_of(value));
    write_attributes(writer, attributes_of(value));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    PointArray points = read_points(reader);
    LargeVector<std::uint32_t> starts = read_starts(reader);
    LargeVector<std::uint32_t> corners = read_corners(reader, starts.empty() ? 0 : starts.back(), points.size());
    A3D_TRY(reader.status());
    PolygonMesh mesh(std::move(points), PolygonLayout(std::move(starts)), std::move(corners));
    MeshAttributes attributes = read_attributes(reader, mesh);
    A3D_TRY(reader.finish());
    return Value::of(Mesh3d(std::move(mesh), std::move(attributes)));
  }

 private:
  static const PolygonMesh& mesh_of(const Value& value) { return value.get<Mesh3d>().mesh(); }
  static const MeshAttributes& attributes_of(const Value& value) { return value.get<Mesh3d>().attributes(); }
};

}  // namespace

Mesh3d::Mesh3d() {
  // All empty values share one mesh.
  static const auto empty = std::make_shared<const Content>();
  content_ = empty;
}

Mesh3d::Mesh3d(PolygonMesh mesh) {
  assert(std::ranges::all_of(faces(mesh), [&](FaceId f) { return mesh.degree(f) >= 3; }));
  const Box3 box = box_around(mesh.points());
  content_ = std::make_shared<const Content>(std::move(mesh), box);
}

const EdgeNumbers& Mesh3d::edge_numbers() const {
  std::call_once(content_->once, [&] { content_->edge_numbers = EdgeNumbers(content_->mesh); });
  return content_->edge_numbers;
}

Mesh3d::Mesh3d(PolygonMesh mesh, MeshAttributes attributes) : Mesh3d(std::move(mesh)) {
  assert(attributes.fits(content_->mesh));
  attributes_ = std::move(attributes);
}

Mesh3d Mesh3d::with_attributes(MeshAttributes attributes) const {
  assert(attributes.fits(mesh()));
  Mesh3d result = *this;
  result.attributes_ = std::move(attributes);
  return result;
}

const Type& TypeOf<Mesh3d>::type() {
  static const Mesh3dType the_type;
  return the_type;
}

}  // namespace algebra3d
