#include "algebra3d/mesh/mesh.h"
#include "algebra3d/kernel/halfedge/given_arrays.h"

#include <numeric>
#include <utility>
#include <vector>

#include "algebra3d/meshes/mesh_access.h"
#include "base/indices.h"
#include "base/large_allocator.h"
#include "base/propagate.h"
#include "base/scheduler.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {
namespace detail {

template <AnyMesh M>
M MeshAccess::outer_as(std::shared_ptr<const KernelMesh<M>> mesh, const MeshAttributes& attributes) {
  M result;
  if (mesh->vertex_count() == 0) return result;
  auto content = std::make_shared<const MeshContent<M>>(std::move(mesh));
  const KernelMesh<M>& arrays = *content->mesh;
  if constexpr (std::same_as<M, PolygonMesh>)
    static_cast<SharedPolygonLayout&>(result) = SharedPolygonLayout(arrays.layout());
  result.points_ = arrays.points().approx();
  result.origins_ = arrays.origins();
  result.opposites_ = arrays.opposites();
  result.outgoing_ = arrays.outgoing_halfedges_of_vertices();
  result.nonmanifold_ = arrays.nonmanifold_tables();
  result.edge_numbers_ = &content->edge_numbers;
  result.first_halfedges_ = content->first_halfedges;
  result.content_ = std::move(content);
  return with_attributes(std::move(result), attributes);
}

template TriangleMesh MeshAccess::outer_as<TriangleMesh>(std::shared_ptr<const algebra3d::TriangleMesh>,
                                                         const MeshAttributes&);
template PolygonMesh MeshAccess::outer_as<PolygonMesh>(std::shared_ptr<const algebra3d::PolygonMesh>,
                                                       const MeshAttributes&);

algebra3d::PolygonMesh polygons_of(const TriangleMesh& mesh) {
  const algebra3d::TriangleMesh& triangles = MeshAccess::content(mesh);
  PolygonLayout layout = triangles.is_empty() ? PolygonLayout() : PolygonLayout::of_degree(3);
  if (triangles.is_manifold())
    return {triangles.points(), std::move(layout), triangles.origins(), triangles.opposites(),
            triangles.outgoing_halfedges_of_vertices()};
  return {triangles.points(), std::move(layout), triangles.origins()};
}

algebra3d::TriangleMesh triangles_of(const algebra3d::PolygonMesh& polygons) {
  LargeVector<std::uint32_t> opposites(polygons.halfedge_count());
  constexpr std::size_t kHalfedgesPerTask = 1U << 16U;
  parallel_for(opposites.size(), kHalfedgesPerTask, [&](std::size_t h) {
    const HalfedgeId opposite = polygons.opposite(HalfedgeId(h));
    opposites[h] = opposite.is_valid() ? opposite.index() : algebra3d::TriangleMesh::kUnlinked;
  });
  return algebra3d::TriangleMesh::with_proposed_links(polygons.points(), polygons.origins(), std::move(opposites));
}

Result<TriangleMesh> triangle_mesh_of(const algebra3d::PolygonMesh& polygons, const MeshAttributes& attributes) {
  if (polygons.common_degree() != 3)
    for (const FaceId f : faces(polygons))
      if (polygons.degree(f) != 3)
        return Error{ErrorCode::invalid_value, "face {} has {} corners, expected triangles; triangulated makes them",
                     f.index(), polygons.degree(f)};
  return MeshAccess::outer(triangles_of(polygons), attributes);
}

}  // namespace detail

namespace {

using detail::MeshAccess;

LargeVector<std::uint32_t> number_array(std::span<const std::uint32_t> numbers) {
  return {numbers.begin(), numbers.end()};
}

std::size_t count_of(const auto& mesh, MeshElement element) {
  switch (element) {
    case MeshElement::vertex:
      return mesh.vertex_count();
    case MeshElement::edge:
      return mesh.edge_count();
    case MeshElement::halfedge:
      return mesh.halfedge_count();
    case MeshElement::face:
      break;
  }
  return mesh.face_count();
}

template <typename T>
std::array<double, sizeof(T) / sizeof(double)> numbers_of(const T& value) {
  if constexpr (std::same_as<T, double>)
    return {value};
  else if constexpr (std::same_as<T, Vec2>)
    return value;
  else
    return {value.x, value.y, value.z};
}

template <typename T>
AttributeValues attribute_values(std::span<const T> values) {
  AttributeValues result(detail::kind_of<T>(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if constexpr (std::same_as<T, std::string>)
      result.set_text(i, result.add_text(values[i]));
    else
      result.set(i, numbers_of(values[i]));
  }
  return result;
}

}  // namespace

template <typename Derived, typename Layout>
bool Mesh<Derived, Layout>::has_fractions() const {
  return MeshAccess::content(*this).points().exact_count() > 0;
}

template <typename Derived, typename Layout>
std::vector<AttributeDescription> Mesh<Derived, Layout>::attributes() const {
  std::vector<AttributeDescription> result;
  const MeshAttributes attributes = MeshAccess::attributes(*this);
  for (const MeshAttribute& attribute : attributes.all())
    result.push_back({attribute.element, attribute.name, attribute.values->kind()});
  return result;
}

template <typename Derived, typename Layout>
Result<detail::ColumnContent> Mesh<Derived, Layout>::column(MeshElement element, AttributeKind kind,
                                                            std::string_view name) const {
  return without_exceptions([&]() -> Result<detail::ColumnContent> {
    const MeshAttributes attributes = MeshAccess::attributes(*this);
    const MeshAttribute* const found = attributes.find(element, name);
    if (found == nullptr)
      return Error{ErrorCode::unknown_name, "the mesh has no {} attribute '{}'", name_of(element), name};
    const AttributeValues& values = *found->values;
    if (values.kind() != kind)
      return Error{ErrorCode::type_error,  "the {} attribute '{}' has values of the kind {}, expected {}",
                   name_of(element),       name,
                   name_of(values.kind()), name_of(kind)};
    detail::ColumnContent content{.owner = found->values, .size = values.size()};
    if (kind == AttributeKind::text) {
      content.texts = values.texts();
      content.text_numbers = values.numbers_of_texts();
    } else if (values.size() > 0) {
      content.numbers = {values.numbers(0).data(), width_of(kind) * values.size()};
    }
    return content;
  });
}

template <typename Derived, typename Layout>
Result<Derived> Mesh<Derived, Layout>::with_column(MeshElement element, std::string name,
                                                   const detail::ColumnValues& values) const {
  return without_exceptions([&]() -> Result<Derived> {
    if (name.empty()) return Error{ErrorCode::invalid_value, "the name of an attribute must not be empty"};
    const std::size_t expected = count_of(*this, element);
    return std::visit(
        [&](const auto& given) -> Result<Derived> {
          if (given.size() != expected)
            return Error{ErrorCode::invalid_value,
                         "{} attribute '{}': found {} values, expected {}, one per {}",
                         name_of(element),
                         name,
                         given.size(),
                         expected,
                         name_of(element)};
          const MeshAttributes attributes = MeshAccess::attributes(*this).with(element, name, attribute_values(given));
          return MeshAccess::with_attributes(static_cast<const Derived&>(*this), attributes);
        },
        values);
  });
}

template <typename Derived, typename Layout>
Derived Mesh<Derived, Layout>::without_column(MeshElement element, std::string_view name) const {
  return MeshAccess::with_attributes(static_cast<const Derived&>(*this),
                                     MeshAccess::attributes(*this).without(element, name));
}

template class Mesh<TriangleMesh, TriangleLayout>;
template class Mesh<PolygonMesh, SharedPolygonLayout>;

Result<TriangleMesh> TriangleMesh::of_triangles(GivenPoints points,
                                                std::span<const std::array<std::uint32_t, 3>> triangles) {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    A3D_TRY(check_points(points.span()));
    A3D_TRY(check_triangles(points.span().size(), triangles));
    return MeshAccess::outer(algebra3d::TriangleMesh(PointArray(points.take()), triangles));
  });
}

Result<TriangleMesh> TriangleMesh::of_corners(GivenPoints points, std::span<const std::uint32_t> corners) {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    A3D_TRY(check_points(points.span()));
    A3D_TRY(check_corners(points.span().size(), corners));
    if (corners.size() % 3 != 0)
      return Error{ErrorCode::invalid_value, "{} corners; expected three for each triangle", corners.size()};
    std::vector<IndexTriangle> triangles(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i) triangles[i / 3][i % 3] = corners[i];
    return MeshAccess::outer(algebra3d::TriangleMesh(PointArray(points.take()), triangles));
  });
}

PolygonMesh::PolygonMesh(const TriangleMesh& triangles)
    : PolygonMesh(MeshAccess::outer(detail::polygons_of(triangles), MeshAccess::attributes(triangles))) {}

Result<PolygonMesh> PolygonMesh::of_faces(GivenPoints points, std::span<const std::uint32_t> corners,
                                          std::span<const std::uint32_t> degrees) {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    A3D_TRY(check_points(points.span()));
    A3D_TRY(check_corners(points.span().size(), corners));
    A3D_ASSIGN(PolygonLayout layout, layout_of(degrees, corners.size()));
    return MeshAccess::outer(
        algebra3d::PolygonMesh(PointArray(points.take()), std::move(layout), number_array(corners)));
  });
}

Result<PolygonMesh> PolygonMesh::of_faces(GivenPoints points, std::span<const std::uint32_t> corners,
                                          std::uint32_t degree) {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    A3D_TRY(check_points(points.span()));
    A3D_TRY(check_corners(points.span().size(), corners));
    if (degree < 3 || corners.size() % degree != 0)
      return Error{ErrorCode::invalid_value, "{} corners; expected a multiple of the degree {}, which is 3 or more",
                   corners.size(), degree};
    PolygonLayout layout = corners.empty() ? PolygonLayout() : PolygonLayout::of_degree(degree);
    return MeshAccess::outer(
        algebra3d::PolygonMesh(PointArray(points.take()), std::move(layout), number_array(corners)));
  });
}

}  // namespace algebra3d::mesh
