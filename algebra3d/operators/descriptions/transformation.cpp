// rotate, mirror, translate, scale, scaleDir.
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/motions.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

Result<Maybe<Region>> translated_region(Context& context, const Region& region, const Vector3d& by) {
  if (by.components.rational().z.sign() != 0) return Maybe<Region>(Undefined{"the vector leaves the plane"});
  return image_of(context, AffineMap::translation(by.components.rational()), region);
}

Result<Maybe<MovingRegion>> translated_motion(Context& context, const MovingRegion& moving, const Vector3d& by) {
  if (by.components.rational().z.sign() != 0) return Maybe<MovingRegion>(Undefined{"the vector leaves the plane"});
  return image_of(context, AffineMap::translation(by.components.rational()), moving);
}

const std::string kCuboid = "(createCube (makePoint3D 0 0 0) (makePoint3D 1 2 3))";
const std::string kPoint = "(makePoint3D 1 2 3)";
const std::string kRounding =
    "Each coordinate is rounded once; if that would make a surface or solid invalid, its exact image is kept, with a "
    "diagnostic. A value with coordinates that are not doubles, such as a union may have, keeps its exact image if "
    "the map is exact: a translation, a scaling by doubles, quarter turns about axes parallel to the coordinate "
    "axes, and reflections that map the directions of these axes to each other. For points3d this is decided per "
    "point. Triangles keep their order, and so do the vertices and faces of a mesh; a flat face of it may be bent by "
    "rounding. A reflection reverses the corners of its faces, the first one stays. Attributes of a mesh "
    "are kept; vectors called Normal turn with the faces.";

void register_motions(OperatorGroup& group) {
  group.add({
      .name = "rotate",
      .syntax = "_ rotate[_, _, _]",
      .doc = "Rotates about the axis through a point with a direction, right-handed, by an angle in degrees.",
      .detail = "Exact for quarter turns about coordinate axes and half turns about any axis; other angles have an "
                "error of at most 2^-50 rad. Undefined for a zero axis. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&rotated<Point3d>>("point", "centre", "axis", "degrees"),
                    overload<&rotated<Points3d>>("points", "centre", "axis", "degrees"),
                    overload<&rotated<Surface3d>>("surface", "centre", "axis", "degrees"),
                    overload<&rotated<Volume3d>>("solid", "centre", "axis", "degrees"),
                    overload<&rotated<Mesh3d>>("mesh", "centre", "axis", "degrees")},
      .examples = {{{kPoint, kOrigin, "(makeVector3D 0 0 1)", "90"}, "(-2.0 1.0 3.0)"},
                   {{kCuboid, kOrigin, "(makeVector3D 1 0 0)", "180"}, "(0.0 1.0 -2.0 0.0 -3.0 0.0)", "(bbox _)"},
                   {{kPoint, kOrigin, "(makeVector3D 0 0 0)", "90"}, "undefined"},
                   {{kUndefinedPoint, kOrigin, "(makeVector3D 0 0 1)", "90"}, "undefined"}},
      .errors = {{{kPoint, kOrigin, "90"}, "rotate: expected (point3d point3d vector3d real)"}},
  });
  group.add({
      .name = "mirror",
      .syntax = "_ mirror[_]",
      .doc = "The mirror image at a plane; the outside of a solid stays outside.",
      .detail = kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&mirrored<Point3d>>("point", "plane"), overload<&mirrored<Points3d>>("points", "plane"),
                    overload<&mirrored<Surface3d>>("surface", "plane"), overload<&mirrored<Volume3d>>("solid", "plane"),
                    overload<&mirrored<Mesh3d>>("mesh", "plane")},
      .examples = {{{kPoint, "(plane3d (2 0 0 1))"}, "(1.0 2.0 1.0)"},
                   {{kCuboid, "(plane3d (0 1 1 0))"}, "6.0", "(volume _)"},
                   {{kUndefinedPoint, "(plane3d (2 0 0 1))"}, "undefined"}},
      .errors = {{{kPoint, "1"}, "mirror: expected (point3d plane3d)"}},
  });
  group.add({
      .name = "translate",
      .syntax = "_ translate[_]",
      .doc = "Moved by a vector.",
      .detail =
          kRounding +
          " Translation by v and then by -v restores X if nothing is rounded: if the coordinates of X moved by v are "
          "doubles, or if both X and X moved by v have a coordinate that is not a double.",
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&translated<Point3d>>("point", "by"), overload<&translated<Points3d>>("points", "by"),
                    overload<&translated<Surface3d>>("surface", "by"), overload<&translated<Volume3d>>("solid", "by"),
                    overload<&translated<Mesh3d>>("mesh", "by"), overload<&translated_region>("region", "by"),
                    overload<&translated_motion>("moving", "by")},
      .examples = {{{kPoint, "(makeVector3D 1 0 -3)"}, "(2.0 2.0 0.0)"},
                   {{kCuboid, "(vector3d (10 0 0))"}, "(10.0 11.0 0.0 2.0 0.0 3.0)", "(bbox _)"},
                   {{"(region ((((0 0) (3 0) (0 4)))))", "(makeVector3D 1 -1 0)"},
                    "((((1.0 -1.0) (4.0 -1.0) (1.0 3.0))))"},
                   {{kUndefinedPoint, "(makeVector3D 1 0 -3)"}, "undefined"}},
      .errors = {{{kPoint, "1"}, "translate: expected (point3d vector3d)"}},
  });
}

}  // namespace

void register_transformation(OperatorGroup& group) {
  register_motions(group);
  group.add({
      .name = "scale",
      .syntax = "_ scale[_, _]",
      .doc = "Scales from a point by a factor: p + f(x - p).",
      .detail = "Undefined for surfaces and solids if the factor is zero; the outside of a solid stays outside if it "
                "is negative. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&scaled<Point3d>>("point", "centre", "factor"),
                    overload<&scaled<Points3d>>("points", "centre", "factor"),
                    overload<&scaled<Surface3d>>("surface", "centre", "factor"),
                    overload<&scaled<Volume3d>>("solid", "centre", "factor"),
                    overload<&scaled<Mesh3d>>("mesh", "centre", "factor")},
      .examples = {{{kPoint, "(makePoint3D 1 1 1)", "2"}, "(1.0 3.0 5.0)"},
                   {{kCuboid, kOrigin, "-2"}, "48.0", "(volume _)"},
                   {{kCuboid, kOrigin, "0"}, "undefined"},
                   {{kUndefinedPoint, kOrigin, "2"}, "undefined"}},
      .errors = {{{kPoint, "2"}, "scale: expected (point3d point3d real)"}},
  });
  group.add({
      .name = "scaleDir",
      .syntax = "_ scaleDir[_, _]",
      .doc = "Scales from a point by a factor per axis: p + v(x - p), componentwise.",
      .detail = "Undefined for surfaces and solids if a factor is zero; the outside of a solid stays outside if the "
                "factors mirror it. " +
                kRounding,
      .exactness = Exactness::rounded_once,
      .overloads = {overload<&scaled_by_axis<Point3d>>("point", "centre", "factors"),
                    overload<&scaled_by_axis<Points3d>>("points", "centre", "factors"),
                    overload<&scaled_by_axis<Surface3d>>("surface", "centre", "factors"),
                    overload<&scaled_by_axis<Volume3d>>("solid", "centre", "factors"),
                    overload<&scaled_by_axis<Mesh3d>>("mesh", "centre", "factors")},
      .examples = {{{kPoint, kOrigin, "(makeVector3D 1 0 -1)"}, "(1.0 0.0 -3.0)"},
                   {{kCuboid, kOrigin, "(makeVector3D 2 1 -1)"}, "(0.0 2.0 0.0 2.0 -3.0 0.0)", "(bbox _)"},
                   {{kCuboid, kOrigin, "(makeVector3D 2 0 1)"}, "undefined"},
                   {{kUndefinedPoint, kOrigin, "(makeVector3D 1 1 1)"}, "undefined"}},
      .errors = {{{kPoint, "2"}, "scaleDir: expected (point3d point3d vector3d)"}},
  });
}

}  // namespace algebra3d
