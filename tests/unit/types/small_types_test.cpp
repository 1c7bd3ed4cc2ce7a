// Texts, bytes, order and hash of all types but surface3d and volume3d. The tables are written by hand from the
// language.
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value.h"
#include "unit/types/reading.h"

namespace algebra3d {
namespace {

const Type& type_named(std::string_view name) {
  const std::vector<const Type*> types{
      &TypeOf<std::int64_t>::type(), &TypeOf<double>::type(),  &TypeOf<bool>::type(),    &TypeOf<std::string>::type(),
      &TypeOf<Text>::type(),         &TypeOf<Bytes>::type(),   &TypeOf<Point3d>::type(), &TypeOf<Points3d>::type(),
      &TypeOf<Vector3d>::type(),     &TypeOf<Plane3d>::type(), &TypeOf<Box3>::type()};
  for (const auto* type : types)
    if (type->name() == name) return *type;
  ADD_FAILURE() << "no type " << name;
  return *types[0];
}

Reading read(std::string_view type, std::string_view text) {
  return reading_of(type_named(type), text);
}

Value value_of(std::string_view type, std::string_view text) {
  auto reading = read(type, text);
  EXPECT_TRUE(reading.value.ok()) << type << " " << text << ": "
                                  << (reading.value.ok() ? "" : reading.value.error().text());
  if (!reading.value.ok()) return Value(type_named(type));
  EXPECT_TRUE(reading.value->is_defined()) << type << " " << text;
  return *reading.value;
}

std::string bytes_of(const Value& value) {
  std::string bytes;
  value.type().encode(value, bytes);
  return bytes;
}

// Values of one type in ascending order; those of a group are equal however they are written.
struct Ascending {
  std::string_view type;
  std::vector<std::vector<const char*>> groups;
};

const std::vector<Ascending>& ascending_values() {
  static const std::vector<Ascending> values{
      {"int",
       {{"-9223372036854775808"},
        {"-9223372036854775807"},
        {"-2147483649"},
        {"-1"},
        {"0", "-0"},
        {"1", "001"},
        {"2147483648"},
        {"9223372036854775807"}}},
      {"real",
       {{"-1.7976931348623157e308"},
        {"-1", "-1.0", "-10e-1"},
        {"-4.9406564584124654e-324"},
        {"0", "0.0", "-0.0"},
        {"4.9406564584124654e-324"},
        {"0.1", ".1", "0.1000000000000000055"},
        {"0.30000000000000004"},
        {"2147483648"},
        {"1e300"}}},
      {"bool", {{"FALSE"}, {"TRUE"}}},
      {"string",
       {{"\"\""}, {"\"A\""}, {"\"Z\""}, {"\"a\""}, {"\"aa\""}, {"\"b\""}, {"\"\xC3\xA4\""}, {"\"\xE2\x82\xAC\""}}},
      {"text",
       {{"''", "<text></text--->"}, {"'\n'"}, {"'a'", "<text>a</text--->"}, {"'it\\'s'", "<text>it's</text--->"}}},
      {"bytes", {{"''"}, {"'00'"}, {"'0001'"}, {"'7f'"}, {"'80'", "'\\\\x80'"}, {"'fFfe'", "'FFFE'"}, {"'ffff'"}}},
      {"point3d",
       {{"(-7/5 9 9)", "(-14/10 9 9)"},
        {"(-1.4 0 0)"},  // the double lies above -7/5: its error is +8.9e-17
        {"(0 0 0)", "(0.0 -0.0 0)", "(0/7 0 0)"},
        {"(0 0 4.9406564584124654e-324)"},
        {"(0 0 1/3)", "(0 0 2/6)"},
        {"(0.3333333333333333 0 0)"},
        {"(1/3 0 0)"},
        {"(9007199254740992 0 0)"},
        {"(9007199254740993/1 0 0)", "(18014398509481986/2 0 0)"},
        {"(9007199254740994 0 0)", "(9007199254740994/1 0 0)"}}},
      {"vector3d", {{"(0 0 0)"}, {"(0 1/2 0)", "(0 0.5 0)"}, {"(0 1/2 1/7)", "(0 0.5 3/21)"}, {"(1 0 0)"}}},
      {"points3d",
       {{"()"},
        {"((0 0 0))", "((0 0 0) (0 0 0))", "((-0.0 0 0))"},
        {"((0 0 0) (1/3 0 0))", "((1/3 0 0) (0 0 0))", "((0 0 0) (2/6 0 0) (0 0 0) (1/3 0 0))"},
        {"((0 0 0) (1 0 0))", "((1 0 0) (0 0 0))"},
        {"((1 0 0))"}}},
      {"plane3d",
       {{"(0 -1 0 0)", "((0 5 5) (-1 0 0))"},
        {"(-2 0 0 -1)", "((0 0 2) (0 0 -1/3))"},
        {"(1 0 0 1)"},
        {"(2 0 0 1)", "(2 0 0 5)", "((0 0 2) (0 0 1))", "((7 1/3 2) (0 0 1/9))", "((-7 0 4/2) (0 0 0.1))"},
        {"(2 0 3 4)", "(2 0 6 8)", "((0 2 1) (0 3 4))", "((0 10/3 0) (0 3/7 4/7))"},
        {"((0 0 0) (1 1/3 0))", "(0 3 1 0)"}}},
      {"rect3",
       {{"(-1 0 0 0 0 0)", "(-1 -0.0 0 0 0 -0.0)"},
        {"(0 0 0 0 0 0)"},
        {"(0 0 0 1 0 0)"},
        {"(0 1 0 0 0 0)"},
        {"(0 1 0 0 0 1)"}}},
  };
  return values;
}

TEST(small_types, order_equality_and_hash_agree) {
  for (const auto& [type, groups] : ascending_values()) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      for (std::size_t j = 0; j < groups.size(); ++j) {
        for (const char* a : groups[i]) {
          for (const char* b : groups[j]) {
            const auto value_a = value_of(type, a);
            const auto value_b = value_of(type, b);
            EXPECT_EQ(compare(value_a, value_b), i <=> j) << type << ": " << a << " and " << b;
            // Hashes of so few values must not collide either.
            EXPECT_EQ(hash(value_a) == hash(value_b), i == j) << type << ": " << a << " and " << b;
          }
        }
      }
    }
  }
}

TEST(small_types, undefined_comes_first_and_equals_itself) {
  for (const auto& [type, groups] : ascending_values()) {
    for (const char* spelling : {"undefined", "undef", "UNDEFINED", "UNDEF", "null", "NULL"}) {
      const auto reading = read(type, spelling);
      ASSERT_TRUE(reading.value.ok());
      EXPECT_FALSE(reading.value->is_defined());
      EXPECT_TRUE(reading.diagnostics.empty());
      EXPECT_EQ(reading.value->to_nested().print(), "undefined");
      EXPECT_EQ(compare(*reading.value, Value(type_named(type))), std::strong_ordering::equal);
      EXPECT_EQ(hash(*reading.value), hash(Value(type_named(type))));
      EXPECT_EQ(compare(*reading.value, value_of(type, groups[0][0])), std::strong_ordering::less);
    }
  }
}

TEST(small_types, what_is_printed_and_what_is_stored_reads_back_equal) {
  for (const auto& [type, groups] : ascending_values()) {
    for (const auto& group : groups) {
      for (const char* text : group) {
        const auto value = value_of(type, text);
        const auto printed = value.to_nested().print();
        EXPECT_EQ(compare(value_of(type, printed), value), std::strong_ordering::equal) << printed;
        EXPECT_EQ(value_of(type, printed).to_nested().print(), printed);
        for (const bool trusted : {false, true}) {
          const auto decoded = value.type().decode(bytes_of(value), trusted);
          ASSERT_TRUE(decoded.ok()) << type << " " << text << ": " << decoded.error().text();
          EXPECT_EQ(decoded->to_nested().print(), printed);
          EXPECT_EQ(compare(*decoded, value), std::strong_ordering::equal) << printed;
          EXPECT_EQ(bytes_of(*decoded), bytes_of(value));
        }
      }
    }
  }
}

TEST(small_types, print_as_the_language_says) {
  const std::vector<std::array<std::string_view, 3>> rows{
      {"int", "-007", "-7"},
      {"real", "12", "12.0"},
      {"real", "+5", "5.0"},
      {"real", "0.1000000000000000055", "0.1"},
      {"bool", "TRUE", "TRUE"},
      {"string", R"("a\"b\\c\d")", R"("a\"b\\c\\d")"},
      {"text", "<text>it's</text--->", "'it\\'s'"},
      {"bytes", "'00ABfe'", "'00abfe'"},
      {"point3d", "(1 -2 0.5)", "(1.0 -2.0 0.5)"},
      {"point3d", "(1/3 -14/10 6/3)", "(1/3 -7/5 2.0)"},
      {"point3d", "(-0.0 0/5 2/4)", "(0.0 0.0 0.5)"},
      {"point3d", "(5e-324 1e23 9007199254740993/1)", "(5e-324 1e+23 9007199254740993/1)"},
      {"vector3d", "(1/3 0 -1)", "(1/3 0.0 -1.0)"},
      {"points3d", "((1 0 0) (0 1/3 0) (1 0 0.0) (0 0 0))", "((0.0 0.0 0.0) (0.0 1/3 0.0) (1.0 0.0 0.0))"},
      {"points3d", "()", "()"},
      {"plane3d", "(2 0 0 5)", "(2.0 0.0 0.0 5.0)"},
      {"plane3d", "((1/3 2 3) (0 0.5 -2/7))", "((1/3 2.0 3.0) (0.0 0.5 -2/7))"},
      {"rect3", "(0 1 -2.5 2 3 3)", "(0.0 1.0 -2.5 2.0 3.0 3.0)"},
  };
  for (const auto& [type, text, printed] : rows) EXPECT_EQ(value_of(type, text).to_nested().print(), printed);
}

TEST(small_types, malformed_lists_are_errors_that_say_what_was_expected) {
  const std::vector<std::array<std::string_view, 3>> rows{
      {"int", "1.0", "int: expected an integer between -9223372036854775808 and 9223372036854775807, got 1.0"},
      {"int", "9223372036854775808",
       "int: expected an integer between -9223372036854775808 and 9223372036854775807, got 9223372036854775808.0"},
      {"int", "(1)", "int: expected an integer between -9223372036854775808 and 9223372036854775807, got (1)"},
      {"real", "1/3", "real: expected an int or a real, got 1/3"},
      {"real", "\"1\"", "real: expected an int or a real, got \"1\""},
      {"bool", "true", "bool: expected TRUE or FALSE, got true"},
      {"bool", "1", "bool: expected TRUE or FALSE, got 1"},
      {"string", "'a'", "string: expected a string in double quotes, got 'a'"},
      {"string", "a", "string: expected a string in double quotes, got a"},
      {"text", "\"a\"", "text: expected a text in single quotes, got \"a\""},
      {"bytes", "\"00\"", "bytes: expected hexadecimal digits in single quotes, got \"00\""},
      {"bytes", "'0'", "bytes: character 2: found the end of the text, expected a hexadecimal digit"},
      {"bytes", "'00 01'", "bytes: character 3: found white space, expected a hexadecimal digit"},
      {"bytes", "'0x00'", "bytes: character 2: found 'x', expected a hexadecimal digit"},
      {"point3d", "(1 2)", "point3d: expected (x y z), got (1 2)"},
      {"point3d", "(1 2 3 4)", "point3d: expected (x y z), got (1 2 3 4)"},
      {"point3d", "5", "point3d: expected (x y z), got 5"},
      {"point3d", "(1 two 3)", "point3d: expected a number or a fraction p/q, got two"},
      {"point3d", "(1 2 TRUE)", "point3d: expected a number or a fraction p/q, got TRUE"},
      {"point3d", "(1 undefined 3)", "point3d: expected a number or a fraction p/q, got undefined"},
      {"point3d", "(1/0 2 3)", "point3d: expected a number or a fraction p/q, got 1/0"},
      {"point3d", "(/ 2 3)", "point3d: expected a number or a fraction p/q, got /"},
      {"vector3d", "()", "vector3d: expected (x y z), got ()"},
      {"points3d", "(1 2 3)", "points3d: expected (x y z), got 1"},
      {"points3d", "a", "points3d: expected ((x y z)*), got a"},
      {"points3d", "((1 2 3) (4 5))", "points3d: expected (x y z), got (4 5)"},
      {"plane3d", "(1 0 0)", "plane3d: expected (d nx ny nz) or ((px py pz) (nx ny nz)), got (1 0 0)"},
      {"plane3d", "(1 0 0 1/3)", "plane3d: expected an int or a real, got 1/3"},
      {"plane3d", "((1 2) (0 0 1))", "plane3d: point: expected (x y z), got (1 2)"},
      {"plane3d", "((1 2 3) 4)", "plane3d: normal: expected (x y z), got 4"},
      {"rect3", "(0 1 0 1)", "rect3: expected (minX maxX minY maxY minZ maxZ), got (0 1 0 1)"},
      {"rect3", "(0 1 0 1 0 4/3)", "rect3: expected an int or a real, got 4/3"},
  };
  for (const auto& [type, text, message] : rows) {
    const auto reading = read(type, text);
    ASSERT_FALSE(reading.value.ok()) << type << " " << text;
    EXPECT_EQ(reading.value.error().code, ErrorCode::invalid_value);
    EXPECT_EQ(reading.value.error().text(), message);
  }
}

TEST(small_types, fractions_beyond_the_range_of_real_are_no_coordinates) {
  const auto huge = "1" + std::string(400, '0') + "/3";
  const auto reading = read("point3d", "(" + huge + " 0 0)");
  ASSERT_FALSE(reading.value.ok());
  EXPECT_EQ(reading.value.error().text(),
            "point3d: expected coordinates within the range of real, got (1" + std::string(58, '0') + "...");
  // A plane has no such limit: it is not drawn, it is computed with.
  const auto plane = value_of("plane3d", "((" + huge + " 0 0) (1 0 0))");
  EXPECT_EQ(plane.to_nested().print(), "((" + huge + " 0.0 0.0) (1.0 0.0 0.0))");
}

TEST(small_types, well_formed_lists_without_a_value_are_undefined_with_the_reason) {
  const std::vector<std::array<std::string_view, 4>> rows{
      {"plane3d", "(1 0 0 0)", "plane3d: the normal is zero", "(1 0 0 0)"},
      {"plane3d", "(1 -0.0 0 0)", "plane3d: the normal is zero", "(1 -0.0 0 0)"},
      {"plane3d", "((1 2 3) (0 0 0/5))", "plane3d: the normal is zero", "((1 2 3) (0 0 0/5))"},
      {"plane3d", "(1e300 1e300 0 0)", "plane3d: distance and normal together are beyond the range of real",
       "(1e+300 1e+300 0 0)"},
      {"rect3", "(1 0 0 1 0 1)", "rect3: the minimum of x is above the maximum", "(1 0 0 1 0 1)"},
      {"rect3", "(0 1 1 0 0 1)", "rect3: the minimum of y is above the maximum", "(0 1 1 0 0 1)"},
      {"rect3", "(0 1 0 1 0.5 0)", "rect3: the minimum of z is above the maximum", "(0 1 0 1 0.5 0)"},
  };
  for (const auto& [type, text, reason, place] : rows) {
    const auto reading = read(type, text);
    ASSERT_TRUE(reading.value.ok()) << type << " " << text;
    EXPECT_FALSE(reading.value->is_defined());
    ASSERT_EQ(reading.diagnostics.size(), 1U);
    EXPECT_EQ(reading.diagnostics[0].text, reason);
    EXPECT_EQ(reading.diagnostics[0].places, std::vector<std::string>{std::string(place)});
  }
}

TEST(small_types, planes_are_the_points_that_their_notation_means) {
  const auto plane = value_of("plane3d", "(2 0 3 4)").get<Plane3d>();
  EXPECT_EQ(plane.plane.offset, Rational(10));
  EXPECT_EQ(plane.plane.evaluate(plane.point), Rational(0));
  EXPECT_EQ(plane.point, RationalVec3(0, Rational(6, 5), Rational(8, 5)));
  const auto other = value_of("plane3d", "((1 1/3 0) (3 3 0))").get<Plane3d>();
  EXPECT_EQ(other.plane.offset, Rational(4));
  EXPECT_EQ(other.quadruple, nullptr);
}

TEST(small_types, headers_enclose_the_exact_geometry) {
  const double third = 0.3333333333333333;
  const auto point = value_of("point3d", "(1/3 2 -1/3)").header();
  EXPECT_EQ(point.size, 1U);
  EXPECT_EQ(point.box, (Box3{{third, 2, -std::nextafter(third, 1)}, {std::nextafter(third, 1), 2, -third}}));
  const auto points = value_of("points3d", "((0 5 0) (1/3 0 0) (0 5 0))").header();
  EXPECT_EQ(points.size, 2U);
  EXPECT_EQ(points.box, (Box3{{0, 0, 0}, {std::nextafter(third, 1), 5, 0}}));
  EXPECT_TRUE(value_of("points3d", "()").header().box.is_empty());
  EXPECT_EQ(value_of("points3d", "()").header().size, 0U);
  EXPECT_EQ(value_of("rect3", "(0 1 2 3 4 5)").header().box, (Box3{{0, 2, 4}, {1, 3, 5}}));
}

TEST(small_types, describe_themselves) {
  for (const auto& [name, groups] : ascending_values()) {
    const auto& type = type_named(name);
    EXPECT_TRUE(type.doc().ends_with(".")) << name;
    EXPECT_FALSE(type.notation().empty());
    EXPECT_TRUE(value_of(name, type.example()).is_defined());
    EXPECT_EQ(type.kinds()[0], Type::Kind::data);
    EXPECT_EQ(type.is_spatial(), name == "point3d" || name == "points3d" || name == "rect3") << name;
  }
  EXPECT_EQ(type_named("int").storage(), Type::Storage::integer);
  EXPECT_EQ(type_named("bool").storage(), Type::Storage::integer);
  EXPECT_EQ(type_named("real").storage(), Type::Storage::real);
  EXPECT_EQ(type_named("string").storage(), Type::Storage::text);
  EXPECT_EQ(type_named("text").storage(), Type::Storage::text);
  EXPECT_EQ(type_named("point3d").storage(), Type::Storage::bytes);
}

TEST(small_types, bodies_have_the_documented_bytes) {
  const auto hex = [](const Value& value) {
    std::string result;
    for (const char byte : bytes_of(value))
      result += fmt::format("{:02x}", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    return result;
  };
  const std::string zero(16, '0');
  const std::string one = "000000000000f03f";
  const std::string third = "555555555555d53f";
  EXPECT_EQ(hex(value_of("int", "258")), "02010000");
  EXPECT_EQ(hex(value_of("int", "-2")), "feffffff");
  EXPECT_EQ(hex(value_of("real", "1.0")), one);
  EXPECT_EQ(hex(value_of("bool", "TRUE")), "01");
  EXPECT_EQ(hex(value_of("string", "\"ab\"")), "6162");
  EXPECT_EQ(hex(value_of("text", "''")), "");
  EXPECT_EQ(hex(value_of("bytes", "'00ff80'")), "00ff80");
  EXPECT_EQ(hex(value_of("point3d", "(1 0 1)")), "00" + one + zero + one);
  EXPECT_EQ(hex(value_of("vector3d", "(1/3 0 1)")), "01" + third + zero + one + "03312f33" + "00" + "00");
  EXPECT_EQ(hex(value_of("plane3d", "(1 0 0 1)")), "00" + one + zero + zero + one);
  EXPECT_EQ(hex(value_of("plane3d", "((0 -1/3 2) (0 0 1))")),
            "010130"
            "042d312f33"
            "0132"
            "0130"
            "0130"
            "0131");
  EXPECT_EQ(hex(value_of("rect3", "(0 1 1 1 0 0)")), zero + one + one + one + zero + zero);
}

TEST(small_types, bad_bytes_are_errors_with_the_byte) {
  const auto error_of = [](std::string_view type, std::string_view bytes) -> std::string {
    const auto value = type_named(type).decode(bytes, false);
    if (value.ok()) return "no error, but " + value->to_nested().print();
    EXPECT_EQ(value.error().code, ErrorCode::database_corrupt);
    return value.error().text();
  };
  using namespace std::string_literals;
  const auto infinity = "\0\0\0\0\0\0\xF0\x7F"s;
  EXPECT_EQ(error_of("bool", "\x02"), "bool: byte 1 of the body: expected 0 or 1");
  EXPECT_EQ(error_of("real", infinity), "real: byte 8 of the body: expected a finite number");
  EXPECT_EQ(error_of("string", "ab\xFF"), "string: byte 2 of the body is not UTF-8");
  EXPECT_EQ(error_of("rect3", std::string(40, '\0') + infinity), "rect3: byte 48 of the body: expected a finite bound");
  EXPECT_EQ(error_of("rect3", "\0\0\0\0\0\0\xF0\x3F"s + std::string(40, '\0')),
            "rect3: byte 48 of the body: expected no minimum above its maximum");
  EXPECT_EQ(error_of("plane3d", std::string(33, '\0')),
            "plane3d: byte 33 of the body: expected a normal that is not zero, and finite numbers");
  EXPECT_EQ(error_of("plane3d", "\x02"), "plane3d: byte 1 of the body: expected 0 (quadruple) or 1 (point and normal)");
}

TEST(small_types, any_change_of_the_bytes_gives_a_value_or_an_error) {
  for (const auto& [type, groups] : ascending_values()) {
    for (const auto& group : groups) {
      const auto bytes = bytes_of(value_of(type, group[0]));
      for (std::size_t length = 0; length < bytes.size(); ++length) {
        const auto cut = type_named(type).decode(std::string_view(bytes).substr(0, length), false);
        EXPECT_TRUE(!cut.ok() || type == "string" || type == "text" || type == "bytes" || type == "int")
            << type << " " << group[0] << " " << length;
      }
      EXPECT_TRUE(!type_named(type).decode(bytes + '\0', false).ok() || type == "string" || type == "text" ||
                  type == "bytes");
      for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        auto changed = bytes;
        changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
        const auto value = type_named(type).decode(changed, false);
        if (!value.ok()) continue;
        EXPECT_FALSE(value->to_nested().print().empty());
      }
    }
  }
}

class RandomTexts {
 public:
  std::string coordinate() {
    static const std::vector<std::string> numbers{"0",   "-0.0", "1",  "1/3",    "2/6", "-7/5",  "0.5",
                                                  "1/2", "1e-5", "-1", "5e-324", "3/1", "-14/10"};
    return numbers[random_() % numbers.size()];
  }
  std::string triple() { return fmt::format("({} {} {})", coordinate(), coordinate(), coordinate()); }
  std::string points() {
    std::string result = "(";
    for (auto count = random_() % 4; count > 0; --count) result += triple();
    return result + ")";
  }
  std::string plane() { return fmt::format("({} (1/3 {} {}))", triple(), coordinate(), coordinate()); }

 private:
  std::mt19937_64 random_{7};
};

// Few coordinates, so that equal values are frequent.
void check_laws(const std::vector<Value>& values) {
  for (const auto& a : values) {
    const auto printed = a.to_nested().print();
    EXPECT_EQ(compare(value_of(a.type().name(), printed), a), std::strong_ordering::equal) << printed;
    for (const auto& b : values) {
      const auto order = compare(a, b);
      EXPECT_EQ(compare(b, a), 0 <=> order);
      EXPECT_TRUE(order != 0 || hash(a) == hash(b)) << printed << " " << b.to_nested().print();
      if (order > 0) continue;
      for (const auto& c : values) EXPECT_TRUE(compare(b, c) > 0 || compare(a, c) <= 0);
    }
  }
}

TEST(small_types, order_is_total_on_random_values) {
  RandomTexts random;
  std::vector<Value> points;
  std::vector<Value> sets;
  std::vector<Value> planes;
  for (int i = 0; i < 40; ++i) {
    points.push_back(value_of("point3d", random.triple()));
    sets.push_back(value_of("points3d", random.points()));
    planes.push_back(value_of("plane3d", random.plane()));
  }
  check_laws(points);
  check_laws(sets);
  check_laws(planes);
}

TEST(small_types, random_doubles_survive_text_and_bytes) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 2000; ++i) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    const auto value = Value::of(Point3d{ExactPoint(Vec3{number, -number, 0})});
    EXPECT_EQ(value_of("point3d", value.to_nested().print()).get<Point3d>().position.approx(),
              (Vec3{number, -number, 0}));
    EXPECT_EQ(value.type().decode(bytes_of(value), false)->get<Point3d>().position.approx(),
              (Vec3{number, -number, 0}));
  }
}

class DeferredPoint final : public DeferredValue {
 public:
  GeometryHeader header() const override { return {Box3::of({1, 2, 3}), 1}; }
  Result<Value> load() const override {
    if (fails) return Error{ErrorCode::database_corrupt, "gone"};
    return Value::of(Point3d{ExactPoint(Vec3{1, 2, 3})});
  }
  std::shared_ptr<const DeferredSource> source() const override { return nullptr; }
  void append_reference(std::string& /*bytes*/) const override {}
  bool fails = false;
};

TEST(value, deferred_values_know_their_header_and_load_when_asked) {
  const auto deferred = std::make_shared<DeferredPoint>();
  const Value value(TypeOf<Point3d>::type(), deferred);
  EXPECT_TRUE(value.is_defined());
  EXPECT_TRUE(value.is_deferred());
  EXPECT_EQ(value.deferred(), deferred);
  EXPECT_EQ(value.header().box, Box3::of({1, 2, 3}));
  const auto loaded = value.loaded();
  ASSERT_TRUE(loaded.ok());
  EXPECT_FALSE(loaded->is_deferred());
  EXPECT_EQ(loaded->deferred(), nullptr);
  EXPECT_EQ(loaded->to_nested().print(), "(1.0 2.0 3.0)");
  EXPECT_EQ(loaded->loaded()->to_nested().print(), "(1.0 2.0 3.0)");
  deferred->fails = true;
  EXPECT_EQ(value.loaded().error().text(), "gone");
}

TEST(value, undefined_values_keep_their_type) {
  const Value value(TypeOf<Box3>::type());
  EXPECT_FALSE(value.is_defined());
  EXPECT_EQ(value.type().name(), "rect3");
  EXPECT_FALSE(value.loaded()->is_defined());
  EXPECT_EQ(value.to_nested(), NestedList::symbol("undefined"));
}

}  // namespace
}  // namespace algebra3d
