// Well-known text: what is read, what is refused with which words, and back.
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/values/conversions/wkt.h"
#include "algebra3d/values/types/planar.h"
#include "support/plane_shapes.h"
#include "unit/operators/call_operator.h"

namespace algebra3d::wkt_tests {
namespace {

using calls::Answer;
using calls::call;

Answer read_wkt(const std::string& text) {
  return call("wkt2region", Text{text});
}
std::string region_text(const std::string& wkt) {
  const Answer answer = read_wkt(wkt);
  EXPECT_TRUE(answer.is_defined()) << wkt << ": " << testing::PrintToString(answer.diagnostics);
  return answer.text();
}
std::string reason(const std::string& wkt) {
  const Answer answer = read_wkt(wkt);
  EXPECT_FALSE(answer.is_defined()) << wkt;
  EXPECT_EQ(answer.diagnostics.size(), 1U);
  return answer.diagnostics.empty() ? "" : answer.diagnostics.front();
}

const std::string kTriangle = "((((0.0 0.0) (4.0 0.0) (4.0 4.0))))";

TEST(Wkt, forms_of_the_same_triangle) {
  for (const char* text :
       {"POLYGON((0 0,4 0,4 4,0 0))", "polygon ( ( 0 0 , 4 0 , 4 4 , 0 0 ) )", "\n\tPolygon\n((0\t0,4 0,4 4,0 0))\r\n",
        "SRID=4326;POLYGON((0 0,4 0,4 4,0 0))", " srid = -1 ; POLYGON((0 0,4 0,4 4,0 0))",
        "POLYGON Z ((0 0 1,4 0 2,4 4 3,0 0 1))", "POLYGONZ((0 0 1,4 0 2,4 4 3,0 0 1))",
        "POLYGON M ((0 0 1,4 0 2,4 4 3,0 0 1))", "polygon zm((0 0 1 9,4 0 2 9,4 4 3 9,0 0 1 9))",
        "POLYGON((0 0 1,4 0 2,4 4 3,0 0 1))", "POLYGON((0 0 1 9,4 0 2 9,4 4 3 9,0 0 1 9))",
        "MULTIPOLYGON(((0 0,4 0,4 4,0 0)))", "MULTIPOLYGON(EMPTY,((0 0,4 0,4 4,0 0)),empty)",
        "POLYGON((0 0,0 0,4 0,4 4,4 4,4 4,0 0,0 0))", "POLYGON((+0 -0,4. 0,4e0 .4E+1,0 0))",
        "POLYGON((0 0 1,4 0 1,4 4 1,0 0 2))"})
    EXPECT_EQ(region_text(text), kTriangle) << text;
}

TEST(Wkt, clockwise_rings_are_turned) {
  EXPECT_EQ(region_text("POLYGON((0 0,4 4,4 0,0 0))"), "((((0.0 0.0) (4.0 0.0) (4.0 4.0))))");
}

TEST(Wkt, empty_forms) {
  for (const char* text : {"POLYGON EMPTY", "multipolygon empty", "POLYGON ZM EMPTY", "MULTIPOLYGONM EMPTY",
                           "MULTIPOLYGON (EMPTY, EMPTY)", "SRID=1;POLYGON EMPTY"})
    EXPECT_EQ(region_text(text), "()") << text;
}

TEST(Wkt, decimals_become_the_nearest_doubles) {
  // 1 + 2^-53 lies between the digits 404 and 405 at the end.
  const auto region = read_wkt(
                          "POLYGON((0.1 0,1.00000000000000011102230246251565404 0,"
                          "1.00000000000000011102230246251565405 4,0.1 0))")
                          .get<Region>();
  const std::vector<Vec3>& corners = region.polygons().corners.approx();
  EXPECT_EQ(corners, (std::vector<Vec3>{{0.1, 0, 0}, {1, 0, 0}, {1 + 0x1p-52, 4, 0}}));
}

TEST(Wkt, malformed_texts_say_where_and_what) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"", "character 1: found the end of the text, expected POLYGON or MULTIPOLYGON"},
      {"POINT (1 2)", "character 1: found 'POINT', expected POLYGON or MULTIPOLYGON"},
      {"POLYGONE ((0 0))", "character 1: found 'POLYGONE', expected POLYGON or MULTIPOLYGON"},
      {"POLYGON", "character 8: found the end of the text, expected '('"},
      {"POLYGON 0 0", "character 9: found '0', expected '('"},
      {"POLYGON FULL", "character 9: found 'FULL', expected '(' or EMPTY"},
      {"MULTIPOLYGON Q", "character 14: found 'Q', expected '(' or EMPTY"},
      {"POLYGON (0 0)", "character 10: found '0', expected '('"},
      {"POLYGON ((0 0, 4))", "character 17: found ')', expected a number"},
      {"POLYGON ((0 0, 4 x", "character 18: found 'x', expected a number"},
      {"POLYGON ((0 0, 4 nan", "character 18: found 'nan', expected a number"},
      {"POLYGON ((0 0, 4 1e999", "character 18: found '1e999', expected a number within the range of doubles"},
      {"POLYGON ((0 0, 4 1-2", "character 18: found '1-2', expected a number"},
      {"POLYGON ((0 0 4 4 5", "character 19: found '5', expected ',' or ')'"},
      {"POLYGON Z ((0 0, 4 4", "character 16: found ',', expected a number"},
      {"POLYGON Z ((0 0 1 1", "character 19: found '1', expected ',' or ')'"},
      {"POLYGON ((0 0, 4 0, 4 4))",
       "character 24: found a ring from (0 0) to (4 4), expected its first point again at its end"},
      {"POLYGON ((0 0, 4 0, 4 4, 0 0)) ;", "character 32: found ';', expected the end of the text"},
      {"POLYGON ((0 0, 4 0, 4 4, 0 0)", "character 30: found the end of the text, expected ',' or ')'"},
      {"POLYGON ((0 0, 4 0, 4 4, 0 0) (", "character 31: found '(', expected ',' or ')'"},
      {"SRID 4326", "character 6: found '4326', expected '='"},
      {"SRID=x", "character 6: found 'x', expected an integer"},
      {"SRID=1 POLYGON", "character 8: found 'POLYGON', expected ';'"},
      {"POLYGON ((\xc3\xa4", "character 11: found '\\xc3', expected a number"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(reason(text), std::string("wkt2region: ") + message) << text;
}

TEST(Wkt, polygons_that_bound_no_region_name_the_segments) {
  EXPECT_NE(reason("POLYGON((0 0,4 4,4 0,0 4,0 0))").find("(0 0)-(4 4)"), std::string::npos);
  EXPECT_EQ(reason("POLYGON((0 0,4 0,0 0))"), "wkt2region: face 1, cycle 1 has 2 corners, expected at least 3");
  EXPECT_EQ(reason("POLYGON((0 0))"), "wkt2region: face 1, cycle 1 has 1 corners, expected at least 3");
}

TEST(Wkt, random_regions_come_back) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 60; ++i) {
    const double away = i % 3 == 0 ? 1e-3 : 1e6;
    std::vector<plane_shapes::Face> faces{
        {plane_shapes::on_grid(plane_shapes::star(5 + i, 0.4, 5, random)),
         plane_shapes::reversed(plane_shapes::on_grid(plane_shapes::star(3 + i, 0.333333, 1.5, random)))}};
    if (i % 2 == 1)
      faces.push_back(
          {plane_shapes::shifted(plane_shapes::on_grid(plane_shapes::star(4 + i, 0.4, 5, random)), 20, away)});
    const Region region = **Region::prove(plane_shapes::polygons_of(faces));
    const Answer text = call("region2wkt", region);
    EXPECT_TRUE(text.diagnostics.empty());
    const Region back = read_wkt(text.get<Text>().content).get<Region>();
    EXPECT_EQ(back.polygons(), region.polygons());
  }
}

TEST(Wkt, rounding_is_told) {
  const auto thirds = calls::literal<Region>("((((0 0) (1 0) (1/3 2/3))))");
  const Answer text = call("region2wkt", thirds);
  EXPECT_EQ(text.get<Text>().content, "POLYGON ((0 0, 1 0, 0.3333333333333333 0.6666666666666666, 0 0))");
  EXPECT_EQ(text.diagnostics, (std::vector<std::string>{"region2wkt: rounded 1 corner to doubles"}));

  const auto sliver = calls::literal<Region>(
      "((((0 0) (1 0) (100000000000000000000000000001/100000000000000000000000000000 1/1000000))))");
  EXPECT_EQ(call("region2wkt", sliver).diagnostics.size(), 1U);
  const auto thin = calls::literal<Region>("((((0 0) (3 1) (1 100000000000000000001/300000000000000000000))))");
  const Answer flat = call("region2wkt", thin);
  ASSERT_EQ(flat.diagnostics.size(), 1U);
}

TEST(Wkt, every_beginning_of_a_text_is_read_or_refused) {
  const std::string whole = "SRID=1;MULTIPOLYGON ZM (EMPTY, ((0 0 1 2, 4e0 0 1 2, 4 4 1 2, 0 0 1 2)), ((9 9 9 9)))";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    const auto polygons = polygons_from_wkt(part);
    ASSERT_FALSE(polygons.ok()) << part;
    EXPECT_TRUE(polygons.error().text().starts_with("character ")) << part;
    for (const int byte : std::initializer_list<int>{0, '(', ')', ',', 'e', '1', 0x80, 0xff}) {
      const std::string other = part + static_cast<char>(byte) + whole.substr(size + 1);
      (void)polygons_from_wkt(other);
    }
  }
}

TEST(Wkt, many_brackets_are_refused_at_once) {
  EXPECT_FALSE(polygons_from_wkt("POLYGON " + std::string(1'000'000, '(')).ok());
}

}  // namespace
}  // namespace algebra3d::wkt_tests
