// split, clip, section, shells: parts of solids.
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

Result<std::vector<Volume3d>> split_solid(Context& context, const Volume3d& solid, const Plane3d& plane) {
  A3D_ASSIGN(SolidParts parts, split(context, solid, plane.plane));
  return std::vector<Volume3d>{std::move(parts.in_front), std::move(parts.behind)};
}

Result<Volume3d> clip_solid(Context& context, const Volume3d& solid, const Box3& box) {
  return clipped(context, solid, box);
}

Result<Surface3d> section_of(Context& context, const Volume3d& solid, const Plane3d& plane) {
  return section(context, solid, plane.plane);
}

Result<std::vector<Surface3d>> shells_of(Context& context, const std::optional<Volume3d>& solid) {
  std::vector<Surface3d> shells;
  if (!solid) return shells;
  SubmeshMaker maker(solid->mesh());
  for (const std::vector<FaceId>& faces : connected_components(solid->mesh()).faces()) {
    A3D_TRY(context.check_cancelled());
    shells.push_back(Surface3d::trusted(maker.make(faces)));
  }
  return shells;
}

const std::string kInner = "(createCube (makePoint3D 0.5 0.5 0.5) (makePoint3D 1 1 1))";
const std::string kPlane = "(plane3d (0.5 0 0 1))";

void register_half_spaces(OperatorGroup& group) {
  group.add({
      .name = "split",
      .syntax = "_ split[_]",
      .doc = "The two parts of a solid on both sides of a plane: first the part in front of it, then the part behind "
             "it.",
      .detail = "The normal points to the front. Either part may be empty. Corners of the cut are exact.",
      .exactness = Exactness::exact,
      .overloads = {overload<&split_solid>("solid", "plane")},
      .examples = {{{kCubeOfTwo, kPlane}, "2", "(count _)"}, {{"(volume3d undefined)", kPlane}, "()"}},
      .errors = {{{kCubeOfTwo, "1"}, "split: expected (volume3d plane3d), got (volume3d int)"}},
  });
  group.add({
      .name = "clip",
      .syntax = "_ clip[_]",
      .doc = "The part of a solid that lies in a box.",
      .detail = "It is the intersection with the box as a solid; empty for a box without volume.",
      .exactness = Exactness::exact,
      .overloads = {overload<&clip_solid>("solid", "box")},
      .examples = {{{kCubeOfTwo, "(rectangle3 1 5 1 5 0 5)"}, "2.0", "(volume _)"},
                   {{kCubeOfTwo, "(rectangle3 3 5 1 5 0 5)"}, "0", "(size _)"},
                   {{kCubeOfTwo, "(rect3 undefined)"}, "undefined"}},
      .errors = {{{kCubeOfTwo, "1"}, "clip: expected (volume3d rect3), got (volume3d int)"}},
  });
}

void register_surfaces_of_solids(OperatorGroup& group) {
  group.add({
      .name = "section",
      .syntax = "section(_, _)",
      .doc = "The part of a plane inside a solid, as a surface with the normal of the plane.",
      .detail = "Faces of the solid in the plane are included; edges and corners that the plane only touches are not.",
      .exactness = Exactness::exact,
      .overloads = {overload<&section_of>("solid", "plane")},
      .examples = {{{kCubeOfTwo, kPlane}, "4.0", "(area _)"},
                   {{"(minus " + kCubeOfTwo + " " + kInner + ")", kPlane}, "4.0", "(area _)"},
                   {{"(minus " + kCubeOfTwo + " " + kInner + ")", "(plane3d (0.75 0 0 1))"}, "3.75", "(area _)"},
                   {{kCubeOfTwo, "(plane3d (3 0 0 1))"}, "0", "(size _)"},
                   {{"(volume3d undefined)", kPlane}, "undefined"}},
      .errors = {{{kCubeOfTwo, "1"}, "section: expected (volume3d plane3d), got (volume3d int)"}},
  });
  group.add({
      .name = "shells",
      .syntax = "shells(_)",
      .doc = "The closed surfaces that bound a solid, with normals pointing out of the solid.",
      .detail = "Triangles that share an edge are in one shell. Shells are in the order of their first triangles; an "
                "undefined or empty solid has none.",
      .exactness = Exactness::exact,
      .overloads = {overload<&shells_of>("solid")},
      .examples = {{{kCubeOfTwo}, "1", "(count _)"},
                   {{"(minus " + kCubeOfTwo + " " + kInner + ")"}, "2", "(count _)"},
                   {{"(volume3d undefined)"}, "0", "(count _)"}},
      .errors = {{{"1"}, "shells: expected (volume3d), got (int)"}},
  });
}

}  // namespace

void register_cuts(OperatorGroup& group) {
  register_half_spaces(group);
  register_surfaces_of_solids(group);
}

}  // namespace algebra3d
