#include "algebra3d/geometry/solid.h"

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/library/detail/surroundings.h"
#include "algebra3d/library/detail/triangles.h"
#include "algebra3d/library/shape_access.h"
#include "algebra3d/values/constructions/shape_makers.h"
#include "algebra3d/values/constructions/solid_components.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "base/interruption_scope.h"
#include "base/nearest_rounding.h"
#include "base/propagate.h"
#include "base/without_exceptions.h"

// The analyzer does not follow how many values share an object.
// NOLINTBEGIN(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)

namespace algebra3d {
namespace {

using detail::check_finite;
using detail::defined;
using detail::ShapeAccess;
using detail::Surroundings;

Rational exact_volume_of(const Volume3d& volume) {
  const NearestRounding rounding;
  return *exact_volume(volume.mesh().points(), triangles_of(volume.mesh()));
}

std::vector<Volume3d> contents_of(std::span<const Solid> solids) {
  std::vector<Volume3d> contents;
  contents.reserve(solids.size());
  for (const Solid& solid : solids) contents.push_back(ShapeAccess::content(solid));
  return contents;
}

}  // namespace

Solid::Solid() = default;

Result<Solid> Solid::box(const Vec3& corner, const Vec3& opposite) {
  return without_exceptions([&]() -> Result<Solid> {
    A3D_TRY(check_finite("box", corner));
    A3D_TRY(check_finite("box", opposite));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(
        defined("box", box_between(surroundings.context, detail::point(corner), detail::point(opposite))));
  });
}

Result<Solid> Solid::sphere(const Vec3& centre, double radius, int corners) {
  return without_exceptions([&]() -> Result<Solid> {
    A3D_TRY(check_finite("sphere", centre));
    A3D_TRY(check_finite("sphere", {radius, 0, 0}));
    Surroundings surroundings{Monitor{}};
    return ShapeAccess::outer(
        defined("sphere", sphere_polyhedron(surroundings.context, detail::point(centre), radius, corners)));
  });
}

double Solid::volume() const {
  const NearestRounding rounding;
  // Without a flag that interrupts it, there is no error.
  return *nearest_volume(content().mesh().points(), triangles_of(content().mesh()));
}

std::string Solid::exact_volume() const {
  return exact_volume_of(content()).text();
}

Result<Vec3> Solid::centroid() const {
  return without_exceptions([&]() -> Result<Vec3> {
    if (content().mesh().is_empty()) return Error{ErrorCode::invalid_value, "centroid: an empty solid has no centroid"};
    return nearest_centroid(content().mesh().points(), triangles_of(content().mesh()));
  });
}

Result<Solid> Solid::rounded(const Monitor& monitor) const {
  return without_exceptions([&]() -> Result<Solid> {
    const InterruptionScope interruption(monitor.cancel());
    A3D_ASSIGN(RoundedSolid rounded, rounded_solid(content().mesh(), CoordinateGrid::doubles(), monitor));
    if (!rounded.mesh) return Error{ErrorCode::invalid_value, "rounded: {}", rounded.reason};
    return rounded.moved_vertices == 0 ? *this : ShapeAccess::outer(Volume3d::trusted(*std::move(rounded.mesh)));
  });
}

Result<std::vector<Solid>> Solid::components(const Monitor& monitor) const {
  return without_exceptions([&]() -> Result<std::vector<Solid>> {
    Surroundings surroundings(monitor);
    A3D_ASSIGN(std::vector<Volume3d> parts, components_of(surroundings.context, content()));
    std::vector<Solid> solids;
    solids.reserve(parts.size());
    for (Volume3d& part : parts) solids.push_back(ShapeAccess::outer(std::move(part)));
    return solids;
  });
}

Result<Solid> unite(std::span<const Solid> solids, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Solid> {
    Surroundings surroundings(monitor);
    return ShapeAccess::outer(united(surroundings.context, contents_of(solids)));
  });
}

Result<Solid> unite(const Solid& a, const Solid& b, const Monitor& monitor) {
  return unite(std::array{a, b}, monitor);
}

Result<Solid> intersect(std::span<const Solid> solids, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Solid> {
    if (solids.empty()) return Error{ErrorCode::wrong_usage, "intersect: expected at least one solid"};
    Surroundings surroundings(monitor);
    return ShapeAccess::outer(intersected(surroundings.context, contents_of(solids)));
  });
}

Result<Solid> intersect(const Solid& a, const Solid& b, const Monitor& monitor) {
  return intersect(std::array{a, b}, monitor);
}

Result<Solid> subtract(const Solid& a, const Solid& b, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Solid> {
    Surroundings surroundings(monitor);
    return ShapeAccess::outer(without(surroundings.context, ShapeAccess::content(a), ShapeAccess::content(b)));
  });
}

Result<Solid> symmetric_difference(const Solid& a, const Solid& b, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<Solid> {
    Surroundings surroundings(monitor);
    return ShapeAccess::outer(in_either(surroundings.context, ShapeAccess::content(a), ShapeAccess::content(b)));
  });
}

Result<SplitSolid> split(const Solid& solid, const Vec3& point, const Vec3& normal, const Monitor& monitor) {
  return without_exceptions([&]() -> Result<SplitSolid> {
    A3D_ASSIGN(const Plane3d plane, detail::plane_through("split", point, normal));
    Surroundings surroundings(monitor);
    A3D_ASSIGN(SolidParts parts, split(surroundings.context, ShapeAccess::content(solid), plane.plane));
    return SplitSolid{ShapeAccess::outer(std::move(parts.in_front)), ShapeAccess::outer(std::move(parts.behind))};
  });
}

}  // namespace algebra3d

// NOLINTEND(clang-analyzer-cplusplus.NewDeleteLeaks,clang-analyzer-cplusplus.NewDelete)
