#include "algebra3d/mesh/operations.h"

#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/dual.h"
#include "algebra3d/kernel/simplification/simplification.h"
#include "algebra3d/kernel/subdivision/subdivided.h"
#include "algebra3d/meshes/mesh_access.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

namespace algebra3d::mesh {

using detail::MeshAccess;

namespace {

struct Rules {
  SubdivisionScheme scheme;
  SubdivisionOptions options;
};

/// Errors: unknown_name, beginning with the name of the function.
Result<Rules> rules_of(std::string_view function, std::string_view scheme, std::string_view variant) {
  const std::optional<SubdivisionScheme> known = subdivision_scheme(scheme);
  if (!known)
    return Error{ErrorCode::unknown_name, "{}: expected one of {}, found '{}'", function, subdivision_scheme_names(),
                 scheme};
  if (variant.empty()) return Rules{*known, {}};
  const Result<std::size_t> place = subdivision_variant(*known, variant);
  if (!place) return Error{ErrorCode::unknown_name, "{}: {}", function, place.error().text()};
  return Rules{*known, {*place}};
}

}  // namespace

template <AnyMesh M>
Result<PolygonMesh> subdivided(const M& mesh, std::string_view scheme, std::size_t steps, std::string_view variant,
                               const Monitor& monitor) {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(const Rules rules, rules_of("subdivided", scheme, variant));
    A3D_ASSIGN(SubdividedMesh result, algebra3d::subdivided(detail::polygons_of(mesh), MeshAccess::attributes(mesh),
                                                            rules.scheme, steps, rules.options, monitor));
    return MeshAccess::outer(std::move(result.mesh), result.attributes);
  });
}

template <AnyMesh M>
Result<PolygonMesh> limit_mesh(const M& mesh, std::string_view scheme, std::string_view variant,
                               const Monitor& monitor) {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(const Rules rules, rules_of("limit_mesh", scheme, variant));
    if (!has_limit(rules.scheme))
      return Error{ErrorCode::invalid_value, "limit_mesh: expected one of {}, found '{}'",
                   subdivision_scheme_names(has_limit), scheme};
    A3D_ASSIGN(SubdividedMesh result, algebra3d::limit_mesh(detail::polygons_of(mesh), MeshAccess::attributes(mesh),
                                                            rules.scheme, rules.options, monitor));
    return MeshAccess::outer(std::move(result.mesh), result.attributes);
  });
}

Result<TriangleMesh> simplified(const TriangleMesh& mesh, const SimplificationGoal& goal, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    if (!(goal.deviation >= 0) || !(goal.crease_degrees >= 0))
      return Error{ErrorCode::invalid_value,
                   "simplified: expected a deviation and an angle that are not negative, found {} and {} degrees",
                   goal.deviation, goal.crease_degrees};
    const InterruptionScope interruption(monitor.cancel());
    const algebra3d::TriangleMesh& given = MeshAccess::content(mesh);
    const SimplificationTarget target{
        .triangles = goal.triangles, .deviation = goal.deviation, .crease_degrees = goal.crease_degrees};
    const auto of_doubles = [&] { return algebra3d::TriangleMesh(given, PointArray(given.points().approx())); };
    A3D_ASSIGN(Simplification result, given.points().exact_count() == 0
                                          ? algebra3d::simplified(given, target, monitor)
                                          : algebra3d::simplified(of_doubles(), target, monitor));
    MeshAttributes attributes = MeshAccess::attributes(mesh);
    if (!attributes.is_empty())
      attributes = attributes_after(attributes, detail::polygons_of(mesh),
                                    detail::polygons_of(MeshAccess::outer(result.mesh)), result);
    return MeshAccess::outer(std::move(result.mesh), attributes);
  });
}

template <AnyMesh M>
Result<PolygonMesh> dual(const M& mesh, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<PolygonMesh> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(algebra3d::PolygonMesh result, dual_mesh(MeshAccess::content(mesh), monitor));
    return MeshAccess::outer(std::move(result));
  });
}

Result<TriangleMesh> triangulated(const PolygonMesh& mesh, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<TriangleMesh> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(const Mesh3d result,
               algebra3d::triangulated(Mesh3d(MeshAccess::content(mesh), MeshAccess::attributes(mesh)), monitor));
    if (result.mesh().face_count() > algebra3d::TriangleMesh::kMaxFaces)
      return Error{ErrorCode::limit_exceeded, "{} triangles; expected at most {}", result.mesh().face_count(),
                   algebra3d::TriangleMesh::kMaxFaces};
    return detail::triangle_mesh_of(result.mesh(), result.attributes());
  });
}

template Result<PolygonMesh> subdivided(const TriangleMesh&, std::string_view, std::size_t, std::string_view,
                                        const Monitor&);
template Result<PolygonMesh> subdivided(const PolygonMesh&, std::string_view, std::size_t, std::string_view,
                                        const Monitor&);
template Result<PolygonMesh> limit_mesh(const TriangleMesh&, std::string_view, std::string_view, const Monitor&);
template Result<PolygonMesh> limit_mesh(const PolygonMesh&, std::string_view, std::string_view, const Monitor&);
template Result<PolygonMesh> dual(const TriangleMesh&, const Monitor&);
template Result<PolygonMesh> dual(const PolygonMesh&, const Monitor&);

}  // namespace algebra3d::mesh
