// roundCoordinates, rotateRounded.
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/rounding/coordinate_grid.h"
#include "algebra3d/kernel/rounding/rounded_image.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/rounding/rounded_surface.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/value_images.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/number_text.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

constexpr const char* kRotateRounded = "rotateRounded";

std::string nothing_left(const RoundedSolid& /*rounded*/) {
  return "nothing is left: no cube of the grid was found within it";
}
std::string nothing_left(const RoundedSurface& /*rounded*/) {
  return "nothing is left: all of its triangles are thinner than the grid";
}

/// The text of the note on a rounding: the vertices moved, the distance, the method, and the shells that vanished.
template <typename Rounded>
std::string rounding_note(const Rounded& rounded, std::size_t vertex_count) {
  if (rounded.mesh->is_empty()) return nothing_left(rounded);
  const std::string distance = rounded.largest_movement > 0
                                   ? "and the remaining boundary by at most " + real_text(rounded.largest_movement)
                                   : "but not the remaining boundary";
  std::string text = fmt::format("{} of {} vertices moved, {}; method: {}", rounded.moved_vertices, vertex_count,
                                 distance, name_of(rounded.method));
  if (rounded.reach > 0) text += fmt::format(" that were up to {} apart", real_text(rounded.reach));
  if (rounded.contact_vertices > 0)
    text += fmt::format(
        "; {} inside edges or faces of others",
        rounded.contact_vertices == 1 ? "1 vertex lies" : fmt::format("{} vertices lie", rounded.contact_vertices));
  return text;
}

std::string shells_note(const RoundedSolid& rounded) {
  if (rounded.mesh->is_empty() || rounded.shells_after >= rounded.shells_before) return {};
  return "; " + shells_text(rounded);
}

/// The value of a rounding by the operator; a diagnostic describes it.
Volume3d reported(Context& context, RoundedSolid rounded, std::size_t vertex_count, const char* name) {
  const std::string note = rounding_note(rounded, vertex_count) + shells_note(rounded);
  context.diagnostics.report(fmt::format("{}: {}", name, note));
  return Volume3d::trusted(*std::move(rounded.mesh));
}

Result<Maybe<Volume3d>> rounded_to(Context& context, const Volume3d& solid, const CoordinateGrid& grid,
                                   const char* name = "roundCoordinates") {
  A3D_ASSIGN(RoundedSolid rounded, rounded_solid(solid.mesh(), grid, context.monitor()));
  if (!rounded.mesh) return Maybe<Volume3d>(Undefined{std::move(rounded.reason)});
  if (rounded.moved_vertices == 0) return Maybe<Volume3d>(solid);
  return Maybe<Volume3d>(reported(context, std::move(rounded), solid.mesh().vertex_count(), name));
}

Result<Maybe<Surface3d>> rounded_to(Context& context, const Surface3d& surface, const CoordinateGrid& grid) {
  A3D_ASSIGN(RoundedSurface rounded, rounded_surface(surface.mesh(), grid, context.monitor()));
  if (!rounded.mesh) return Maybe<Surface3d>(Undefined{std::move(rounded.reason)});
  if (rounded.moved_vertices == 0) return Maybe<Surface3d>(surface);
  context.diagnostics.report("roundCoordinates: " + rounding_note(rounded, surface.mesh().vertex_count()));
  return Maybe<Surface3d>(Surface3d::trusted(*std::move(rounded.mesh)));
}

template <typename T>
Result<Maybe<T>> rounded_to_doubles(Context& context, const T& geometry) {
  return rounded_to(context, geometry, CoordinateGrid::doubles());
}

template <typename T>
Result<Maybe<T>> rounded_to_multiples(Context& context, const T& geometry, double step) {
  if (!(step > 0) || !std::isfinite(step))
    return Maybe<T>(Undefined{fmt::format("the grid must be greater than 0, found {}", real_text(step))});
  return rounded_to(context, geometry, CoordinateGrid::multiples(step));
}

template <typename T>
Result<Maybe<T>> rounded_to_numbers(Context& context, const T& geometry, const std::string& numbers) {
  if (numbers == "doubles") return rounded_to(context, geometry, CoordinateGrid::doubles());
  if (numbers == "floats") return rounded_to(context, geometry, CoordinateGrid::floats());
  return Maybe<T>(Undefined{fmt::format(R"(expected "doubles" or "floats", found "{}")", numbers)});
}

/// The rotated solid, rounded by the cheapest way that gives a valid one. Doubles: each coordinate of the image is
/// rounded. Fractions: the rounded image is simplified (rounded_image.h). An exact image is made and rounded if that is
/// not valid, and at once for fractions under a map that has none, such as a quarter turn: it moves few vertices.
Result<Maybe<Volume3d>> rotated_and_rounded(Context& context, const Volume3d& solid, const Point3d& centre,
                                            const Vector3d& axis, double angle_degrees) {
  const auto map = AffineMap::rotation(centre.position.rational(), axis.components.rational(), angle_degrees);
  if (!map) return Maybe<Volume3d>(Undefined{"the axis is the zero vector"});
  if (solid.mesh().points().exact_count() == 0) {
    A3D_ASSIGN(auto rounded, rounded_image_of(context, *map, solid));
    if (!rounded) return Maybe<Volume3d>(Undefined{rounded.reason()});
    if (*rounded) return Maybe<Volume3d>(**std::move(rounded));
  } else if (!map->has_dyadic_matrix()) {
    A3D_ASSIGN(std::optional<RoundedSolid> rounded, rounded_image(*map, solid.mesh(), context.cancel));
    if (rounded)
      return Maybe<Volume3d>(reported(context, *std::move(rounded), solid.mesh().vertex_count(), kRotateRounded));
  }
  A3D_ASSIGN(const auto exact, exact_image_of(context, *map, solid));
  if (!exact) return Maybe<Volume3d>(Undefined{exact.reason()});
  return rounded_to(context, *exact, CoordinateGrid::doubles(), kRotateRounded);
}

/// The ladder of methods, a line each.
std::string methods_text() {
  std::string text =
      "These methods are tried in order, and the first that gives a valid result is taken. If joined features or "
      "coplanar facets move by more than 64 spacings of the numbers, faces are thickened, too, and the nearer result "
      "is "
      "taken. Each line has the method, its condition, within which reach it joins features or how wide the cells of "
      "its "
      "lattice are, and how far the boundary moves at most.\n";
  std::size_t number = 0;
  for (const RungInWords& rung : rounding_rungs()) {
    text += fmt::format("\n  {}. {}", ++number, rung.name);
    if (!rung.condition.empty()) text += fmt::format(" ({})", rung.condition);
    if (!rung.reach.empty()) text += ", " + rung.reach;
    text += fmt::format(": {}", rung.promise);
  }
  return text +
         "\n\n  Thickened faces and later methods are needed only where shells a few spacings thick are combined with "
         "copies of themselves again and again.";
}

}  // namespace

void register_rounding(OperatorGroup& group) {
  group.add({
      .name = "roundCoordinates",
      .syntax = "roundCoordinates(_ ...)",
      .doc = "The surface or solid with all coordinates rounded to doubles, to floats, or to the doubles nearest to "
             "multiples of a grid width.",
      .detail =
          "A string names the numbers: doubles or floats; without it they are doubles. The result is always a valid "
          "surface or solid. A value whose coordinates are on the grid is unchanged. A diagnostic gives the number "
          "of moved vertices, the largest distance by which the boundary moved, the method, and the number of "
          "vertices that lie inside edges or faces of others. The distance is one-sided: no point of the result is "
          "farther from the given boundary. Parts that vanished are not counted; hausdorffDistance measures both "
          "sides.\n\n  " +
          methods_text() +
          "\n\n  "
          "Walls and fins thinner than the grid vanish, and slots narrower than it close, however long they are. With "
          "a "
          "grid width, pockets and slits that are nowhere wider than it are closed first, so that the crack between "
          "two parts whose touching faces are divided differently does not become as wide as the grid; a slit stays "
          "where a wall has another one opposite to a part of it only. A "
          "solid vanishes altogether only if no cube of the grid is found within it; a slanted one may be up to 3.5 "
          "times as thick as the grid and contain none. Thickened faces and later methods promise no distance: of "
          "1,513 random steps of such chains 14 moved by more than 64 spacings, three of them by 2,129 to 3,698 and "
          "one by 12,220, and symmetric differences by 68,714. Only facets of a solid with corners that move are "
          "changed and proved again, so "
          "the cost follows the length of the seams. Corners of a solid that rounding made superfluous are removed, "
          "unless the spacing is more than 1/256 of the longest side of its box: there triangles multiply in a long "
          "chain of rounded set operations. Undefined if a coordinate would be out of range, and for other strings.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&rounded_to_doubles<Volume3d>>("solid"),
                    overload<&rounded_to_multiples<Volume3d>>("solid", "grid"),
                    overload<&rounded_to_numbers<Volume3d>>("solid", "numbers"),
                    overload<&rounded_to_doubles<Surface3d>>("surface"),
                    overload<&rounded_to_multiples<Surface3d>>("surface", "grid"),
                    overload<&rounded_to_numbers<Surface3d>>("surface", "numbers")},
      .examples = {{{kUnitCube}, "1.0", "(volume _)"},
                   {{kUnitCube, "0.75"}, "0.421875", "(volume _)"},
                   {{kUnitCube, "3.0"}, "TRUE", "(isEmpty _)"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0.4))))", "1.0"}, "0.5", "(area _)"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 0.1 0))))", R"("floats")"},
                    "0.10000000149011612",
                    "(* 2.0 (area _))"},
                   {{kUnitCube, R"("doubles")"}, "1.0", "(volume _)"},
                   {{kUnitCube, R"("integers")"}, "undefined"},
                   {{kUnitCube, "0.0"}, "undefined"},
                   {{"(volume3d undefined)"}, "undefined"}},
      .errors = {{{"1"},
                  "roundCoordinates: expected (volume3d), (volume3d real), (volume3d string), (surface3d), (surface3d "
                  "real) or "
                  "(surface3d string), got (int)"}},
  });
  group.add({
      .name = "rotateRounded",
      .syntax = "_ rotateRounded[_, _, _]",
      .doc = "rotate and roundCoordinates in one step: the rotated solid, with doubles as coordinates.",
      .detail =
          "rotate keeps fractions where the solid has some and the map is exact, and where rounding each coordinate "
          "would break the solid. In a long chain of rotations and set operations fractions grow by some 48 bits with "
          "each rotation; rotateRounded ends that. It costs a third to three quarters of the two where a solid has "
          "fractions, and as much as rotate where it has none. A diagnostic says how far the boundary moved if more "
          "was done than rounding each coordinate. Undefined for a zero axis.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&rotated_and_rounded>("solid", "centre", "axis", "degrees")},
      .examples = {{{kUnitCube, kOrigin, "(makeVector3D 0 0 1)", "90"}, "(-1.0 0.0 0.0 1.0 0.0 1.0)", "(bbox _)"},
                   {{kUnitCube, kOrigin, "(makeVector3D 0 0 0)", "90"}, "undefined"},
                   {{"(volume3d undefined)", kOrigin, "(makeVector3D 0 0 1)", "90"}, "undefined"}},
      .errors = {{{"1", kOrigin, "(makeVector3D 0 0 1)", "90"},
                  "rotateRounded: expected (volume3d point3d vector3d real)"}},
  });
}

}  // namespace algebra3d
