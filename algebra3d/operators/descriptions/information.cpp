// size, bbox, bbox3d, isEmpty, bboxDistance, bboxIntersects: answered by box and count alone.
#include <optional>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

template <typename T>
std::int64_t size_of(const HeaderOf<T>& geometry) {
  return geometry.header.size;
}

template <typename T>
Maybe<Box3> box_of(const HeaderOf<T>& geometry) {
  if (geometry.header.box.is_empty()) return Undefined{"an empty value has no box"};
  return geometry.header.box;
}

template <typename T>
Maybe<Rect> rect_of(const HeaderOf<T>& geometry) {
  if (geometry.header.box.is_empty()) return Undefined{"an empty value has no box"};
  return Rect::of(geometry.header.box);
}

template <typename T>
bool is_empty(Context& context, std::optional<HeaderOf<T>> geometry) {
  if (!geometry) context.diagnostics.tally("isEmpty: {} undefined value{} counted as empty");
  return !geometry || geometry->header.box.is_empty();
}

template <typename T>
Maybe<double> box_distance(std::optional<HeaderOf<T>> geometry, std::optional<Box3> box) {
  if (!geometry || geometry->header.box.is_empty()) return -1.0;
  if (!box) return Undefined{"the box is undefined"};
  return distance(geometry->header.box, *box);
}

template <typename T>
bool box_intersects(const HeaderOf<T>& geometry, const Box3& box) {
  return geometry.header.box.intersects(box);
}

Operator emptiness() {
  return {
      .name = "isEmpty",
      .syntax = "isEmpty(_)",
      .doc = "True for the empty and for the undefined value.",
      .detail =
          "A note gives the number of undefined values in a statement. `isdefined(x) and isEmpty(x)` is TRUE for "
          "empty values only.",
      .exactness = Exactness::exact,
      .overloads = {overload<&is_empty<Point3d>>("point"), overload<&is_empty<Points3d>>("points"),
                    overload<&is_empty<Surface3d>>("surface"), overload<&is_empty<Volume3d>>("solid"),
                    overload<&is_empty<Mesh3d>>("mesh"), overload<&is_empty<Box3>>("box"),
                    overload<&is_empty<Region>>("region"), overload<&is_empty<MovingRegion>>("moving")},
      .examples = {{{"(volume3d ())"}, "TRUE"},
                   {{"(makePoint3D 0 0 0)"}, "FALSE"},
                   {{"(volume3d undefined)"}, "TRUE"},
                   {{"(volume3d undefined)"}, "FALSE", "(and (isdefined (volume3d undefined)) _)"}},
      .errors = {{{"1"}, "isEmpty: expected (point3d)"}},
  };
}

void register_sizes(OperatorGroup& group) {
  group.add({
      .name = "size",
      .syntax = "size(_)",
      .doc = "The number of points, triangles or faces; for a region or moving region the number of segments.",
      .detail = "A point3d has size 1. Reads no geometry.",
      .exactness = Exactness::exact,
      .overloads = {overload<&size_of<Point3d>>("point"), overload<&size_of<Points3d>>("points"),
                    overload<&size_of<Surface3d>>("surface"), overload<&size_of<Volume3d>>("solid"),
                    overload<&size_of<Mesh3d>>("mesh"), overload<&size_of<Region>>("region"),
                    overload<&size_of<RegionUnit>>("unit"), overload<&size_of<MovingRegion>>("moving")},
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 1 1 1))"}, "12"},
                   {{"(surface3d ())"}, "0"},
                   {{"(volume3d undefined)"}, "undefined"}},
      .errors = {{{"1"},
                  "size: expected (point3d), (points3d), (surface3d), (volume3d), (mesh3d), (region), (uregion) or "
                  "(mregion), got (int)"}},
  });
  group.add(emptiness());
}

// SECONDO's spelling.
void register_isempty(OperatorGroup& group) {
  Operator alias = emptiness();
  alias.name = "isempty";
  alias.syntax = "isempty(_)";
  alias.detail = "Another name of `isEmpty`.";
  alias.examples = {
      {{"(volume3d ())"}, "TRUE"}, {{"(makePoint3D 0 0 0)"}, "FALSE"}, {{"(volume3d undefined)"}, "TRUE"}};
  alias.errors = {{{"1"}, "isempty: expected (point3d)"}};
  group.add(std::move(alias));
}

void register_box_operator(OperatorGroup& group, const std::string& name) {
  group.add({
      .name = name,
      .syntax = name + "(_)",
      .doc = "The smallest box of doubles around a geometry; for a geometry in the plane a rectangle, over all times.",
      .detail =
          "Rounded outward if coordinates are not doubles. Undefined for an empty value. Reads no geometry. `bbox` "
          "and `bbox3d` are the same operator.",
      .exactness = Exactness::outward,
      .overloads = {overload<&box_of<Point3d>>("point"), overload<&box_of<Points3d>>("points"),
                    overload<&box_of<Surface3d>>("surface"), overload<&box_of<Volume3d>>("solid"),
                    overload<&box_of<Mesh3d>>("mesh"), overload<&box_of<Box3>>("box"),
                    overload<&rect_of<Point2d>>("point"), overload<&rect_of<Region>>("region"),
                    overload<&rect_of<Rect>>("rectangle"), overload<&rect_of<RegionUnit>>("unit"),
                    overload<&rect_of<MovingRegion>>("moving")},
      .examples = {{{"(createCube (makePoint3D 0 0 0) (makePoint3D 1 2 3))"}, "(0.0 1.0 0.0 2.0 0.0 3.0)"},
                   {{"(region ((((0 0) (4 0) (4 3)))))"}, "(0.0 4.0 0.0 3.0)"},
                   {{"(volume3d ())"}, "undefined"},
                   {{"(volume3d undefined)"}, "undefined"}},
      .errors = {{{"1"}, name + ": expected (point3d)"}},
  });
}

}  // namespace

void register_information(OperatorGroup& group) {
  register_sizes(group);
  register_isempty(group);
  register_box_operator(group, "bbox");
  register_box_operator(group, "bbox3d");
  const std::string cube = "(createCube (makePoint3D 0 0 0) (makePoint3D 1 1 1))";
  group.add({
      .name = "bboxDistance",
      .syntax = "bboxDistance(_, _)",
      .doc = "The smallest distance between the box of a geometry and a box, in coordinate units; 0 if they meet.",
      .detail = "-1 for an empty or undefined geometry.",
      .exactness = Exactness::two_ulp,
      .overloads = {overload<&box_distance<Point3d>>("point", "box"),
                    overload<&box_distance<Points3d>>("points", "box"),
                    overload<&box_distance<Surface3d>>("surface", "box"),
                    overload<&box_distance<Volume3d>>("solid", "box"), overload<&box_distance<Mesh3d>>("mesh", "box"),
                    overload<&box_distance<Box3>>("other", "box")},
      .examples = {{{cube, "(rectangle3 4 5 5 6 0 1)"}, "5.0"},
                   {{"(volume3d undefined)", "(rectangle3 4 5 5 6 0 1)"}, "-1.0"},
                   {{"(rect3 undefined)", "(rectangle3 4 5 5 6 0 1)"}, "-1.0"},
                   {{cube, "(rect3 undefined)"}, "undefined"}},
      .errors = {{{cube, "1"}, "bboxDistance: expected (point3d rect3)"}},
  });
  group.add({
      .name = "bboxIntersects",
      .syntax = "bboxIntersects(_, _)",
      .doc = "True if the box of a geometry meets a box; touching counts.",
      .detail = "FALSE for an empty geometry.",
      .exactness = Exactness::exact,
      .overloads = {overload<&box_intersects<Point3d>>("point", "box"),
                    overload<&box_intersects<Points3d>>("points", "box"),
                    overload<&box_intersects<Surface3d>>("surface", "box"),
                    overload<&box_intersects<Volume3d>>("solid", "box"),
                    overload<&box_intersects<Mesh3d>>("mesh", "box"),
                    symmetric(overload<&box_intersects<Box3>>("other", "box"))},
      .examples = {{{cube, "(rectangle3 1 2 1 2 1 2)"}, "TRUE"},
                   {{"(rectangle3 0 1 0 1 0 1)", "(rectangle3 2 3 0 1 0 1)"}, "FALSE"},
                   {{"(volume3d ())", "(rectangle3 1 2 1 2 1 2)"}, "FALSE"},
                   {{"(volume3d undefined)", "(rectangle3 1 2 1 2 1 2)"}, "undefined"}},
      .errors = {{{cube, "1"}, "bboxIntersects: expected (point3d rect3)"}},
  });
}

}  // namespace algebra3d
