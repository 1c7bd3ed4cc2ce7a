// surface2mesh, volume2mesh, mesh2surface, mesh2volume, triangulate.
#include <utility>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/constructions/mesh_conversions.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

template <typename T>
Result<Mesh3d> mesh_of(Context& context, const T& geometry) {
  A3D_ASSIGN(PolygonMesh mesh, polygon_mesh_of(geometry.mesh(), Merging::none, context.monitor()));
  return Mesh3d(std::move(mesh));
}

template <typename T>
Result<Mesh3d> merged_mesh_of(Context& context, const T& geometry, bool is_merged) {
  if (!is_merged) return mesh_of(context, geometry);
  A3D_ASSIGN(PolygonMesh mesh, polygon_mesh_of(geometry.mesh(), Merging::coplanar_facets, context.monitor()));
  return Mesh3d(std::move(mesh));
}

template <typename T>
Result<Maybe<T>> proved(Context& context, const Mesh3d& mesh) {
  A3D_ASSIGN(TriangleMesh triangles, welded_triangles_of(mesh.mesh(), context.monitor()));
  return T::prove(std::move(triangles), {.cancel = context.cancel});
}

Result<Mesh3d> triangulation_of(Context& context, const Mesh3d& mesh) {
  return triangulated(mesh, context.monitor());
}

const std::string kSquareMesh = "(mesh3d (((0 0 0) (1 0 0) (1 1 0) (0 1 0)) ((0 1 2 3))))";
const std::string kSquareSurface = "(surface3d (((0 0 0) (1 0 0) (1 1 0)) ((0 0 0) (1 1 0) (0 1 0))))";

const std::string kMergedDetail =
    "Vertices and triangles keep their order and their exact coordinates; points that no triangle uses are left out. "
    "If "
    "merged is TRUE, triangles in one plane that are connected across edges become one polygon, without the vertices "
    "within it and those within straight edges. Facets with holes, or whose boundary meets itself, stay triangulated.";
constexpr const char* kTriangulation =
    "A face that is convex, seen along the axis nearest to its normal, becomes a fan around "
    "its first corner; another one is triangulated without overlap, seen along that axis or, if it crosses itself "
    "there, along another one; so flat faces are triangulated in their plane. A face that crosses itself along all "
    "axes becomes triangles of least area.";

void register_conversions_to_meshes(OperatorGroup& group) {
  group.add({
      .name = "surface2mesh",
      .syntax = "surface2mesh(_ ...)",
      .doc = "A surface as a mesh of its triangles, or of the polygons that these make.",
      .detail = kMergedDetail,
      .exactness = Exactness::exact,
      .overloads = {overload<&mesh_of<Surface3d>>("surface"),
                    overload<&merged_mesh_of<Surface3d>>("surface", "merged")},
      .examples = {{{kSquareSurface}, "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2) (0 2 3)))"},
                   {{kSquareSurface, "TRUE"},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2 3)))"},
                   {{"(surface3d ())"}, "(() ())"},
                   {{"(surface3d undefined)"}, "undefined"}},
      .errors = {{{"1"}, "surface2mesh: expected (surface3d) or (surface3d bool), got (int)"}},
  });
  group.add({
      .name = "volume2mesh",
      .syntax = "volume2mesh(_ ...)",
      .doc = "The boundary of a solid as a mesh of its triangles, or of the polygons that these make.",
      .detail = kMergedDetail + " `mesh2volume(volume2mesh(V)) = V` for every V.",
      .exactness = Exactness::exact,
      .overloads = {overload<&mesh_of<Volume3d>>("solid"), overload<&merged_mesh_of<Volume3d>>("solid", "merged")},
      .examples = {{{kUnitCube}, "12", "(size _)"},
                   {{kUnitCube, "TRUE"}, "6", "(size _)"},
                   {{kUnitCube, "TRUE"}, "1.0", "(volume (mesh2volume _))"},
                   {{kUndefinedSolid}, "undefined"}},
      .errors = {{{"1"}, "volume2mesh: expected (volume3d) or (volume3d bool), got (int)"}},
  });
}

void register_conversions_of_meshes(OperatorGroup& group) {
  group.add({
      .name = "mesh2surface",
      .syntax = "mesh2surface(_)",
      .doc = "The surface of the faces of a mesh, triangulated.",
      .detail = std::string("Equal vertices are welded. ") + kTriangulation +
                " Undefined, with the defects, if the triangles are not a surface.",
      .exactness = Exactness::exact,
      .cost = Cost::sorting,
      .overloads = {overload<&proved<Surface3d>>("mesh")},
      .examples = {{{kSquareMesh},
                    "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0)) "
                    "((0.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)))"},
                   {{"(mesh3d (((0 0 0) (1 0 0) (2 0 0)) ((0 1 2))))"}, "undefined"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{"1"}, "mesh2surface: expected (mesh3d), got (int)"}},
  });
  group.add({
      .name = "mesh2volume",
      .syntax = "mesh2volume(_)",
      .doc = "The solid that the faces of a mesh bound, triangulated.",
      .detail = std::string("Equal vertices are welded. ") + kTriangulation +
                " Undefined, with the defects, if the triangles do not bound a solid with the faces outward.",
      .exactness = Exactness::exact,
      .cost = Cost::sorting,
      .overloads = {overload<&proved<Volume3d>>("mesh")},
      .examples = {{{"(volume2mesh " + kUnitCube + ")"}, "1.0", "(volume _)"},
                   {{kSquareMesh}, "undefined"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{"1"}, "mesh2volume: expected (mesh3d), got (int)"}},
  });
  group.add({
      .name = "triangulate",
      .syntax = "triangulate(_)",
      .doc = "A mesh with its faces triangulated, over the same vertices.",
      .detail = std::string("The triangles of a face stand in its place. ") + kTriangulation +
                " Corners that repeat the vertex before them do not count.",
      .exactness = Exactness::exact,
      .overloads = {overload<&triangulation_of>("mesh")},
      .examples = {{{kSquareMesh}, "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.0) (0.0 1.0 0.0)) ((0 1 2) (0 2 3)))"},
                   {{kUndefinedMesh}, "undefined"}},
      .errors = {{{"1"}, "triangulate: expected (mesh3d), got (int)"}},
  });
}

}  // namespace

void register_meshes(OperatorGroup& group) {
  register_conversions_to_meshes(group);
  register_conversions_of_meshes(group);
}

}  // namespace algebra3d
