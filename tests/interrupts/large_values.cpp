#include "interrupts/large_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/conversions/wkb.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/time.h"
#include "base/interruption_scope.h"

namespace algebra3d::interrupts {
namespace {

using Coordinates = LargeValues::Coordinates;

/// A sphere of rings; the first half of its rings alone is a bowl.
struct Sphere {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
};

Sphere sphere(std::size_t triangle_count, const Vec3& centre) {
  const auto sides = static_cast<std::uint32_t>(std::max(4.0, std::sqrt(static_cast<double>(triangle_count))));
  const std::uint32_t rings = sides / 2;
  Sphere made;
  made.points.push_back(centre + Vec3{0, 0, 1});
  for (std::uint32_t ring = 1; ring < rings; ++ring)
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double polar = std::numbers::pi * ring / rings, turn = 2 * std::numbers::pi * side / sides;
      const Vec3 at{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
      made.points.push_back(centre + at);
    }
  made.points.push_back(centre - Vec3{0, 0, 1});
  const auto place = [&](std::uint32_t ring, std::uint32_t side) {
    if (ring == 0) return 0U;
    return ring == rings ? static_cast<std::uint32_t>(made.points.size() - 1) : 1 + (ring - 1) * sides + side % sides;
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t a = place(ring, side), b = place(ring + 1, side), c = place(ring + 1, side + 1);
      if (ring + 1 < rings) made.triangles.push_back({a, b, c});
      if (ring > 0) made.triangles.push_back({a, c, place(ring, side + 1)});
    }
  return made;
}

/// The point, or its image by an exact rotation with long fractions, in which a plane stays a plane.
ExactPoint placed(const Vec3& point, Coordinates coordinates) {
  if (coordinates == Coordinates::doubles) return point;
  const auto turned = [](const Rational& a, const Rational& b, std::int64_t p, std::int64_t q, std::int64_t r) {
    return std::pair(a * Rational(p, r) - b * Rational(q, r), a * Rational(q, r) + b * Rational(p, r));
  };
  const auto [x, y] = turned(Rational(point.x), Rational(point.y), 20, 99, 101);
  const auto [y2, z] = turned(y, Rational(point.z), 12, 35, 37);
  return ExactPoint(RationalVec3(x, y2, point.z == 0 && coordinates == Coordinates::doubles ? Rational() : z));
}

TriangleMesh mesh_of(const Sphere& shape, std::size_t triangle_count, Coordinates coordinates) {
  PointArray points;
  for (const Vec3& point : shape.points) points.push_back(placed(point, coordinates));
  return {std::move(points), std::span(shape.triangles).first(triangle_count)};
}

/// A star with so many corners, in the plane.
Polygons star(std::size_t corner_count, const Vec3& centre, double size, Coordinates coordinates) {
  Polygons polygons;
  for (std::size_t i = 0; i < corner_count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corner_count);
    const double reach = size * (i % 2 == 0 ? 1 : 0.9);
    const Vec3 corner = centre + Vec3{reach * std::cos(turn), reach * std::sin(turn), 0};
    if (coordinates == Coordinates::doubles)
      polygons.corners.push_back(corner);
    else
      polygons.corners.push_back(
          ExactPoint(RationalVec3(Rational(corner.x) / Rational(3), Rational(corner.y) / Rational(7), Rational())));
  }
  polygons.cycle_ends = {static_cast<std::uint32_t>(corner_count)};
  polygons.face_ends = {1};
  return polygons;
}

RegionUnit growing_star(std::size_t corner_count, const Vec3& centre, std::int64_t start, Coordinates coordinates) {
  const auto at = [](std::int64_t milliseconds) { return Instant{milliseconds}; };
  return RegionUnit::trusted({at(start), at(start + 1000), true, false},
                             {star(corner_count, centre, 1, coordinates), star(corner_count, centre, 2, coordinates)});
}

}  // namespace

LargeValues::LargeValues(std::size_t size, Coordinates coordinates) {
  for (const double shift : {0.0, 0.125}) {
    const Vec3 centre{shift, shift / 3, shift / 5};
    const Sphere shape = sphere(size, centre);
    const auto add = [&](Value value) { values_[std::string(value.type().name())].push_back(std::move(value)); };
    const TriangleMesh whole = mesh_of(shape, shape.triangles.size(), coordinates);
    add(Value::of(Mesh3d(*polygon_mesh_of(whole, Merging::none))));
    std::vector<ExactPoint> points;
    for (std::size_t i = 0; i < whole.points().size(); ++i) points.push_back(whole.points().point(i));
    add(Value::of(Points3d(std::move(points))));
    add(Value::of(Volume3d::trusted(whole)));
    add(Value::of(Bytes{*wkb_of_solid(whole, Srid::none)}));
    add(Value::of(Surface3d::trusted(mesh_of(shape, shape.triangles.size() / 2, coordinates))));
    add(Value::of(Region::trusted(star(size, centre, 1, coordinates))));
    add(Value::of(growing_star(size / 4, centre, 0, coordinates)));
    std::vector<RegionUnit> units;
    for (std::int64_t i = 0; i < 40; ++i) units.push_back(growing_star(size / 160, centre, 1000 * i, coordinates));
    add(Value::of(*MovingRegion::make(std::move(units))));
  }
}

const Value* LargeValues::find(const Type& type, std::size_t argument) const {
  const auto found = values_.find(type.name());
  return found == values_.end() ? nullptr : &found->second[argument % found->second.size()];
}

std::vector<Value> many_values(const Type& type, std::size_t count) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 place{0.7 * static_cast<double>(i % 50), 0.7 * static_cast<double>(i / 50),
                     0.01 * static_cast<double>(i)};
    const Sphere shape = sphere(200, place);
    if (type.name() == "volume3d")
      values.push_back(Value::of(Volume3d::trusted(mesh_of(shape, shape.triangles.size(), Coordinates::doubles))));
    else if (type.name() == "surface3d")
      values.push_back(Value::of(Surface3d::trusted(mesh_of(shape, shape.triangles.size() / 2, Coordinates::doubles))));
    else if (type.name() == "region")
      values.push_back(Value::of(Region::trusted(star(100, {place.x, place.y, 0}, 1, Coordinates::doubles))));
    else
      break;
  }
  return values;
}

}  // namespace algebra3d::interrupts
