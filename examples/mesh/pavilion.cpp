// Builds a pavilion face by face, edits and subdivides it, asks for its neighbourhoods, and writes it as an OBJ file
// that is read again.
#include <algorithm>
#include <iostream>
#include <map>
#include <ranges>
#include <string>
#include <vector>

#include "algebra3d/mesh/builder.h"
#include "algebra3d/mesh/editor.h"
#include "algebra3d/mesh/files.h"
#include "algebra3d/mesh/mesh.h"
#include "algebra3d/mesh/normals.h"
#include "algebra3d/mesh/operations.h"
#include "algebra3d/mesh/shapes.h"
#include "algebra3d/mesh/topology.h"

namespace mesh = algebra3d::mesh;
using algebra3d::Result;
using algebra3d::Status;
using mesh::EdgeId;
using mesh::FaceId;
using mesh::HalfedgeId;
using mesh::PolygonMesh;
using mesh::VertexId;

namespace {

/// Four walls, a floor and a flat roof.
Result<PolygonMesh> block() {
  mesh::MeshBuilder builder;
  std::vector<VertexId> corner;
  for (const double z : {0.0, 3.0})
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(6.0, 0.0), std::pair(6.0, 4.0), std::pair(0.0, 4.0)}) {
      ALGEBRA3D_ASSIGN_OR_RETURN(const VertexId v, builder.add_vertex({x, y, z}));
      corner.push_back(v);
    }
  ALGEBRA3D_RETURN_IF_ERROR(builder.add_face({corner[3], corner[2], corner[1], corner[0]}));
  ALGEBRA3D_RETURN_IF_ERROR(builder.add_face({corner[4], corner[5], corner[6], corner[7]}));
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    ALGEBRA3D_RETURN_IF_ERROR(builder.add_face({corner[i], corner[j], corner[j + 4], corner[i + 4]}));
  }
  const Result<FaceId> second_roof = builder.add_face({corner[4], corner[5], corner[6]});
  std::cout << "refused: " << second_roof.error().text() << "\n";
  ALGEBRA3D_ASSIGN_OR_RETURN(const PolygonMesh walls, builder.mesh());
  return walls.with_attribute<FaceId>("Material",
                                      std::vector<std::string>{"stone", "slate", "brick", "glass", "brick", "brick"});
}

/// A pyramid in place of the flat roof.
Result<PolygonMesh> with_roof(const PolygonMesh& walls) {
  ALGEBRA3D_ASSIGN_OR_RETURN(mesh::MeshEditor editor, mesh::MeshEditor::of(walls));
  ALGEBRA3D_ASSIGN_OR_RETURN(const VertexId top, editor.split_face(FaceId(1), {3, 2, 3}));
  ALGEBRA3D_RETURN_IF_ERROR(editor.move_vertex(top, {3, 2, 5}));
  return editor.mesh();
}

Status describe(const std::string& name, const PolygonMesh& m) {
  std::map<std::size_t, std::size_t> degrees;
  for (const FaceId f : faces(m)) ++degrees[m.degree(f)];
  std::cout << name << ": " << m.vertex_count() << " vertices, " << m.edge_count() << " edges, " << m.face_count()
            << " faces (";
  for (const auto& [degree, count] : degrees) std::cout << " " << count << " of " << degree << " corners";
  ALGEBRA3D_ASSIGN_OR_RETURN(const algebra3d::Solid solid, mesh::solid_of(m));
  std::cout << " ), volume " << solid.volume() << "\n";
  return {};
}

void ask(const PolygonMesh& m) {
  const auto top = std::ranges::max(vertices(m), {}, [&](VertexId v) { return m.point(v).z; });
  auto heights = adjacent_vertices(m, top) | std::views::transform([&](VertexId v) { return m.point(v).z; });
  std::cout << "the top has " << std::ranges::distance(heights) << " neighbours at the height " << heights.front()
            << "\n";
  auto sharp = edges(m) | std::views::filter([&](EdgeId e) { return *dihedral_angle_degrees(m, e) > 60; });
  std::cout << std::ranges::distance(sharp) << " edges are sharper than 60 degrees\n";
}

/// The glass is taken out, which leaves a hole.
Status open_and_write(const PolygonMesh& m) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto material, (m.attribute<FaceId, std::string>("Material")));
  mesh::MeshBuilder builder(m);
  for (const FaceId f : faces(m))
    if (material[f] == "glass") ALGEBRA3D_RETURN_IF_ERROR(builder.remove_face(f));
  ALGEBRA3D_ASSIGN_OR_RETURN(const PolygonMesh open, builder.mesh());
  for (const mesh::BoundaryLoop& loop : boundary_loops(open))
    std::cout << "a hole with " << loop.halfedges.size() << " edges\n";
  ALGEBRA3D_RETURN_IF_ERROR(write_mesh(open, "pavilion.obj"));
  ALGEBRA3D_ASSIGN_OR_RETURN(const mesh::ReadMesh read, mesh::read_mesh("pavilion.obj"));
  ALGEBRA3D_ASSIGN_OR_RETURN(const mesh::RenderBuffers buffers, render_buffers(read.mesh, 30));
  std::cout << "read again: " << read.mesh.face_count() << " faces, " << buffers.triangles.size() / 3
            << " triangles to draw\n";
  return {};
}

Status run() {
  ALGEBRA3D_ASSIGN_OR_RETURN(const PolygonMesh walls, block());
  ALGEBRA3D_ASSIGN_OR_RETURN(const PolygonMesh pavilion, with_roof(walls));
  ALGEBRA3D_RETURN_IF_ERROR(describe("pavilion", pavilion));
  ask(pavilion);
  ALGEBRA3D_ASSIGN_OR_RETURN(const PolygonMesh round, subdivided(pavilion, "catmull-clark", 2));
  ALGEBRA3D_RETURN_IF_ERROR(describe("rounded", round));
  return open_and_write(round);
}

}  // namespace

int main() {
  const Status status = run();
  if (!status) std::cerr << status.error().text() << "\n";
  return status ? 0 : 1;
}
