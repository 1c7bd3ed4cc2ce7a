#include "algebra3d/kernel/halfedge/mesh_attributes.h"

#include <gtest/gtest.h>

#include "attribute_samples.h"
#include "base/indices.h"
#include "polygon_samples.h"

namespace algebra3d {
namespace {

using samples::polygon_mesh_of;
using samples::PolygonBruteForce;
using samples::real_values;
using samples::text_values;
using Numbers = std::vector<std::uint32_t>;

TEST(MeshAttributes, absent_ones_take_no_memory) {
  const MeshAttributes none;
  EXPECT_TRUE(none.is_empty());
  EXPECT_EQ(none.heap_bytes(), 0U);
  EXPECT_EQ(none.all().size(), 0U);
  EXPECT_TRUE(none.with(MeshElement::face, "a", real_values({1})).without(MeshElement::face, "a").is_empty());
}

TEST(MeshAttributes, are_sorted_by_element_and_name) {
  const MeshAttributes attributes = MeshAttributes()
                                        .with(MeshElement::face, "b", real_values({1}))
                                        .with(MeshElement::vertex, "z", real_values({1}))
                                        .with(MeshElement::face, "a", real_values({1}))
                                        .with(MeshElement::face, "b", real_values({2}));
  ASSERT_EQ(attributes.all().size(), 3U);
  EXPECT_EQ(attributes.all()[0].name, "z");
  EXPECT_EQ(attributes.all()[1].name, "a");
  EXPECT_EQ(attributes.find(MeshElement::face, "b")->values->numbers(0)[0], 2);
  EXPECT_EQ(attributes.find(MeshElement::vertex, "b"), nullptr);
}

TEST(MeshAttributes, equal_values_are_stored_alike) {
  AttributeValues detours = text_values({"x", "b", "c"});
  detours.set_text(0, detours.add_text("b"));
  detours.set_text(1, detours.add_text("a"));
  detours.clear(2);
  const auto a = MeshAttributes().with(MeshElement::face, "t", detours);
  const auto b = MeshAttributes().with(MeshElement::face, "t", text_values({"b", "a", ""}));
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.all()[0].values->texts(), (std::vector<std::string>{"b", "a"}));
  EXPECT_NE(a, MeshAttributes().with(MeshElement::face, "t", text_values({"b", "a", "a"})));
}

TEST(MeshAttributes, numbers_that_are_not_finite_are_undefined_and_zeros_positive) {
  const AttributeValues values = real_values({-0.0, std::numeric_limits<double>::infinity(), std::nan("")});
  EXPECT_FALSE(std::signbit(values.numbers(0)[0]));
  EXPECT_TRUE(values.is_defined(0));
  EXPECT_FALSE(values.is_defined(1));
  EXPECT_FALSE(values.is_defined(2));
  EXPECT_EQ(values, real_values({0.0, std::nan(""), -std::nan("")}));
  EXPECT_LT(values, real_values({0.0, -1e300, 0}));
}

TEST(MeshAttributes, order_is_total) {
  const std::vector<AttributeValues> ascending{
      real_values({}),   real_values({std::nan("")}), real_values({-1}),
      real_values({2}),  real_values({0, 0}),         AttributeValues(AttributeKind::pair, 1),
      text_values({""}), text_values({"a"}),          text_values({"b"})};
  for (std::size_t i = 0; i < ascending.size(); ++i)
    for (std::size_t j = 0; j < ascending.size(); ++j) EXPECT_EQ(ascending[i] <=> ascending[j], i <=> j) << i << j;
}

TEST(MeshAttributes, taken_over_go_with_their_elements) {
  const auto attributes = MeshAttributes()
                              .with(MeshElement::vertex, "v", real_values({0, 1, 2}))
                              .with(MeshElement::face, "f", text_values({"a", "b"}))
                              .with(MeshElement::halfedge, "h", real_values({5, 6}));
  const MeshAttributes moved = taken_over(attributes, {{2, kNone, 0, 2}, {}, {1}, {1, 1, kNone}});
  EXPECT_EQ(*moved.find(MeshElement::vertex, "v")->values, real_values({2, std::nan(""), 0, 2}));
  EXPECT_EQ(*moved.find(MeshElement::face, "f")->values, text_values({"b", "b", ""}).canonical());
  EXPECT_EQ(*moved.find(MeshElement::halfedge, "h")->values, real_values({6}));
}

TEST(MeshAttributes, edges_are_numbered_by_their_first_halfedges) {
  for (const samples::PolygonList& polygons : samples::all_polygon_kinds()) {
    const PolygonMesh mesh = polygon_mesh_of(polygons);
    const PolygonBruteForce brute(polygons);
    Numbers expected(brute.halfedge_count());
    std::uint32_t count = 0;
    for (std::uint32_t h = 0; h < brute.halfedge_count(); ++h)
      expected[h] = brute.along(h)[0] == h ? count++ : expected[brute.along(h)[0]];
    ASSERT_EQ(edge_numbers(mesh), expected);
    ASSERT_EQ(element_count(mesh, MeshElement::edge), count);
  }
}

TEST(MeshAttributes, edge_sources_follow_the_halfedges) {
  const PolygonMesh two = polygon_mesh_of({{0, 1, 2}, {1, 0, 3}});
  const PolygonMesh second = polygon_mesh_of({{1, 0, 3}}, 4);
  EXPECT_EQ(edge_sources(second, two, Numbers{3, 4, 5}), (Numbers{0, 3, 4}));
  EXPECT_EQ(edge_sources(second, two, Numbers{3, kNone, 5}), (Numbers{0, kNone, 4}));
}

TEST(MeshAttributes, fit_if_each_element_has_a_value) {
  const PolygonMesh mesh = polygon_mesh_of(samples::cube());
  EXPECT_TRUE(MeshAttributes().fits(mesh));
  EXPECT_TRUE(MeshAttributes().with(MeshElement::edge, "e", AttributeValues(AttributeKind::real, 12)).fits(mesh));
  EXPECT_FALSE(MeshAttributes().with(MeshElement::edge, "e", AttributeValues(AttributeKind::real, 24)).fits(mesh));
}

}  // namespace
}  // namespace algebra3d
