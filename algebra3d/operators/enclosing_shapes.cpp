// convexHull: of points, boxes, surfaces and solids.
#include <string>
#include <utility>

#include "algebra3d/convex/convex_hull.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/operators/detail/point_arrays.h"
#include "algebra3d/operators/detail/sample_values.h"
#include "algebra3d/registry/operator.h"
#include "algebra3d/registry/overload.h"
#include "algebra3d/types/spatial.h"

namespace algebra3d {
namespace {

template <typename T>
Result<Maybe<Volume3d>> convex_hull_of(Context& context, const T& set) {
  ALGEBRA3D_ASSIGN_OR_RETURN(auto hull, convex_hull(spanning_points(set), context.monitor()));
  if (!hull) return Maybe<Volume3d>(Undefined{hull.reason()});
  return Maybe<Volume3d>(Volume3d::trusted(*std::move(hull)));
}

// The corners of a tetrahedron and a point inside.
const std::string kFivePoints = "(points3d ((0 0 0) (6 0 0) (0 6 0) (0 0 6) (1 1 1)))";

}  // namespace

void register_enclosing_shapes(Registry& registry) {
  registry.add({
      .name = "convexHull",
      .syntax = "convexHull(_)",
      .doc = "The convex hull of points, a box, a surface or a solid: the smallest convex solid that contains it.",
      .detail = "Its vertices are the extreme points, with their coordinates as they are. The hull of the empty set is "
                "empty; undefined if all points lie in one plane.",
      .exactness = Exactness::exact,
      .sources = {"barber1996"},
      .overloads = {overload<&convex_hull_of<Points3d>>("points"), overload<&convex_hull_of<Box3>>("box"),
                    overload<&convex_hull_of<Surface3d>>("surface"), overload<&convex_hull_of<Volume3d>>("solid")},
      // A sixth of 6 * 6 * 6.
      .examples = {{{kFivePoints}, "36.0", "(volume _)"},
                   {{kFivePoints}, "4", "(size _)"},
                   {{kCubeOfTwo}, "TRUE", "(= _ " + kCubeOfTwo + ")"},
                   {{"(surface3d (((0 0 0) (1 0 0) (0 1 0))))"}, "undefined"},
                   {{"(points3d ())"}, "TRUE", "(isempty _)"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"1"}, "convexHull: expected (points3d), (rect3), (surface3d) or (volume3d), got (int)"}},
  });
}

}  // namespace algebra3d
