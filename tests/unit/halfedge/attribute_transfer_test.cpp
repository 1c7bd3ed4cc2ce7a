// Blends by hand, and attributes of edited meshes. The oracle of random edits is the geometry: an attribute that is the
// position of its vertex must still be so afterwards, and the value of a face says where its parts may lie.
#include "algebra3d/kernel/halfedge/attribute_transfer.h"

#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/mesh_editor.h"
#include "attribute_samples.h"
#include "base/indices.h"
#include "polygon_samples.h"

namespace algebra3d {
namespace {

using samples::real_values;
using Sources = std::vector<std::uint32_t>;

AttributeValues canonical_texts(const std::vector<std::string>& given) {
  return samples::text_values(given).canonical();
}

constexpr double kUndefinedNumber = std::numeric_limits<double>::quiet_NaN();

TEST(ValueBlends, means_of_numbers) {
  ValueBlends blends(4);
  EXPECT_EQ(blends.add_between(0, 1, 0.25), 4U);
  EXPECT_EQ(blends.add(std::array<ValueBlends::Term, 3>{{{0, 1}, {1, 2}, {4, 1}}}), 5U);
  EXPECT_EQ(blends.add_between(0, 3, 0.5), 6U);
  EXPECT_EQ(blends.add_between(2, 2, 0.3), 2U);
  EXPECT_EQ(blends.add_between(2, 1, 0), 2U);
  EXPECT_EQ(blends.add_between(2, 1, 1), 1U);
  EXPECT_EQ(blends.add_between(kNone, 1, 0.5), kNone);
  // 7/4 * 1 + ..., by hand: (1 + 2 * 5 + 2) / 4.
  EXPECT_EQ(blends.appended_to(real_values({1, 5, 0.1, kUndefinedNumber})),
            real_values({1, 5, 0.1, kUndefinedNumber, 2, 3.25, kUndefinedNumber}));
}

TEST(ValueBlends, equal_values_are_their_mean) {
  ValueBlends blends(3);
  blends.add(std::array<ValueBlends::Term, 3>{{{0, 0.1}, {1, 0.7}, {2, 1.0 / 3}}});
  EXPECT_EQ(blends.appended_to(real_values({0.3, 0.3, 0.3})), real_values({0.3, 0.3, 0.3, 0.3}));
}

TEST(ValueBlends, texts_are_kept_where_they_agree) {
  ValueBlends blends(4);
  blends.add_between(0, 1, 0.5);
  blends.add_between(0, 2, 0.5);
  blends.add_between(0, 3, 0.5);
  EXPECT_EQ(blends.appended_to(canonical_texts({"a", "a", "b", ""})).canonical(),
            canonical_texts({"a", "a", "b", "", "a", "", ""}));
}

TEST(AttributeTransfer, corners_of_merged_vertices_stay_in_their_chart) {
  // Four triangles in a row along the seam between vertices 1 and 4; vertex 4 is merged into vertex 1.
  const PolygonMesh before = samples::polygon_mesh_of({{0, 1, 4}, {1, 2, 4}, {4, 2, 5}, {4, 3, 0}});
  const auto corners =
      MeshAttributes().with(MeshElement::halfedge, "h", real_values({0, 1, 4, 11, 12, 14, 14, 12, 15, 4, 3, 0}));
  const PolygonMesh after = samples::polygon_mesh_of({{1, 2, 5}, {1, 3, 0}}, 6);
  const MeshAttributes kept =
      taken_over_merged(corners, before, after, {{0, 1, 2, 3, kNone, 5}, {}, {6, 7, 8, 9, 10, 11}, {2, 3}}, {});
  EXPECT_EQ(*kept.find(MeshElement::halfedge, "h")->values, real_values({11, 12, 15, 1, 3, 0}));
}

/// A mesh with attributes that can be told from the geometry.
struct Labelled {
  PolygonMesh mesh;
  MeshAttributes attributes;
};

AttributeValues positions(const PolygonMesh& mesh, std::span<const std::uint32_t> vertices) {
  AttributeValues values(AttributeKind::vector, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& p = mesh.points().approx()[vertices[i]];
    values.set(i, std::array{p.x, p.y, p.z});
  }
  return values;
}

Labelled labelled_grid(std::uint32_t n) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) points.push_back({8.0 * i, 8.0 * j, 0});
  PolygonMesh mesh =
      samples::polygon_mesh_of(samples::as_polygons(samples::grid(n, n, false, false)), PointArray(std::move(points)));
  Sources all(mesh.vertex_count());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  AttributeValues faces(AttributeKind::real, mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) faces.set(f, std::array{static_cast<double>(f)});
  MeshAttributes attributes = MeshAttributes()
                                  .with(MeshElement::vertex, "p", positions(mesh, all))
                                  .with(MeshElement::halfedge, "p", positions(mesh, mesh.origins()))
                                  .with(MeshElement::face, "f", faces);
  return {std::move(mesh), std::move(attributes)};
}

void expect_positions(const Labelled& now) {
  ASSERT_TRUE(now.attributes.fits(now.mesh));
  Sources all(now.mesh.vertex_count());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  EXPECT_EQ(*now.attributes.find(MeshElement::vertex, "p")->values, positions(now.mesh, all));
  EXPECT_EQ(*now.attributes.find(MeshElement::halfedge, "p")->values, positions(now.mesh, now.mesh.origins()));
}

/// Edits one at a time, as the operators do.
class LabelledEdits {
 public:
  LabelledEdits(Labelled start, unsigned seed) : now_(std::move(start)), random_(seed) {}
  const Labelled& now() const { return now_; }

  template <typename Edit>
  void apply(const Edit& edit) {
    auto editor = MeshEditor::of(now_.mesh);
    ASSERT_TRUE(editor);
    if (!edit(*editor, HalfedgeId(random_() % now_.mesh.halfedge_count()))) return;
    PolygonMesh mesh = editor->mesh();
    MeshAttributes attributes = editor->attributes(now_.attributes, now_.mesh, mesh);
    now_ = {std::move(mesh), std::move(attributes)};
  }
  void split_edge() {
    apply([&](MeshEditor& editor, HalfedgeId h) {
      const Vec3 a = editor.point(editor.origin(h)).approx(), b = editor.point(editor.target(h)).approx();
      editor.split_edge(h, 0.5 * (a + b));
      return true;
    });
  }
  void split_face() {
    apply([&](MeshEditor& editor, HalfedgeId h) {
      return bool(editor.split_face(editor.face(h), editor.origin(h), editor.origin(editor.next(editor.next(h)))));
    });
  }
  void split_vertex() {
    apply([&](MeshEditor& editor, HalfedgeId h) {
      const HalfedgeId other = editor.opposite(editor.prev(h));
      return bool(editor.split_vertex(editor.origin(h), h, other, editor.point(editor.origin(h))));
    });
  }
  void flip() {
    apply([&](MeshEditor& editor, HalfedgeId h) { return bool(editor.flip_edge(h)); });
  }
  void collapse() {
    apply([&](MeshEditor& editor, HalfedgeId h) { return bool(editor.collapse_edge(h)); });
  }

 private:
  Labelled now_;
  std::mt19937 random_;
};

TEST(AttributesOfEdits, positions_stay_those_of_the_vertices) {
  LabelledEdits edits(labelled_grid(6), 1);
  std::mt19937 random(2);
  for (int i = 0; i < 600; ++i) {
    switch (random() % 6) {
      case 0:
        edits.split_edge();
        break;
      case 1:
        edits.split_face();
        break;
      case 2:
        edits.split_vertex();
        break;
      case 3:
        edits.flip();
        break;
      default:
        edits.collapse();
    }
    expect_positions(edits.now());
    if (testing::Test::HasFailure()) FAIL() << "edit " << i;
  }
  EXPECT_GT(edits.now().mesh.face_count(), 8U);
}

TEST(AttributesOfEdits, parts_of_faces_have_the_values_of_the_whole) {
  const Labelled start = labelled_grid(3);
  LabelledEdits edits(start, 3);
  for (int i = 0; i < 60; ++i) edits.split_edge();
  const PolygonMesh& mesh = edits.now().mesh;
  ASSERT_GT(mesh.face_count(), start.mesh.face_count() + 60);
  const AttributeValues& faces = *edits.now().attributes.find(MeshElement::face, "f")->values;
  for (const FaceId f : algebra3d::faces(mesh)) {
    Vec3 centre;
    for (const VertexId v : vertices_of(mesh, f)) centre = centre + (1.0 / mesh.degree(f)) * mesh.point(v).approx;
    // Triangle 2 c is the half of square c below its diagonal, seen with the first coordinate to the right.
    const double column = std::floor(centre.x / 8), row = std::floor(centre.y / 8);
    const bool is_below = centre.x - 8 * column > centre.y - 8 * row;
    EXPECT_EQ(faces.numbers(f.index())[0], 2 * (3 * column + row) + (is_below ? 0 : 1));
  }
}

TEST(AttributesOfEdits, edges) {
  const PolygonMesh mesh = samples::polygon_mesh_of({{0, 1, 2}, {0, 2, 3}, {3, 2, 4}});
  // Edges 01, 12, 02, 23, 30, 24, 43.
  const auto given = MeshAttributes().with(MeshElement::edge, "e", real_values({1, 12, 2, 23, 30, 24, 43}));
  const auto after = [&](const auto& edit) {
    auto editor = MeshEditor::of(mesh);
    edit(*editor);
    const PolygonMesh result = editor->mesh();
    const MeshAttributes kept = editor->attributes(given, mesh, result);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> values;
    std::size_t e = 0;
    for (const HalfedgeId h : edges(result)) {
      const AttributeValues& all = *kept.find(MeshElement::edge, "e")->values;
      const double value = all.is_defined(e) ? all.numbers(e)[0] : -1;
      const std::uint32_t from = result.origin(h).index(), to = result.target(h).index();
      values[{std::min(from, to), std::max(from, to)}] = value;
      ++e;
    }
    return values;
  };
  using Values = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;
  EXPECT_EQ(after([](MeshEditor& m) { m.split_edge(m.find(VertexId(0), VertexId(2)), Vec3{}); }),
            (Values{{{0, 1}, 1},
                    {{1, 2}, 12},
                    {{0, 5}, 2},
                    {{2, 5}, 2},
                    {{1, 5}, -1},
                    {{3, 5}, -1},
                    {{2, 3}, 23},
                    {{0, 3}, 30},
                    {{2, 4}, 24},
                    {{3, 4}, 43}}));
  // A flipped edge keeps its value.
  EXPECT_EQ(after([](MeshEditor& m) { ASSERT_TRUE(m.flip_edge(m.find(VertexId(0), VertexId(2)))); }).at({1, 3}), 2);
  // Vertex 4 goes into 3: the edges 23 and 24 become one, and that at 3 counts.
  EXPECT_EQ(after([](MeshEditor& m) { ASSERT_TRUE(m.collapse_edge(m.find(VertexId(3), VertexId(4)))); }),
            (Values{{{0, 1}, 1}, {{1, 2}, 12}, {{0, 2}, 2}, {{2, 3}, 23}, {{0, 3}, 30}}));
}

TEST(AttributesOfEdits, an_edge_at_the_vertex_that_stays_counts_on_both_sides) {
  const PolygonMesh mesh = samples::polygon_mesh_of(samples::as_polygons(samples::octahedron()));
  AttributeValues ends(AttributeKind::real, 12);
  std::size_t e = 0;
  for (const HalfedgeId h : edges(mesh)) {
    const std::uint32_t from = mesh.origin(h).index(), to = mesh.target(h).index();
    ends.set(e++, std::array{10.0 * std::min(from, to) + std::max(from, to)});
  }
  auto editor = MeshEditor::of(mesh);
  ASSERT_TRUE(editor->collapse_edge(editor->find(VertexId(0), VertexId(2))));
  const PolygonMesh result = editor->mesh();
  const MeshAttributes kept = editor->attributes(MeshAttributes().with(MeshElement::edge, "e", ends), mesh, result);
  const AttributeValues& values = *kept.find(MeshElement::edge, "e")->values;
  std::set<double> found;
  for (std::size_t i = 0; i < values.size(); ++i) found.insert(values.numbers(i)[0]);
  // Without 02, and without the edges 24 and 25 that became one with 04 and 05.
  EXPECT_EQ(found, (std::set<double>{3, 4, 5, 12, 13, 14, 15, 34, 35}));
}

}  // namespace
}  // namespace algebra3d
