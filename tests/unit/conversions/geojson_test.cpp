// JSON texts taken apart, GeoJSON read as regions, and members of objects.
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/values/conversions/geojson.h"
#include "algebra3d/values/conversions/json_tree.h"
#include "base/number_text.h"
#include "support/plane_shapes.h"
#include "unit/operators/call_operator.h"

namespace algebra3d::geojson_tests {
namespace {

using calls::Answer;
using calls::call;

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}
std::string json_error(std::string_view text) {
  const auto tree = JsonTree::parse(text);
  return tree ? "" : tree.error().text();
}

TEST(JsonTree, parts_are_stretches_of_the_text) {
  const std::string text = "\xef\xbb\xbf {\"a\" : [1.50, -2e3,\ttrue, null ], \"b\\n\": {\"c\": \"x\\\"}\\u00fc\"}} ";
  const auto tree = JsonTree::parse(text);
  ASSERT_TRUE(tree.ok()) << tree.error().text();
  const std::size_t a = *tree->member(0, "a");
  EXPECT_EQ(tree->text(a), "[1.50, -2e3,\ttrue, null ]");
  std::vector<std::string> elements;
  for (std::size_t one = JsonTree::first(a); one != tree->end(a); one = tree->after(one))
    elements.emplace_back(tree->text(one));
  EXPECT_EQ(elements, (std::vector<std::string>{"1.50", "-2e3", "true", "null"}));
  const std::size_t b = *tree->member(0, "b\n");
  EXPECT_EQ(tree->content(*tree->member(b, "c")), "x\"}\xc3\xbc");
  EXPECT_FALSE(tree->member(a, "a"));
  EXPECT_FALSE(tree->member(b, "c", JsonKind::number));
  EXPECT_EQ(compact_json(tree->text(0)), "{\"a\":[1.50,-2e3,true,null],\"b\\n\":{\"c\":\"x\\\"}\\u00fc\"}}");
}

TEST(JsonTree, what_lies_deeper_is_checked_and_not_kept) {
  const auto tree = JsonTree::parse(R"([[1, [2]], {"a": 3}, 4])", 1);
  ASSERT_TRUE(tree.ok());
  std::vector<std::string> elements;
  for (std::size_t one = JsonTree::first(0); one != tree->end(0); one = tree->after(one)) {
    elements.emplace_back(tree->text(one));
    EXPECT_EQ(tree->end(one), one + 1);
  }
  EXPECT_EQ(elements, (std::vector<std::string>{"[1, [2]]", R"({"a": 3})", "4"}));
  EXPECT_FALSE(JsonTree::parse("[[1, [2]], {\"a\": }]", 1).ok());
}

TEST(JsonTree, the_last_of_equal_keys_counts) {
  const auto tree = JsonTree::parse(R"({"a": 1, "\u0061": 2})");
  EXPECT_EQ(tree->text(*tree->member(0, "a")), "2");
}

TEST(JsonTree, malformed_texts_say_where_and_what) {
  EXPECT_EQ(json_error(""),
            "line 1, byte 1: syntax error while parsing value - unexpected end of input; "
            "expected '[', '{', or a literal");
  EXPECT_EQ(json_error("{\n\"a\": ]}"),
            "line 2, byte 8: syntax error while parsing value - unexpected ']'; "
            "expected '[', '{', or a literal");
  EXPECT_EQ(json_error("[1] 2"),
            "line 1, byte 5: syntax error while parsing value - unexpected number literal; "
            "expected end of input");
  EXPECT_EQ(json_error(std::string("[1]\0 2", 6)),
            "line 1, byte 4: found the byte 0x00 after the value; expected the end");
  EXPECT_NE(json_error("[\"\xff\"]").find("invalid string: ill-formed UTF-8 byte; last read: '\"\\xff'"),
            std::string::npos);
  EXPECT_NE(json_error("[1e5000]").find("number overflow parsing '1e5000'"), std::string::npos);
  EXPECT_LT(json_error("\"" + std::string(100'000, 'a')).size(), 200U);
}

TEST(JsonTree, nothing_is_recursive) {
  constexpr std::size_t kDeep = 2'000'000;
  EXPECT_FALSE(JsonTree::parse(repeated("[", kDeep)).ok());
  EXPECT_FALSE(JsonTree::parse(repeated("{\"a\":", kDeep)).ok());
  const std::string deep = repeated("[", kDeep) + repeated("]", kDeep);
  const auto tree = JsonTree::parse(deep);
  ASSERT_TRUE(tree.ok());
  EXPECT_EQ(tree->text(0).size(), deep.size());
  EXPECT_EQ(compact_json(deep), deep);
}

TEST(JsonTree, is_interruptible) {
  const std::atomic<bool> cancel = true;
  const auto tree = JsonTree::parse("[" + repeated("1,", 10'000) + "1]", JsonTree::kWholeDepth, Monitor(&cancel));
  ASSERT_FALSE(tree.ok());
  EXPECT_EQ(tree.error().code, ErrorCode::interrupted);
}

Answer read_geojson(const std::string& text) {
  return call("geojson2region", Text{text});
}
std::string region_text(const std::string& text) {
  const Answer answer = read_geojson(text);
  EXPECT_TRUE(answer.is_defined()) << text << ": " << testing::PrintToString(answer.diagnostics);
  return answer.text();
}
std::string reason(const std::string& text) {
  const Answer answer = read_geojson(text);
  EXPECT_FALSE(answer.is_defined()) << text;
  EXPECT_EQ(answer.diagnostics.size(), 1U);
  return answer.diagnostics.empty() ? "" : answer.diagnostics.front();
}
std::string polygon(const std::string& coordinates) {
  return R"({"type": "Polygon", "coordinates": )" + coordinates + "}";
}
std::string feature(const std::string& geometry) {
  return R"({"type": "Feature", "geometry": )" + geometry + "}";
}

const std::string kRing = "[[0, 0], [4, 0], [4, 4], [0, 0]]";
const std::string kTriangle = "((((0.0 0.0) (4.0 0.0) (4.0 4.0))))";

TEST(GeoJson, forms_of_the_same_triangle) {
  const std::string plain = polygon("[" + kRing + "]");
  for (const std::string& text :
       {plain, feature(plain), R"({"coordinates": [)" + kRing + R"(], "crs": [[[{}]]], "type": "Polygon"})",
        R"({"type": "MultiPolygon", "coordinates": [[)" + kRing + "], []]}",
        R"({"type": "GeometryCollection", "geometries": [)" + plain + "]}",
        polygon("[[[0, 0, 7], [4, 0, 7, 8], [4, 4], [4, 4], [0.0, -0]]]"),
        std::string("\xef\xbb\xbf") + R"({"t\u0079pe": "Poly\u0067on", "coordinates": [)" + kRing + "]}"})
    EXPECT_EQ(region_text(text), kTriangle) << text;
}

TEST(GeoJson, empty_forms) {
  EXPECT_EQ(region_text(polygon("[]")), "()");
  EXPECT_EQ(region_text(R"({"type": "MultiPolygon", "coordinates": []})"), "()");
  EXPECT_EQ(region_text(R"({"type": "GeometryCollection", "geometries": []})"), "()");
}

TEST(GeoJson, what_is_no_region_says_why) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"7", "byte 1: found a number, expected a Polygon, a MultiPolygon or a GeometryCollection of these"},
      {"{}",
       "byte 1: found an object without a type, expected a Polygon, a MultiPolygon or a GeometryCollection of "
       "these"},
      {R"( {"type": "Point", "coordinates": [1, 2]})",
       "byte 2: found the type 'Point', expected a Polygon, a MultiPolygon or a GeometryCollection of these"},
      {R"({"type": "Polygon"})", "byte 1: found the type 'Polygon' without \"coordinates\""},
      {R"({"type": "Feature"})", "byte 1: found the type 'Feature' without \"geometry\""},
      {feature("null"), "byte 33: found null, expected a Polygon, a MultiPolygon or a GeometryCollection of these"},
      {R"({"type": "GeometryCollection"})",
       "byte 1: found the type 'GeometryCollection' without an array \"geometries\""},
      {R"({"type": "GeometryCollection", "geometries": [{"type": "GeometryCollection", "geometries": []}]})",
       "byte 47: found the type 'GeometryCollection', expected a Polygon or MultiPolygon"},
      {polygon("{}"), "byte 36: found an object without a type, expected an array of rings"},
      {polygon("[1]"), "byte 37: found a number, expected a ring of positions"},
      {polygon("[[1]]"), "byte 38: found a number, expected a position [x, y]"},
      {polygon("[[[1]]]"), "byte 38: found a position of 1 number, expected at least 2"},
      {polygon("[[[1, \"2\"]]]"), "byte 42: found a string, expected a number"},
      {polygon("[[[1, 1e999]]]"), "byte 42: found '1e999', expected a number within the range of doubles"},
      {polygon("[[]]"), "byte 37: found a ring without points"},
      {polygon("[[[0, 0], [4, 0], [4, 4]]]"),
       "byte 37: found a ring from (0 0) to (4 4), expected its first point again at its end"},
      {polygon("[[[0, 0], [4, 0], [0, 0]]]"), "face 1, cycle 1 has 2 corners, expected at least 3"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(reason(text), "geojson2region: " + message) << text;
  EXPECT_NE(reason(polygon("[[[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]]")).find("(0 0)-(4 4)"), std::string::npos);
}

std::string ring_json(const Polygons& polygons, std::uint32_t cycle) {
  std::string json;
  const std::uint32_t begin = polygons.first_corner(cycle), count = polygons.cycle_ends[cycle] - begin;
  for (std::uint32_t i = 0; i <= count; ++i) {
    const Vec3 corner = polygons.corners[begin + i % count].approx;
    json += (i == 0 ? "[[" : ", [") + real_text(corner.x) + ", " + real_text(corner.y) + "]";
  }
  return json + "]";
}

TEST(GeoJson, random_regions_come_back) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 40; ++i) {
    const Region region = **Region::prove(
        plane_shapes::polygons_of({{plane_shapes::on_grid(plane_shapes::star(5 + i, 0.4, 5, random)),
                                    plane_shapes::on_grid(plane_shapes::star(3 + i, 0.333333, 1.5, random))}}));
    const Polygons& given = region.polygons();
    const Answer back = read_geojson(polygon("[" + ring_json(given, 0) + ", " + ring_json(given, 1) + "]"));
    EXPECT_EQ(back.get<Region>().polygons(), given);
  }
}

TEST(GeoJson, features_in_their_order) {
  const std::string text = R"({"features": [
    {"type": "Feature", "id": "a", "properties": {"x": [1, {"y": " z "}]}, "geometry": )" +
                           polygon("[" + kRing + "]") + R"(},
    {"type": "Feature", "id": 1.50, "properties": null, "geometry": null},
    {"type": "Polygon", "id": {}, "properties": 7, "coordinates": []}, 5], "type": "FeatureCollection"})";
  const auto features = GeoFeatures::find(text);
  ASSERT_TRUE(features.ok()) << features.error().text();
  ASSERT_EQ(features->size(), 4U);
  const auto a = features->feature(0);
  EXPECT_EQ(a->id, "a");
  EXPECT_EQ(a->properties, R"({"x":[1,{"y":" z "}]})");
  EXPECT_EQ(Value::of<Region>(*a->shape).to_nested().print(), kTriangle);
  const auto b = features->feature(1);
  EXPECT_EQ(b->id, "1.50");
  EXPECT_EQ(b->properties, std::nullopt);
  EXPECT_EQ(b->shape.reason(), "byte " + std::to_string(text.find("null}") + 1) +
                                   ": found null, expected a Polygon, a MultiPolygon or a GeometryCollection of these");
  const auto c = features->feature(2);
  EXPECT_EQ(c->id, std::nullopt);
  EXPECT_EQ(c->properties, std::nullopt);
  EXPECT_NE(c->shape.reason().find("found the type 'Polygon', expected a Feature"), std::string::npos);
  EXPECT_NE(features->feature(3)->shape.reason().find("found a number, expected a Feature"), std::string::npos);
}

TEST(GeoJson, what_is_no_geojson_says_why) {
  const auto message = [](const char* text) { return GeoFeatures::find(text).error().text(); };
  EXPECT_EQ(message("\n\n [1]"),
            "line 3, byte 4: found an array, expected a FeatureCollection, a Feature or a geometry");
  EXPECT_EQ(message(R"({"type": "Topology"})"),
            "line 1, byte 1: found the type 'Topology', expected a FeatureCollection, a Feature or a geometry");
  EXPECT_EQ(message(R"({"type": "FeatureCollection", "features": {}})"),
            "line 1, byte 1: found the type 'FeatureCollection', expected it to have an array \"features\"");
  EXPECT_EQ(GeoFeatures::find(R"({"type": "Point"})")->size(), 1U);
}

TEST(GeoJson, every_beginning_of_a_text_is_refused_and_every_changed_byte_survived) {
  const std::string whole = R"({"type": "FeatureCollection", "features": [{"type": "Feature", "id": "\u00fc\"", )"
                            R"("properties": {"a": -1.5e+3, "b": [true, false, null]}, "geometry": )" +
                            polygon("[" + kRing + "]") + "}]}";
  ASSERT_TRUE(GeoFeatures::find(whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(GeoFeatures::find(whole.substr(0, size)).ok()) << size;
    for (const int byte : std::initializer_list<int>{0, '"', '\\', '[', '}', ',', ':', '1', 0xef, 0xff}) {
      std::string other = whole;
      other[size] = static_cast<char>(byte);
      const auto features = GeoFeatures::find(other);
      if (!features) continue;
      for (std::size_t i = 0; i < features->size(); ++i) EXPECT_TRUE(features->feature(i).ok());
    }
  }
}

TEST(JsonMembers, texts_and_numbers) {
  const Text object{
      R"({"name": "a\"b", "big": 12345678901234567890123, "list": [1, "x y"], "no": null, "zero": "\u0000",
                        "huge": 1e999, "yes": true})"};
  const auto text = [&](const char* key) { return call("jsonText", object, std::string(key)); };
  const auto number = [&](const char* key) { return call("jsonNumber", object, Text{key}); };
  EXPECT_EQ(text("name").get<Text>().content, "a\"b");
  EXPECT_EQ(text("big").get<Text>().content, "12345678901234567890123");
  EXPECT_EQ(text("list").get<Text>().content, R"([1,"x y"])");
  EXPECT_EQ(text("no").get<Text>().content, "null");
  EXPECT_EQ(text("yes").get<Text>().content, "true");
  EXPECT_FALSE(text("zero").is_defined());
  EXPECT_EQ(text("Name").diagnostics, (std::vector<std::string>{"jsonText: the object has no member \"Name\""}));
  EXPECT_EQ(number("big").get<double>(), 12345678901234567890123.0);
  EXPECT_EQ(number("huge").diagnostics,
            (std::vector<std::string>{"jsonNumber: the member \"huge\" is beyond the range of doubles"}));
  EXPECT_EQ(number("name").diagnostics, (std::vector<std::string>{"jsonNumber: the member \"name\" is not a number"}));
  EXPECT_EQ(call("jsonText", Text{"[1]"}, std::string("a")).diagnostics,
            (std::vector<std::string>{"jsonText: the text is not a JSON object"}));
}

}  // namespace
}  // namespace algebra3d::geojson_tests
