// Well-known binary: what other programs wrote, what is refused with which words, what is written, hostile bytes.
#include <atomic>
#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/values/conversions/wkb.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/planar.h"
#include "support/rounds.h"
#include "unit/conversions/wkb_samples.h"
#include "unit/operators/call_operator.h"

namespace algebra3d::wkb_tests {
namespace {

using calls::Answer;
using calls::call;
using namespace wkb_samples;

Answer read(const std::string& op, const std::string& digits, int srid = 0) {
  return call(op, Text{digits}, srid);
}
double number(const std::string& op, const Answer& answer) {
  EXPECT_TRUE(answer.is_defined()) << testing::PrintToString(answer.diagnostics);
  return answer.is_defined() ? call(op, answer.single()).get<double>() : -1;
}
std::string reason(const Answer& answer) {
  EXPECT_FALSE(answer.is_defined());
  return answer.diagnostics.empty() ? "" : answer.diagnostics.back();
}
std::string reason(const std::string& digits) {
  return reason(read("fromWKB", digits));
}
const std::string& bytes_of(const Answer& answer) {
  return answer.get<Bytes>().content;
}

/// The numbers of a WKB in one byte order, as digits.
class Digits {
 public:
  explicit Digits(bool is_big_endian) : is_big_endian_(is_big_endian) {}
  Digits& part(std::uint32_t type) { return append(is_big_endian_ ? 0 : 1, 1), u32(type); }
  Digits& u32(std::uint32_t number) { return append(number, 4), *this; }
  Digits& point(double x, double y, double z) { return f64(x).f64(y).f64(z); }
  Digits& f64(double number) { return append(std::bit_cast<std::uint64_t>(number), 8), *this; }
  const std::string& text() const { return text_; }

 private:
  void append(std::uint64_t number, int width) {
    std::string bytes;
    for (int i = 0; i < width; ++i)
      bytes += static_cast<char>(number >> static_cast<unsigned>(8 * (is_big_endian_ ? width - 1 - i : i)));
    text_ += hex_digits(bytes);
  }
  bool is_big_endian_;
  std::string text_;
};

constexpr std::uint32_t kZ = 0x80000000, kSrid = 0x20000000;

/// A polygon with Z of one ring.
Digits polygon(const std::vector<Vec3>& ring) {
  Digits digits(false);
  digits.part(kZ | 3).u32(1).u32(static_cast<std::uint32_t>(ring.size()));
  for (const Vec3& p : ring) digits.point(p.x, p.y, p.z);
  return digits;
}

TEST(Wkb, reads_what_postgis_and_gdal_wrote) {
  EXPECT_EQ(number("volume", read("fromWKB", kPostgisCube, 4326)), 8);
  EXPECT_EQ(number("volume", read("fromWKB", kPostgisTetrahedron)), 1.0 / 6);
  const Answer frame = read("fromWKB", kGdalFrame), both = read("fromWKB", kGdalCollection);
  EXPECT_EQ(number("volume", frame), 12);
  // Two polygons of eight corners with a hole have eight triangles each, and 8 sides two.
  EXPECT_EQ(call("size", frame.single()).get<std::int64_t>(), 32);
  EXPECT_NEAR(number("volume", both), 8 + 1.0 / 6, 1e-15);
  EXPECT_EQ(call("components", both.single()).elements().size(), 2U);
  EXPECT_EQ(number("area", read("regionFromWKB", kPostgisRegion, 4326)), 12.5);
  EXPECT_EQ(read("pointsFromWKB", kPostgisPoints).text(), "((0.1 0.0 -2.0) (1.0 2.0 3.0))");
  const Answer line = read("pointsFromWKB", kGdalLine);
  EXPECT_EQ(line.text(), "((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 5.0))");
  EXPECT_EQ(line.diagnostics, (std::vector<std::string>{"pointsFromWKB: of lines only the points are kept"}));
}

TEST(Wkb, faces_as_surfaces_and_meshes) {
  EXPECT_EQ(number("area", read("surfaceFromWKB", kGdalFrame)), 48);
  EXPECT_EQ(number("area", read("surfaceFromWKB", kPostgisCube, 4326)), 24);
  const Answer mesh = read("meshFromWKB", kPostgisCube, 4326);
  EXPECT_EQ(mesh.text(),
            "(((0.0 0.0 0.0) (0.0 2.0 0.0) (2.0 2.0 0.0) (2.0 0.0 0.0) (0.0 0.0 2.0) (0.0 2.0 2.0) (2.0 0.0 2.0) (2.0 "
            "2.0 2.0)) ((0 1 2 3) (0 4 5 1) (0 3 6 4) (7 6 3 2) (7 2 1 5) (7 5 4 6)))");
  EXPECT_EQ(reason(read("meshFromWKB", kGdalFrame)),
            "meshFromWKB: byte 9: found a polygon with 1 hole, expected polygons without holes");
}

TEST(Wkb, srids_are_never_dropped) {
  EXPECT_EQ(reason(kPostgisCube),
            "fromWKB: byte 5: found SRID 4326, expected no SRID, since none was asked for as second argument");
  EXPECT_EQ(reason(read("fromWKB", kPostgisCube, 3857)), "fromWKB: byte 5: found SRID 4326, expected SRID 3857");
  EXPECT_EQ(reason(read("fromWKB", kPostgisTetrahedron, 4326)), "fromWKB: byte 1: found no SRID, expected SRID 4326");
  EXPECT_EQ(call("sridOfWKB", Text{kPostgisCube}).text(), "4326");
  EXPECT_EQ(call("sridOfWKB", Text{kPostgisTetrahedron}).text(), "0");
  // A part may repeat it, and have no other.
  Digits same(false), other(false), none(false);
  same.part(kZ | kSrid | 4).u32(7).u32(1).part(kZ | kSrid | 1).u32(7).point(1, 2, 3);
  other.part(kZ | kSrid | 4).u32(7).u32(1).part(kZ | kSrid | 1).u32(8).point(1, 2, 3);
  none.part(kZ | 4).u32(1).part(kZ | kSrid | 1).u32(8).point(1, 2, 3);
  EXPECT_EQ(read("pointsFromWKB", same.text(), 7).text(), "((1.0 2.0 3.0))");
  EXPECT_EQ(reason(read("pointsFromWKB", other.text(), 7)), "pointsFromWKB: byte 18: found SRID 8, expected SRID 7");
  EXPECT_EQ(reason(read("pointsFromWKB", none.text())), "pointsFromWKB: byte 14: found SRID 8, expected no SRID");
}

TEST(Wkb, both_byte_orders_and_forms_of_types) {
  for (const bool is_big_endian : {false, true})
    for (const std::uint32_t type : {kZ | 1U, 1001U, kZ | 1001U}) {
      Digits digits(is_big_endian);
      digits.part(type).point(1, -2, 0.5);
      EXPECT_EQ(read("pointFromWKB", digits.text()).text(), "(1.0 -2.0 0.5)") << digits.text();
    }
  // Parts have a byte order of their own.
  const std::string mixed = Digits(true).part(1004).u32(1).text() + Digits(false).part(1001).point(1, 2, 3).text();
  EXPECT_EQ(read("pointsFromWKB", mixed).text(), "((1.0 2.0 3.0))");
}

TEST(Wkb, empty_geometries) {
  EXPECT_EQ(read("fromWKB", Digits(false).part(kZ | 15).u32(0).text()).text(), "()");
  EXPECT_EQ(read("surfaceFromWKB", Digits(true).part(1016).u32(0).text()).text(), "()");
  EXPECT_EQ(read("meshFromWKB", Digits(false).part(kZ | 3).u32(0).text()).text(), "(() ())");
  EXPECT_EQ(read("regionFromWKB", Digits(false).part(6).u32(0).text()).text(), "()");
  EXPECT_EQ(read("pointsFromWKB", kPostgisEmptyPoint).text(), "()");
  EXPECT_EQ(reason(read("pointFromWKB", kPostgisEmptyPoint)), "pointFromWKB: the point is empty");
}

TEST(Wkb, what_is_refused_is_named_with_its_byte) {
  const std::string faces = "POLYHEDRALSURFACE Z, TIN Z, MULTIPOLYGON Z, POLYGON Z, TRIANGLE Z or GEOMETRYCOLLECTION Z";
  EXPECT_EQ(reason(kPostgisCurve), "fromWKB: byte 1: found CIRCULARSTRING Z, expected " + faces);
  EXPECT_EQ(reason(read("pointFromWKB", kPostgisPointM)), "pointFromWKB: byte 1: found POINT ZM, expected POINT Z");
  EXPECT_EQ(reason(Digits(false).part(15).u32(0).text()),
            "fromWKB: byte 1: found POLYHEDRALSURFACE, expected " + faces);
  EXPECT_EQ(reason(Digits(false).part(2015).u32(0).text()),
            "fromWKB: byte 1: found POLYHEDRALSURFACE M, expected " + faces);
  EXPECT_EQ(reason(""), "fromWKB: byte 0: found the end, expected a byte order and a type of 5 bytes from byte 0");
  EXPECT_EQ(reason("02" + std::string(8, '0')),
            "fromWKB: byte 0: found 0x02, expected a byte order: 0 (big-endian) or 1 (little-endian)");
  EXPECT_EQ(reason("0112000000"), "fromWKB: byte 1: found the type 0x12, expected the type of a geometry");
  EXPECT_EQ(reason("01a70f0080"), "fromWKB: byte 1: found the type 0x80000fa7, expected the type of a geometry");
  EXPECT_EQ(reason("010f00008001"), "fromWKB: byte 6: found the end, expected a count of 4 bytes from byte 5");
  EXPECT_EQ(reason("010f000080ffffffff"),
            "fromWKB: byte 5: found a count of 4294967295 parts, expected at most 0, since 0 bytes follow");
  EXPECT_EQ(reason("010f0000800000000001"), "fromWKB: byte 9: found 1 further byte, expected the end");
  EXPECT_EQ(reason("0g"), "fromWKB: character 2: found 'g', expected a hexadecimal digit");
  EXPECT_EQ(reason("\\x010f"),
            "fromWKB: byte 2: found the end, expected a byte order and a type of 5 bytes from byte 0");
  EXPECT_EQ(reason("010"), "fromWKB: character 4: found the end of the text, expected a hexadecimal digit");
  Digits mixed(false);
  mixed.part(6).u32(1).part(kZ | 3).u32(0);
  EXPECT_EQ(reason(read("regionFromWKB", mixed.text())),
            "regionFromWKB: byte 10: found POLYGON Z, expected no Z, as before");
}

TEST(Wkb, rings_that_are_none) {
  EXPECT_EQ(reason(polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).text()),
            "fromWKB: byte 85: found a ring that ends at (0.0 0.0 1.0), expected its first point again, (0.0 0.0 0.0)");
  EXPECT_EQ(reason(polygon({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}).text()),
            "fromWKB: byte 9: found a ring of 3 points, expected at least 4, the last one equal to the first");
  EXPECT_EQ(reason(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}).text()),
            "fromWKB: byte 9: found a ring of 2 different points, expected at least 3");
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reason(polygon({{0, 0, 0}, {1, 0, nan}, {0, 1, 0}, {0, 0, 0}}).text()),
            "fromWKB: byte 53: found nan, expected a finite number");
  EXPECT_EQ(reason(polygon({{-infinity, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}).text()),
            "fromWKB: byte 13: found -inf, expected a finite number");
}

TEST(Wkb, faces_that_bound_no_solid_say_who_takes_them) {
  const std::string square = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}).text();
  const std::string text = reason(square);
  EXPECT_NE(text.find("no valid solid"), std::string::npos) << text;
  EXPECT_NE(text.find("surfaceFromWKB and meshFromWKB take faces that bound none"), std::string::npos) << text;
  EXPECT_EQ(number("area", read("surfaceFromWKB", square)), 1);
}

TEST(Wkb, holes_of_any_orientation_and_steep_planes) {
  // In the plane x = y + z, whose largest projection is the one along x.
  const auto on_plane = [](double y, double z) { return Vec3{y + z, y, z}; };
  for (const bool is_turned : {false, true}) {
    Digits digits(false);
    digits.part(kZ | 3).u32(2).u32(5);
    for (const auto& [y, z] : {std::pair(0, 0), {4, 0}, {4, 4}, {0, 4}, {0, 0}}) {
      const Vec3 p = on_plane(y, z);
      digits.point(p.x, p.y, p.z);
    }
    std::vector<std::pair<int, int>> hole{{1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}};
    if (is_turned) std::reverse(hole.begin(), hole.end());
    digits.u32(5);
    for (const auto& [y, z] : hole) {
      const Vec3 p = on_plane(y, z);
      digits.point(p.x, p.y, p.z);
    }
    const Answer surface = read("surfaceFromWKB", digits.text());
    EXPECT_NEAR(number("area", surface), 12 * std::sqrt(3.0), 1e-12);
    EXPECT_EQ(call("size", surface.single()).get<std::int64_t>(), 8);
  }
  Digits crossing(false);
  crossing.part(kZ | 3).u32(2).u32(5).point(0, 0, 0).point(4, 0, 0).point(4, 4, 0).point(0, 4, 0).point(0, 0, 0);
  crossing.u32(5).point(3, 1, 0).point(6, 1, 0).point(6, 2, 0).point(3, 2, 0).point(3, 1, 0);
  EXPECT_EQ(reason(read("surfaceFromWKB", crossing.text())),
            "surfaceFromWKB: byte 0: found a polygon whose rings cross, expected holes within its outer ring");
}

TEST(Wkb, nesting_ends_at_32) {
  const auto nested = [](int depth) {
    std::string digits;
    for (int i = 1; i < depth; ++i) digits += Digits(false).part(kZ | 7).u32(1).text();
    return digits + Digits(false).part(kZ | 1).point(1, 2, 3).text();
  };
  EXPECT_EQ(read("pointsFromWKB", nested(32)).text(), "((1.0 2.0 3.0))");
  EXPECT_EQ(reason(read("pointsFromWKB", nested(33))),
            "pointsFromWKB: byte 288: found a geometry at depth 33, expected at most 32");
  EXPECT_NE(reason(read("pointsFromWKB", nested(100'000))).find("at depth 33"), std::string::npos);
}

TEST(Wkb, what_is_written_is_read_back) {
  const Volume3d cube = calls::cube(calls::point(0, 0, 0), calls::point(1, 2, 3));
  for (const int srid : {0, 1, 4326, 999'999}) {
    const Answer bytes = call("toWKB", cube, srid);
    EXPECT_EQ(call("sridOfWKB", bytes.single()).get<std::int64_t>(), srid);
    EXPECT_EQ(compare(call("fromWKB", bytes.single(), srid).single(), Value::of(cube)), std::strong_ordering::equal);
  }
  // A cavity and a second body.
  const Value outer = call("createCube", calls::point(0, 0, 0), calls::point(9, 9, 9)).single();
  const Value hollow = call("minus", outer, cube).single();
  const Value inner = call("createCube", calls::point(4, 4, 4), calls::point(5, 5, 5)).single();
  const Value with_cavity = call("minus", outer, inner).single();
  for (const Value& solid : {hollow, with_cavity}) {
    const Answer bytes = call("toWKB", solid);
    EXPECT_TRUE(bytes.diagnostics.empty());
    EXPECT_EQ(compare(call("fromWKB", bytes.single()).single(), solid), std::strong_ordering::equal);
  }
  const std::string mesh = "(((0.0 0.0 0.0) (1.0 0.0 0.0) (1.0 1.0 0.5) (0.0 1.0 0.0)) ((0 1 2 3) (2 1 0)))";
  EXPECT_EQ(call("meshFromWKB", call("toWKB", calls::literal<Mesh3d>(mesh)).single()).text(), mesh);
}

TEST(Wkb, what_is_written_byte_by_byte) {
  Digits region(false);
  region.part(kSrid | 6).u32(31468).u32(1).part(3).u32(1).u32(4).f64(0).f64(0).f64(1).f64(0).f64(0).f64(1).f64(0).f64(
      0);
  EXPECT_EQ(hex_digits(bytes_of(call("toWKB", calls::literal<Region>("((((0 0) (1 0) (0 1))))"), 31468))),
            region.text());
  Digits surface(false);
  surface.part(kZ | 16).u32(1).part(kZ | 17).u32(1).u32(4).point(0, 0, 0).point(1, 0, 0).point(0, 1, 0).point(0, 0, 0);
  EXPECT_EQ(hex_digits(bytes_of(call("toWKB", calls::literal<Surface3d>("(((0 0 0) (1 0 0) (0 1 0)))")))),
            surface.text());
}

TEST(Wkb, rounding_is_told) {
  const Answer point = call("toWKB", calls::literal<Point3d>("(1/3 0 0)"));
  EXPECT_EQ(point.diagnostics, (std::vector<std::string>{"toWKB: rounded 1 point to doubles"}));
  const Answer solid =
      call("toWKB", calls::literal<Volume3d>("(((0 0 0) (0 1/3 0) (1 0 0)) ((0 0 0) (1 0 0) (0 0 1)) ((0 0 0) (0 0 1) "
                                             "(0 1/3 0)) ((1 0 0) (0 1/3 0) (0 0 1)))"));
  EXPECT_EQ(solid.diagnostics, (std::vector<std::string>{"toWKB: rounded 1 corner to doubles"}));
  EXPECT_TRUE(call("fromWKB", solid.single()).is_defined());
  // A tetrahedron of which nothing is left.
  const Answer thin =
      call("toWKB", calls::literal<Volume3d>(
                        "(((0 0 0) (0 1 0) (1 0 0)) ((0 0 0) (1 0 0) (1/3 1/3 1/"
                        "1000000000000000000000000000000000000000000000000000000000000000000)) ((0 0 0) (1/3 1/3 "
                        "1/1000000000000000000000000000000000000000000000000000000000000000000) (0 1 0)) ((1 0 0) (0 1 "
                        "0) (1/3 1/3 1/1000000000000000000000000000000000000000000000000000000000000000000)))"));
  EXPECT_TRUE(thin.is_defined());
}

TEST(Wkb, the_cut_and_the_changed_are_undefined_or_read) {
  std::mt19937 random(7);
  const std::string bytes = *bytes_of_hex(kGdalCollection);
  for (std::size_t size = 0; size < bytes.size(); size += 7)
    EXPECT_FALSE(read_wkb(std::string_view(bytes).substr(0, size), WkbContents::faces, Srid::none).ok()) << size;
  int read_count = 0;
  for (int round = 0; round < rounds(2000); ++round) {
    std::string changed = bytes;
    for (int i = 0; i < 3; ++i) changed[random() % changed.size()] = static_cast<char>(random());
    const auto geometry = read_wkb(changed, WkbContents::faces, Srid::none);
    if (!geometry) {
      EXPECT_TRUE(geometry.error().text().starts_with("byte ")) << geometry.error().text();
      continue;
    }
    ++read_count;
    const auto mesh = mesh_of_wkb(*geometry, WkbHoles::triangulated);
    EXPECT_TRUE(mesh.ok() || mesh.error().text().starts_with("byte "));
  }
  EXPECT_GE(read_count, 1);
}

TEST(Wkb, reading_hears_an_interrupt) {
  const std::atomic<bool> cancelled = true;
  const auto read = read_wkb(*bytes_of_hex(kPostgisTetrahedron), WkbContents::faces, Srid::none, Monitor(&cancelled));
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::wkb_tests
