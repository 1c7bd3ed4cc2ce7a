// Edits of manifold meshes: by hand on small ones, with every reason for refusal, and in random sequences. The result
// is audited by the editor's own auditor, and as a mesh that is linked anew from its faces: that knows nothing of the
// edits.
#include "algebra3d/kernel/halfedge/mesh_editor.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "mesh_samples.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;

PolygonMesh polygons(const Faces& faces, std::size_t vertex_count) {
  LargeVector<std::uint32_t> starts, corners;
  for (const auto& face : faces) {
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.insert(corners.end(), face.begin(), face.end());
  }
  starts.push_back(static_cast<std::uint32_t>(corners.size()));
  return {samples::points_for(vertex_count), PolygonLayout(std::move(starts)), std::move(corners)};
}

PolygonMesh polygons(const samples::Triangles& triangles) {
  Faces faces;
  std::size_t count = 0;
  for (const auto& [a, b, c] : triangles) {
    faces.push_back({a, b, c});
    count = std::max<std::size_t>({count, a + 1, b + 1, c + 1});
  }
  return polygons(faces, count);
}

Faces faces_of(const PolygonMesh& mesh) {
  Faces faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < mesh.degree(FaceId(f)); ++i)
      corners.push_back(mesh.origin(mesh.halfedge(FaceId(f), i)).index());
    faces.push_back(std::move(corners));
  }
  return faces;
}

/// The corners of the faces, each face from its lowest one: the order round a face is what counts.
Faces turned(Faces faces) {
  for (auto& face : faces) std::ranges::rotate(face, std::ranges::min_element(face));
  return faces;
}

MeshEditor editor_of(const PolygonMesh& mesh) {
  auto editor = MeshEditor::of(mesh);
  EXPECT_TRUE(editor);
  EXPECT_EQ(editor->audit(), std::vector<std::string>());
  return *std::move(editor);
}

/// The reason why the edge between two vertices cannot be collapsed; empty if it was.
std::string collapse(MeshEditor& editor, std::uint32_t from, std::uint32_t to) {
  const auto result = editor.collapse_edge(editor.find(VertexId(from), VertexId(to)));
  return result ? std::string() : result.reason();
}
std::string flip(MeshEditor& editor, std::uint32_t from, std::uint32_t to) {
  const auto result = editor.flip_edge(editor.find(VertexId(from), VertexId(to)));
  return result ? std::string() : result.reason();
}

void expect_sound(const MeshEditor& editor) {
  ASSERT_EQ(editor.audit(), std::vector<std::string>());
  const PolygonMesh mesh = editor.mesh();
  ASSERT_EQ(audit(mesh), std::vector<std::string>());
  ASSERT_TRUE(is_manifold(mesh));
  EXPECT_EQ(mesh.vertex_count(), editor.vertex_count());
  EXPECT_EQ(mesh.face_count(), editor.face_count());
  EXPECT_EQ(edge_count(mesh), editor.edge_count());
}

const Faces kCube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
const Faces kTwoTriangles{{0, 1, 2}, {0, 2, 3}};

TEST(MeshEditor, there_and_back_is_the_same_mesh) {
  for (const Faces& faces : {kCube, kTwoTriangles, Faces{{0, 1, 2, 3}, {0, 3, 4}}, Faces{}}) {
    const PolygonMesh mesh = polygons(faces, 9);
    const MeshEditor editor = editor_of(mesh);
    expect_sound(editor);
    EXPECT_EQ(faces_of(editor.mesh()), faces);
    EXPECT_EQ(editor.mesh().points(), mesh.points());
  }
}

TEST(MeshEditor, refuses_what_is_no_manifold) {
  EXPECT_EQ(MeshEditor::of(polygons({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5)).reason(),
            "the mesh is not a manifold: 3 faces meet at the edge between vertices 0 and 1");
  EXPECT_EQ(MeshEditor::of(polygons({{0, 1, 2}, {0, 3, 4}}, 5)).reason(),
            "the mesh is not a manifold: its faces at vertex 0 form 2 fans");
}

TEST(MeshEditor, flip_edge) {
  MeshEditor editor = editor_of(polygons(kTwoTriangles, 4));
  EXPECT_EQ(flip(editor, 0, 2), "");
  expect_sound(editor);
  EXPECT_EQ(turned(faces_of(editor.mesh())), (Faces{{1, 2, 3}, {0, 1, 3}}));
  EXPECT_TRUE(editor.find(VertexId(1), VertexId(3)).is_valid());
  EXPECT_FALSE(editor.find(VertexId(0), VertexId(2)).is_valid());
}

TEST(MeshEditor, flip_edge_is_refused) {
  MeshEditor two = editor_of(polygons(kTwoTriangles, 4));
  EXPECT_EQ(flip(two, 0, 1), "the edge is on the boundary");
  MeshEditor tetrahedron = editor_of(polygons(samples::tetrahedron()));
  EXPECT_EQ(flip(tetrahedron, 0, 1), "an edge joins vertices 3 and 2 already");
  // Vertex 4 stands in the middle of an edge.
  MeshEditor middle = editor_of(polygons({{0, 1, 4, 2}, {2, 4, 1, 3}}, 5));
  EXPECT_EQ(flip(middle, 1, 4), "vertex 4 would be left with one edge");
  MeshEditor slit = editor_of(polygons({{0, 3, 1, 2, 1}}, 4));
  EXPECT_EQ(flip(slit, 1, 2), "the same face is on both sides of the edge");
  // Two triangles on both sides of a vertex's two edges: the edge would end where it begins.
  MeshEditor pillow = editor_of(polygons(
      {
          {0, 1, 2},
          {1, 0, 2},
      },
      3));
  EXPECT_EQ(flip(pillow, 0, 1), "vertex 0 would be left with one edge");
  for (const MeshEditor* editor : {&two, &tetrahedron, &middle, &slit, &pillow}) expect_sound(*editor);
  EXPECT_EQ(faces_of(tetrahedron.mesh()), faces_of(polygons(samples::tetrahedron())));
}

TEST(MeshEditor, flip_edge_of_quads) {
  MeshEditor editor = editor_of(polygons(kCube, 8));
  EXPECT_EQ(flip(editor, 0, 1), "");
  expect_sound(editor);
  EXPECT_EQ(editor.valence(VertexId(0)), 2U);
  EXPECT_EQ(flip(editor, 0, 3), "vertex 0 would be left with one edge");
}

TEST(MeshEditor, split_edge) {
  MeshEditor editor = editor_of(polygons(kTwoTriangles, 4));
  const VertexId m = editor.split_edge(editor.find(VertexId(0), VertexId(2)), Vec3{5, 6, 7});
  expect_sound(editor);
  EXPECT_EQ(m, VertexId(4));
  EXPECT_EQ(editor.point(m), ExactPoint(Vec3{5, 6, 7}));
  EXPECT_EQ(editor.valence(m), 4U);
  EXPECT_EQ(editor.face_count(), 4U);
  // On the boundary one triangle is cut.
  editor.split_edge(editor.find(VertexId(0), VertexId(1)), Vec3{1, 1, 1});
  expect_sound(editor);
  EXPECT_EQ(editor.face_count(), 5U);
  MeshEditor cube = editor_of(polygons(kCube, 8));
  cube.split_edge(cube.find(VertexId(0), VertexId(1)), Vec3{});
  expect_sound(cube);
  EXPECT_EQ(cube.face_count(), 6U);
  EXPECT_EQ(cube.degree(FaceId(0)), 5U);
}

TEST(MeshEditor, collapse_edge) {
  MeshEditor editor = editor_of(polygons(samples::octahedron()));
  EXPECT_EQ(collapse(editor, 0, 2), "");
  expect_sound(editor);
  EXPECT_EQ(editor.face_count(), 6U);
  EXPECT_EQ(editor.vertex_count(), 5U);
  EXPECT_EQ(editor.edge_count(), 9U);
  MeshEditor cube = editor_of(polygons(kCube, 8));
  EXPECT_EQ(collapse(cube, 0, 1), "");
  expect_sound(cube);
  EXPECT_EQ(turned(faces_of(cube.mesh())),
            turned({{0, 2, 1}, {3, 4, 5, 6}, {0, 4, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 0, 3, 6}}));
}

TEST(MeshEditor, collapse_edge_is_refused) {
  MeshEditor tetrahedron = editor_of(polygons(samples::tetrahedron()));
  EXPECT_EQ(collapse(tetrahedron, 0, 1), "two triangles with the same corners would be left");
  MeshEditor triangle = editor_of(polygons({{0, 1, 2}}, 3));
  EXPECT_EQ(collapse(triangle, 0, 1), "vertex 2 would be left with one edge");
  MeshEditor strip = editor_of(polygons(kTwoTriangles, 4));
  EXPECT_EQ(collapse(strip, 0, 2), "the edge is inside, and both ends are on the boundary");
  // A triangular prism without its ends: vertex 2 closes a cycle of three edges that is not a face.
  MeshEditor tube = editor_of(polygons({{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}, 6));
  EXPECT_EQ(collapse(tube, 0, 1), "vertex 2 is joined to both ends, and not by a triangle along the edge");
  MeshEditor slit = editor_of(polygons({{0, 3, 1, 2, 1}}, 4));
  EXPECT_EQ(collapse(slit, 1, 2), "the same face is on both sides of the edge");
  // A triangle that hangs inside another face, at one of its corners.
  MeshEditor ear = editor_of(polygons({{0, 1, 2, 3, 0, 4, 5}, {0, 3, 2, 1}, {0, 5, 4}}, 6));
  EXPECT_EQ(collapse(ear, 4, 5), "vertex 4 would be left with one edge");
  for (const MeshEditor* editor : {&tetrahedron, &triangle, &strip, &tube, &slit, &ear}) expect_sound(*editor);
  EXPECT_EQ(faces_of(strip.mesh()), kTwoTriangles);
}

TEST(MeshEditor, collapse_edge_of_the_boundary) {
  MeshEditor strip = editor_of(polygons({{0, 1, 2}, {0, 2, 3}, {3, 2, 4}}, 5));
  EXPECT_EQ(collapse(strip, 0, 3), "");
  expect_sound(strip);
  EXPECT_EQ(faces_of(strip.mesh()).size(), 2U);
  EXPECT_EQ(turned(faces_of(strip.mesh())), turned({{0, 1, 2}, {0, 2, 3}}));
}

TEST(MeshEditor, split_face) {
  MeshEditor editor = editor_of(polygons({{0, 1, 2, 3, 4}}, 5));
  const auto added = editor.split_face(FaceId(0), VertexId(1), VertexId(3));
  ASSERT_TRUE(added);
  expect_sound(editor);
  EXPECT_EQ(*added, FaceId(1));
  EXPECT_EQ(faces_of(editor.mesh()), (Faces{{1, 2, 3}, {3, 4, 0, 1}}));
  EXPECT_EQ(editor.split_face(FaceId(0), VertexId(4), VertexId(1)).reason(), "vertex 4 is not a corner of face 0");
  EXPECT_EQ(editor.split_face(FaceId(0), VertexId(1), VertexId(4)).reason(), "vertex 4 is not a corner of face 0");
  EXPECT_EQ(editor.split_face(FaceId(0), VertexId(1), VertexId(1)).reason(), "both corners are the same");
  EXPECT_EQ(editor.split_face(FaceId(0), VertexId(1), VertexId(2)).reason(),
            "vertices 1 and 2 are neighbours in the face");
  // The diagonal of the other side.
  MeshEditor pillow = editor_of(polygons({{0, 1, 2, 3}, {1, 0, 3}, {1, 3, 2}}, 4));
  EXPECT_EQ(pillow.split_face(FaceId(0), VertexId(1), VertexId(3)).reason(), "an edge joins vertices 1 and 3 already");
  EXPECT_TRUE(pillow.split_face(FaceId(0), VertexId(0), VertexId(2)));
  expect_sound(pillow);
}

TEST(MeshEditor, split_face_at_a_point) {
  MeshEditor editor = editor_of(polygons({{0, 1, 2, 3, 4}, {1, 0, 5}}, 6));
  const auto added = editor.split_face(FaceId(0), Vec3{1, 2, 3});
  ASSERT_TRUE(added);
  expect_sound(editor);
  EXPECT_EQ(*added, VertexId(6));
  EXPECT_EQ(faces_of(editor.mesh()), (Faces{{0, 1, 6}, {1, 0, 5}, {1, 2, 6}, {2, 3, 6}, {3, 4, 6}, {4, 0, 6}}));
  EXPECT_EQ(editor.valence(*added), 5U);
  // An edge that ends in the face.
  MeshEditor dangling = editor_of(polygons({{0, 1, 2, 3, 4, 3}}, 5));
  EXPECT_EQ(dangling.split_face(FaceId(0), Vec3{}).reason(), "vertex 3 is two corners of face 0");
}

// Triangles stay triangles, and the collapse of the new edge gives them back.
TEST(MeshEditor, split_vertex_of_triangles_gives_triangles) {
  const PolygonMesh torus = polygons(samples::grid(6, 7, true, true));
  const auto is_triangle = [](const std::vector<std::uint32_t>& face) { return face.size() == 3; };
  for (std::uint32_t v = 0; v < 5; ++v)
    for (std::size_t turn = 1; turn < 6; ++turn) {
      MeshEditor editor = editor_of(torus);
      const HalfedgeId first = editor.outgoing(VertexId(v));
      HalfedgeId last = first;
      for (std::size_t i = 0; i < turn; ++i) last = editor.opposite(editor.prev(last));
      const auto added = editor.split_vertex(VertexId(v), first, last, Vec3{1, 2, 3});
      ASSERT_TRUE(added);
      expect_sound(editor);
      const Faces faces = faces_of(editor.mesh());
      EXPECT_TRUE(std::ranges::all_of(faces, is_triangle));
      EXPECT_EQ(faces.size(), torus.face_count() + 2);
      EXPECT_EQ(editor.edge_count(), torus.face_count() * 3 / 2 + 3);
      EXPECT_EQ(collapse(editor, v, added->index()), "");
      Faces after = turned(faces_of(editor.mesh())), before = turned(faces_of(torus));
      std::ranges::sort(after);
      std::ranges::sort(before);
      EXPECT_EQ(after, before);
    }
}

TEST(MeshEditor, split_vertex_and_collapse_are_inverse) {
  MeshEditor editor = editor_of(polygons(kCube, 8));
  const VertexId v(0), one(1), four(4);
  const HalfedgeId first = editor.find(v, one), last = editor.find(v, four);
  const auto added = editor.split_vertex(v, first, last, Vec3{1, 2, 3});
  ASSERT_TRUE(added);
  expect_sound(editor);
  EXPECT_EQ(editor.vertex_count(), 9U);
  EXPECT_EQ(editor.edge_count(), 13U);
  EXPECT_EQ(editor.valence(v) + editor.valence(*added), 5U);
  EXPECT_EQ(collapse(editor, 0, added->index()), "");
  expect_sound(editor);
  EXPECT_EQ(turned(faces_of(editor.mesh())), turned(kCube));
  EXPECT_EQ(editor.split_vertex(v, first, first, Vec3{}).reason(), "both edges are the same");
  EXPECT_EQ(editor.split_vertex(v, first, editor.opposite(first), Vec3{}).reason(),
            "an edge does not begin at vertex 0");
}

TEST(MeshEditor, move_vertex) {
  MeshEditor editor = editor_of(polygons(kCube, 8));
  const ExactPoint third(RationalVec3{Rational(1) / Rational(3), Rational(0), Rational(0)});
  editor.move_vertex(VertexId(2), third);
  EXPECT_EQ(editor.mesh().points().point(2), third);
}

TEST(MeshEditor, numbers_of_removed_elements_are_used_again) {
  MeshEditor editor = editor_of(polygons(samples::octahedron()));
  const std::size_t vertices = editor.vertex_slots(), halfedges = editor.halfedge_slots(), faces = editor.face_slots();
  for (int i = 0; i < 100; ++i) {
    const VertexId m = editor.split_edge(editor.find(VertexId(0), VertexId(2)), Vec3{});
    EXPECT_EQ(collapse(editor, 0, m.index()), "");
  }
  expect_sound(editor);
  EXPECT_EQ(editor.vertex_slots(), vertices + 1);
  EXPECT_EQ(editor.halfedge_slots(), halfedges + 6);
  EXPECT_EQ(editor.face_slots(), faces + 2);
}

/// A random edit; what fails must change nothing, which the audit cannot tell, so the counts are compared.
class RandomEdits {
 public:
  RandomEdits(MeshEditor& editor, unsigned seed, std::size_t size) : editor_(editor), random_(seed), size_(size) {}

  void edit() {
    const std::int64_t euler = characteristic();
    // Small meshes grow and large ones shrink.
    const std::size_t kind = below(editor_.vertex_count() > size_ ? 9 : 14);
    const HalfedgeId h = some_halfedge();
    if (kind < 3)
      (void)editor_.flip_edge(h);
    else if (kind < 8)
      (void)editor_.collapse_edge(h);
    else if (kind < 9)
      split_some_face(h);
    else if (kind < 10 && !editor_.is_boundary(h))
      (void)editor_.split_face(editor_.face(h), Vec3{});
    else if (kind < 11)
      (void)editor_.split_edge(h, Vec3{});
    else
      split_some_vertex(h);
    EXPECT_EQ(characteristic(), euler);
  }

 private:
  std::int64_t characteristic() const {
    return static_cast<std::int64_t>(editor_.vertex_count()) - static_cast<std::int64_t>(editor_.edge_count()) +
           static_cast<std::int64_t>(editor_.face_count());
  }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  HalfedgeId some_halfedge() {
    for (;;)
      if (const HalfedgeId h(below(editor_.halfedge_slots())); editor_.is_used(h)) return h;
  }
  void split_some_face(HalfedgeId h) {
    if (editor_.is_boundary(h)) return;
    HalfedgeId other = h;
    for (std::size_t steps = below(5); steps > 0; --steps) other = editor_.next(other);
    (void)editor_.split_face(editor_.face(h), editor_.origin(h), editor_.origin(other));
  }
  void split_some_vertex(HalfedgeId h) {
    HalfedgeId other = h;
    for (std::size_t steps = below(5); steps > 0; --steps) other = editor_.opposite(editor_.prev(other));
    (void)editor_.split_vertex(editor_.origin(h), h, other, Vec3{});
  }

  MeshEditor& editor_;
  std::mt19937 random_;
  std::size_t size_;
};

TEST(MeshEditor, random_edits_keep_a_manifold) {
  const std::size_t edits = rounds(20'000U);
  const std::vector<PolygonMesh> starts{
      polygons(kCube, 8), polygons(samples::octahedron()), polygons(samples::grid(6, 7, true, true)),
      polygons(samples::grid(5, 8, true, false)), polygons(samples::grid(6, 6, false, false))};
  unsigned seed = 0;
  for (const PolygonMesh& start : starts) {
    MeshEditor editor = editor_of(start);
    RandomEdits random(editor, ++seed, 150);
    const std::size_t loops = boundary_loops(start).size(), components = connected_components(start).count;
    for (std::size_t i = 1; i <= edits / starts.size(); ++i) {
      random.edit();
      if (i % 1000 != 0) continue;
      expect_sound(editor);
      if (testing::Test::HasFailure()) FAIL() << "start " << seed << ", edit " << i;
      const PolygonMesh mesh = editor.mesh();
      EXPECT_EQ(boundary_loops(mesh).size(), loops);
      EXPECT_EQ(connected_components(mesh).count, components);
      EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(start));
    }
  }
}

}  // namespace

/// Damages an editor, to see that `audit` finds it.
struct MeshEditorTester {
  static MeshEditor damaged(int how) {
    MeshEditor editor = editor_of(polygons(kCube, 8));
    if (how == 0) editor.halfedges_[3].next = HalfedgeId(2);
    if (how == 1) editor.halfedges_[3].opposite = HalfedgeId(7);
    if (how == 2) editor.halfedges_[3].face = FaceId(4);
    if (how == 3) editor.vertices_[3].outgoing = HalfedgeId(0);
    if (how == 4) editor.faces_[2] = HalfedgeId(0);
    if (how == 5) editor.halfedges_[5].origin = VertexId(1);
    if (how == 6) editor.free_faces_.emplace_back(3);
    if (how == 7) editor.vertices_[2].is_used = false;
    return editor;
  }
};

namespace {

TEST(MeshEditor, audit_finds_damage) {
  for (int how = 0; how < 8; ++how) EXPECT_FALSE(MeshEditorTester::damaged(how).audit().empty()) << how;
}

}  // namespace
}  // namespace algebra3d
