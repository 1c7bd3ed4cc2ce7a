// Edits of meshes whose faces have slits, dangling edges and bridges: edges with one face on both sides. By hand, and
// in random sequences against an oracle that knows lists of corners only (face_list_edits.h).
#include <gtest/gtest.h>

#include <random>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/mesh_editor.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "face_list_edits.h"
#include "mesh_samples.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using Face = FaceLists::Face;
using Faces = std::vector<Face>;

PolygonMesh polygons(const Faces& faces) {
  LargeVector<std::uint32_t> starts, corners;
  std::size_t count = 0;
  for (const Face& face : faces) {
    starts.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.insert(corners.end(), face.begin(), face.end());
    for (const std::uint32_t corner : face) count = std::max<std::size_t>(count, corner + 1);
  }
  starts.push_back(static_cast<std::uint32_t>(corners.size()));
  return {samples::points_for(count), PolygonLayout(std::move(starts)), std::move(corners)};
}

/// The faces by the numbers of the editor.
Faces faces_of(const MeshEditor& editor) {
  Faces faces;
  for (std::size_t f = 0; f < editor.face_slots(); ++f) {
    if (!editor.is_used(FaceId(f))) continue;
    Face& face = faces.emplace_back();
    const HalfedgeId first = editor.halfedge(FaceId(f));
    HalfedgeId h = first;
    do {
      face.push_back(editor.origin(h).index());
      h = editor.next(h);
    } while (h != first && face.size() <= editor.halfedge_slots());
  }
  return faces;
}

Faces canonical(const Faces& faces) {
  return FaceLists(faces).canonical();
}

/// The faces after an edge is split; none if the mesh cannot be edited.
Faces with_split_edge(const Faces& faces, std::uint32_t from, std::uint32_t to) {
  auto editor = MeshEditor::of(polygons(faces));
  if (!editor) return {};
  editor->split_edge(editor->find(VertexId(from), VertexId(to)), Vec3{});
  EXPECT_EQ(editor->audit(), std::vector<std::string>());
  return canonical(faces_of(*editor));
}

const Face kSlit{0, 1, 2, 3, 4, 3};             // a square with a slit from a corner to the middle
const Face kBridge{0, 1, 2, 3, 0, 4, 5, 6, 4};  // and with a hole that is joined to a corner
const Face kTree{0, 1, 2, 1};                   // an edge in two parts, and nothing else

TEST(MeshEditorSlits, split_edge_at_the_tip_of_a_slit) {
  EXPECT_EQ(with_split_edge({kSlit}, 3, 4), canonical({{0, 1, 2, 3, 5, 4, 5, 3}}));
  EXPECT_EQ(with_split_edge({kSlit}, 4, 3), canonical({{0, 1, 2, 3, 5, 4, 5, 3}}));
  EXPECT_EQ(with_split_edge({kTree}, 0, 1), canonical({{0, 3, 1, 2, 1, 3}}));
  EXPECT_EQ(with_split_edge({kTree}, 2, 1), canonical({{0, 1, 3, 2, 3, 1}}));
}

TEST(MeshEditorSlits, split_edge_of_a_bridge) {
  EXPECT_EQ(with_split_edge({kBridge}, 0, 4), canonical({{0, 1, 2, 3, 0, 7, 4, 5, 6, 4, 7}}));
  EXPECT_EQ(with_split_edge({kBridge}, 4, 0), canonical({{0, 1, 2, 3, 0, 7, 4, 5, 6, 4, 7}}));
}

TEST(MeshEditorSlits, split_edge_between_triangles_with_the_same_corners) {
  EXPECT_EQ(with_split_edge({{0, 1, 2}, {1, 0, 2}}, 0, 1), canonical({{0, 3, 2}, {3, 1, 2}, {1, 3, 0, 2}}));
}

/// Random meshes with slits, dangling edges and bridges.
class RandomMeshes {
 public:
  explicit RandomMeshes(unsigned seed) : random_(seed) {}

  Faces next() {
    Faces faces = base();
    for (std::size_t n = 1 + below(6); n > 0; --n) below(4) == 0 ? add_bridge(faces) : add_dangling_edge(faces);
    return faces;
  }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

 private:
  Faces base() {
    static const Faces kCube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    static const std::vector<samples::Triangles> kTriangles{samples::tetrahedron(), samples::octahedron(),
                                                            samples::grid(3, 4, true, true),
                                                            samples::grid(3, 4, true, false)};
    const std::size_t kind = below(4 + kTriangles.size());
    if (kind == 0) return kCube;
    if (kind == 1) return {kBridge};
    if (kind == 2) return {kTree};
    if (kind == 3) return {{0, 1, 2}, {1, 0, 3, 4}};
    Faces faces;
    for (const auto& [a, b, c] : kTriangles[kind - 4]) faces.push_back({a, b, c});
    return faces;
  }
  static std::uint32_t vertex_count(const Faces& faces) {
    std::uint32_t count = 0;
    for (const Face& face : faces) count = std::max(count, *std::ranges::max_element(face) + 1);
    return count;
  }

  /// From a corner of a face into it and back; corners of such edges included, so that they branch.
  void add_dangling_edge(Faces& faces) {
    const std::uint32_t added = vertex_count(faces);
    Face& face = faces[below(faces.size())];
    const std::size_t corner = below(face.size());
    const std::uint32_t from = face[corner];
    face.insert(face.begin() + static_cast<std::ptrdiff_t>(corner) + 1, {added, from});
  }

  /// From a corner of a face to another mesh, one of whose faces becomes a part of that face.
  void add_bridge(Faces& faces) {
    const std::uint32_t offset = vertex_count(faces);
    Faces others = base();
    for (Face& face : others)
      for (std::uint32_t& corner : face) corner += offset;
    Face other = others.back();
    others.pop_back();
    other.push_back(other.front());
    Face& face = faces[below(faces.size())];
    const std::size_t corner = below(face.size());
    other.push_back(face[corner]);
    face.insert(face.begin() + static_cast<std::ptrdiff_t>(corner) + 1, other.begin(), other.end());
    faces.insert(faces.end(), others.begin(), others.end());
  }

  std::mt19937 random_;
};

/// Edits a mesh and its oracle in the same way.
class ComparedEdits {
 public:
  ComparedEdits(MeshEditor& editor, RandomMeshes& random) : editor_(editor), random_(random) {}

  /// False if the results differ. A refused edit must change nothing.
  void edit() {
    FaceLists expected(faces_of(editor_));
    const HalfedgeId h = some_halfedge();
    const std::uint32_t a = editor_.origin(h).index(), b = editor_.target(h).index();
    const std::size_t kind = random_.below(6);
    SCOPED_TRACE(testing::Message() << "kind " << kind << ", edge " << a << " " << b);
    if (kind == 0) {
      EXPECT_EQ(bool(editor_.flip_edge(h)), expected.flip(a, b));
    }
    if (kind == 1 || kind == 2) expected.split_edge(a, b, editor_.split_edge(h, Vec3{}).index());
    if (kind == 3) {
      EXPECT_EQ(bool(editor_.collapse_edge(h)), expected.collapse(a, b));
    }
    if (kind == 4) split_face(h, expected);
    if (kind == 5) split_vertex(h, expected);
    EXPECT_EQ(expected.canonical(), canonical(faces_of(editor_)));
    EXPECT_EQ(editor_.audit(), std::vector<std::string>());
  }

 private:
  HalfedgeId some_halfedge() {
    for (;;)
      if (const HalfedgeId h(random_.below(editor_.halfedge_slots())); editor_.is_used(h)) return h;
  }

  void split_face(HalfedgeId h, FaceLists& expected) {
    if (editor_.is_boundary(h)) return;
    HalfedgeId other = h;
    for (std::size_t steps = random_.below(6); steps > 0; --steps) other = editor_.next(other);
    // The oracle has the used faces only, in their order, from their first half-edges on.
    std::size_t number = 0;
    for (std::size_t f = 0; f < editor_.face(h).index(); ++f) number += editor_.is_used(FaceId(f)) ? 1 : 0;
    const VertexId from = editor_.origin(h), to = editor_.origin(other);
    const bool is_done = bool(editor_.split_face(editor_.face(h), from, to));
    EXPECT_EQ(is_done, expected.split_face(number, from.index(), to.index()));
  }

  void split_vertex(HalfedgeId h, FaceLists& expected) {
    HalfedgeId other = h;
    for (std::size_t steps = random_.below(5); steps > 0; --steps) other = editor_.opposite(editor_.prev(other));
    const VertexId v = editor_.origin(h), first = editor_.target(h), last = editor_.target(other);
    const auto added = editor_.split_vertex(v, h, other, Vec3{});
    const std::uint32_t number = added ? added->index() : 0;
    EXPECT_EQ(bool(added), expected.split_vertex(v.index(), first.index(), last.index(), number));
  }

  MeshEditor& editor_;
  RandomMeshes& random_;
};

TEST(MeshEditorSlits, random_edits_are_those_of_face_lists) {
  constexpr std::size_t kEditsOfAMesh = 25;
  const std::size_t meshes = rounds(600U);
  RandomMeshes random(1);
  std::size_t edited = 0;
  for (std::size_t mesh = 0; mesh < meshes && !testing::Test::HasFailure(); ++mesh) {
    SCOPED_TRACE(testing::Message() << "mesh " << mesh);
    const PolygonMesh start = polygons(random.next());
    auto editor = MeshEditor::of(start);
    ASSERT_TRUE(editor) << editor.reason();
    ++edited;
    ComparedEdits edits(*editor, random);
    for (std::size_t i = 0; i < kEditsOfAMesh && !testing::Test::HasFailure(); ++i) edits.edit();
    const PolygonMesh result = editor->mesh();
    EXPECT_EQ(audit(result), std::vector<std::string>());
    EXPECT_TRUE(is_manifold(result));
    EXPECT_EQ(euler_characteristic(result), euler_characteristic(start));
  }
  EXPECT_EQ(edited, meshes);
}

}  // namespace
}  // namespace algebra3d
