// roundCoordinates.
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/base/number_text.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/detail/sample_values.h"
#include "algebra3d/registry/operator.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/rounding/coordinate_grid.h"
#include "algebra3d/rounding/rounded_solid.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {
namespace {

Result<Maybe<Volume3d>> rounded_to(Context& context, const Volume3d& solid, const CoordinateGrid& grid) {
  ALGEBRA3D_ASSIGN_OR_RETURN(RoundedSolid rounded, rounded_solid(solid.mesh(), grid, context.cancel));
  if (!rounded.mesh) return Maybe<Volume3d>(Undefined{rounded.reason});
  if (rounded.moved_vertices == 0) return Maybe<Volume3d>(solid);
  std::string text =
      fmt::format("roundCoordinates: {} of {} vertices moved, and the boundary by at most {}", rounded.moved_vertices,
                  solid.mesh().vertex_count(), real_text(rounded.largest_movement));
  if (rounded.reach > 0)
    text += fmt::format("; features nearer to each other than {} were joined where triangles crossed",
                        real_text(rounded.reach));
  if (rounded.shells_after < rounded.shells_before && rounded.shells_after > 0)
    text += fmt::format("; {} of {} shells are left", rounded.shells_after, rounded.shells_before);
  context.diagnostics.report(std::move(text));
  if (rounded.mesh->is_empty()) context.diagnostics.report("roundCoordinates: nothing of the solid is left");
  return Maybe<Volume3d>(Volume3d::trusted(*std::move(rounded.mesh)));
}

Result<Maybe<Volume3d>> rounded_to_doubles(Context& context, const Volume3d& solid) {
  return rounded_to(context, solid, CoordinateGrid::doubles());
}

Result<Maybe<Volume3d>> rounded_to_multiples(Context& context, const Volume3d& solid, double step) {
  if (!(step > 0) || !std::isfinite(step)) return Maybe<Volume3d>(Undefined{"the grid must be greater than 0"});
  return rounded_to(context, solid, CoordinateGrid::multiples(step));
}

}  // namespace

void register_rounding(Registry& registry) {
  registry.add({
      .name = "roundCoordinates",
      .syntax = "roundCoordinates(_ ...)",
      .doc = "The solid with all coordinates rounded to doubles, or to the doubles nearest to multiples of a grid "
             "width.",
      .detail =
          "A diagnostic gives the number of moved vertices, and the largest distance by which the boundary moved. "
          "The result is a valid solid: facets are triangulated anew, and where triangles would cross each other, "
          "vertices, edges and facets that are nearly one are joined, which a diagnostic tells too. Parts thinner than "
          "the grid vanish. A solid whose coordinates are on the grid is unchanged. Undefined if a coordinate would "
          "be out of range, or if no valid solid is found.",
      .exactness = Exactness::reported,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&rounded_to_doubles>("solid"), overload<&rounded_to_multiples>("solid", "grid")},
      .examples = {{{kUnitCube}, "1.0", "(volume _)"},
                   {{kUnitCube, "0.75"}, "0.421875", "(volume _)"},
                   {{kUnitCube, "3.0"}, "TRUE", "(isEmpty _)"},
                   {{kUnitCube, "0.0"}, "undefined"},
                   {{"(volume3d undefined)"}, "undefined"}},
      .errors = {{{"1"}, "roundCoordinates: expected (volume3d) or (volume3d real), got (int)"}},
  });
}

}  // namespace algebra3d
