// makePoint3D, makeVector3D, makePlane3D, getx, gety, getz, length, dot, cross.
#include <cmath>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/planes.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

namespace algebra3d {
namespace {

// Arguments of type real are finite, so three of them always make a point.
Point3d make_point(double x, double y, double z) {
  return {ExactPoint(Vec3{x, y, z})};
}
Vector3d make_vector(double x, double y, double z) {
  return {ExactPoint(Vec3{x, y, z})};
}

Maybe<Vector3d> vector_between(const Point3d& from, const Point3d& to) {
  return vector_of(to.position.rational() - from.position.rational());
}

template <std::size_t kAxis>
double point_coordinate(const Point3d& point) {
  return point.position.approx()[kAxis];
}
template <std::size_t kAxis>
double vector_component(const Vector3d& vector) {
  return vector.components.approx()[kAxis];
}

double vector_length(const Vector3d& v) {
  const RationalVec3 exact = v.components.rational();
  return dot(exact, exact).nearest_root();
}

double scalar_product(const Vector3d& v, const Vector3d& w) {
  return dot(v.components.rational(), w.components.rational()).nearest_double();
}

Maybe<Vector3d> vector_product(const Vector3d& v, const Vector3d& w) {
  return vector_of(cross(v.components.rational(), w.components.rational()));
}

const std::string kThird = "(vector3d (1/3 0 0))";

template <std::size_t kAxis>
void register_coordinate(OperatorGroup& group, const std::string& name, const std::string& axis,
                         const std::string& value) {
  group.add({
      .name = name,
      .host_name = axis,
      .syntax = name + "(_)",
      .doc = "The " + axis + " coordinate of a point, or component of a vector, in coordinate units.",
      .exactness = Exactness::rounded_once,
      .frame_use = FrameUse::coordinates,
      .overloads = {overload<&point_coordinate<kAxis>>("point"), overload<&vector_component<kAxis>>("vector")},
      .examples = {{{"(makePoint3D 1 2 3)"}, value},
                   {{"(makeVector3D 1 2 3)"}, value},
                   {{"(point3d undefined)"}, "undefined"}},
      .errors = {{{"1"}, name + ": expected (point3d) or (vector3d), got (int)"}},
  });
}

}  // namespace

void register_points(OperatorGroup& group) {
  register_coordinate<0>(group, "getx", "x", "1.0");
  register_coordinate<1>(group, "gety", "y", "2.0");
  register_coordinate<2>(group, "getz", "z", "3.0");
  group.add({
      .name = "makePoint3D",
      .syntax = "makePoint3D(_, _, _)",
      .doc = "The point with these coordinates.",
      .exactness = Exactness::exact,
      .overloads = {overload<&make_point>("x", "y", "z")},
      .examples = {{{"1", "2.5", "-3"}, "(1.0 2.5 -3.0)"}, {{"1", "2", "(real undefined)"}, "undefined"}},
      .errors = {{{"1", "2"}, "makePoint3D: expected (real real real), got (int int)"}},
  });
  group.add({
      .name = "makeVector3D",
      .syntax = "makeVector3D(_, _ ...)",
      .doc = "The vector with these components, or the vector from the first point to the second.",
      .exactness = Exactness::exact,
      .overloads = {overload<&make_vector>("x", "y", "z"), overload<&vector_between>("from", "to")},
      .examples = {{{"1", "2.5", "-3"}, "(1.0 2.5 -3.0)"},
                   {{"(makePoint3D 1 1 1)", "(makePoint3D 4 1 0)"}, "(3.0 0.0 -1.0)"},
                   {{"(makePoint3D 1 1 1)", "(point3d undefined)"}, "undefined"}},
      .errors = {{{"1", "2"}, "makeVector3D: expected (real real real) or (point3d point3d), got (int int)"}},
  });
  group.add({
      .name = "makePlane3D",
      .syntax = "makePlane3D(_, _ ...)",
      .doc = "The plane through a point with a normal, or spanned by two directions u and v with the normal u x v.",
      .detail = "Undefined for a zero normal and for parallel directions.",
      .exactness = Exactness::exact,
      .overloads = {overload<&plane_through>("point", "normal"), overload<&plane_spanned>("point", "u", "v")},
      .examples = {{{"(makePoint3D 0 0 2)", "(makeVector3D 0 0 1)"}, "TRUE", "(= _ (plane3d (2 0 0 1)))"},
                   {{"(makePoint3D 0 0 0)", "(makeVector3D 1 0 0)", "(makeVector3D 2 0 0)"}, "undefined"},
                   {{"(point3d undefined)", "(makeVector3D 0 0 1)"}, "undefined"}},
      .errors = {{{"(makePoint3D 0 0 2)", "1"},
                  "makePlane3D: expected (point3d vector3d) or (point3d vector3d vector3d), got (point3d int)"}},
  });
  group.add({
      .name = "length",
      .syntax = "length(_)",
      .doc = "The Euclidean length of a vector, in coordinate units.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&vector_length>("vector")},
      .examples = {{{"(makeVector3D 3 0 4)"}, "5.0"},
                   {{"(makeVector3D 1 1 0)"}, "1.4142135623730951"},
                   {{"(vector3d undefined)"}, "undefined"}},
      .errors = {{{"1"}, "length: expected (vector3d), got (int)"}},
  });
  group.add({
      .name = "dot",
      .host_name = "dot_product",
      .syntax = "dot(_, _)",
      .doc = "The scalar product of two vectors, in squared coordinate units.",
      .exactness = Exactness::rounded_once,
      .overloads = {symmetric(overload<&scalar_product>("v", "w"))},
      .examples = {{{"(makeVector3D 1 2 3)", "(makeVector3D 4 5 6)"}, "32.0"},
                   {{"(makeVector3D 1e10 1 1)", "(makeVector3D 1e10 1 -1e20)"}, "1.0"},
                   {{"(vector3d undefined)", "(makeVector3D 1 0 0)"}, "undefined"}},
      .errors = {{{"(makeVector3D 1 2 3)", "1"}, "dot: expected (vector3d vector3d), got (vector3d int)"}},
  });
  group.add({
      .name = "cross",
      .host_name = "cross_product",
      .syntax = "cross(_, _)",
      .doc = "The vector product of two vectors, by the right-hand rule.",
      .exactness = Exactness::exact,
      .overloads = {overload<&vector_product>("v", "w")},
      .examples = {{{"(makeVector3D 1 0 0)", "(makeVector3D 0 1 0)"}, "(0.0 0.0 1.0)"},
                   {{"(makeVector3D 0 3 0)", kThird}, "(0.0 0.0 -1.0)"},
                   {{"(vector3d undefined)", "(makeVector3D 1 0 0)"}, "undefined"}},
      .errors = {{{"(makeVector3D 1 2 3)", "1"}, "cross: expected (vector3d vector3d), got (vector3d int)"}},
  });
}

}  // namespace algebra3d
