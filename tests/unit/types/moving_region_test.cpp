// uregion and mregion. Areas are computed by hand.
#include <compare>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/moving_region.h"
#include "unit/types/reading.h"

namespace algebra3d::moving_region_tests {
namespace {

template <typename T>
Reading read(const std::string& text) {
  return reading_of(TypeOf<T>::type(), text);
}

template <typename T>
Value value_of(const std::string& text) {
  const auto reading = read<T>(text);
  EXPECT_TRUE(reading.value.ok()) << text << ": " << (reading.value.ok() ? "" : reading.value.error().text());
  if (!reading.value.ok()) return Value(TypeOf<T>::type());
  EXPECT_TRUE(reading.value->is_defined())
      << text << ": " << (reading.diagnostics.empty() ? "" : reading.diagnostics[0].text);
  return *reading.value;
}

RegionUnit unit_of(const std::string& text) {
  return value_of<RegionUnit>(text).get<RegionUnit>();
}
MovingRegion moving_of(const std::string& text) {
  return value_of<MovingRegion>(text).get<MovingRegion>();
}

template <typename T>
std::string error_of(const std::string& text) {
  const auto reading = read<T>(text);
  if (reading.value.ok()) return "no error";
  EXPECT_EQ(reading.value.error().code, ErrorCode::invalid_value);
  return reading.value.error().text();
}

template <typename T>
std::string reason_of(const std::string& text) {
  const auto reading = read<T>(text);
  EXPECT_TRUE(reading.value.ok()) << text;
  if (!reading.value.ok() || reading.value->is_defined() || reading.diagnostics.size() != 1) return "no reason";
  return reading.diagnostics[0].text;
}

const std::string kDay = "(0 1 TRUE FALSE)";

/// A unit of one day.
std::string day(const std::string& faces) {
  return "(" + kDay + " (" + faces + "))";
}

/// Twice the area at a part of a day.
Rational doubled_area_at(const RegionUnit& unit, std::int64_t milliseconds) {
  const auto region = unit.at({milliseconds});
  EXPECT_TRUE(region.ok());
  EXPECT_FALSE(polygon_defect(region->polygons())->has_value());
  return doubled_area(region->polygons());
}

constexpr std::int64_t kHalf = kMillisecondsPerDay / 2;

const std::string kGrowing = "(((0 0 0 0) (2 0 4 0) (2 2 4 4) (0 2 0 4)))";
const std::string kFrame =
    "(((0 0 0 0) (9 0 9 0) (9 9 9 9) (0 9 0 9)) ((1 1 1 1) (3 1 4 1) (1 3 1 4)) ((5 5 6 6) (7 5 8 6) (5 8 6 8)))";

// --- Notation

TEST(moving_region, units_print_as_they_were_given_but_for_the_sense_of_rotation) {
  EXPECT_EQ(value_of<RegionUnit>(day(kGrowing)).to_nested().print(),
            R"((("2000-01-03" "2000-01-04" TRUE FALSE) ((((0.0 0.0 0.0 0.0) (2.0 0.0 4.0 0.0) (2.0 2.0 4.0 4.0) )"
            R"((0.0 2.0 0.0 4.0))))))");
  EXPECT_EQ(value_of<RegionUnit>(day("(((0 0 0 0) (0 2/3 0 4) (2 2 4 4)))")).to_nested().print(),
            R"((("2000-01-03" "2000-01-04" TRUE FALSE) ((((0.0 0.0 0.0 0.0) (2.0 2.0 4.0 4.0) (0.0 2/3 0.0 4.0))))))");
  EXPECT_EQ(value_of<MovingRegion>("()").to_nested().print(), "()");
}

TEST(moving_region, malformed_lists_are_errors) {
  EXPECT_EQ(error_of<RegionUnit>("5"), "uregion: expected (interval (face+)), got 5");
  EXPECT_EQ(error_of<RegionUnit>("()"), "uregion: expected (interval (face+)), got ()");
  EXPECT_EQ(error_of<RegionUnit>("((0 1 TRUE TRUE) ())"),
            "uregion: expected (interval (face+)), got ((0 1 TRUE TRUE) ())");
  EXPECT_EQ(error_of<RegionUnit>("((0 1 TRUE) " + std::string("(") + kGrowing + "))"),
            "uregion: expected (start end leftclosed rightclosed), got (0 1 TRUE)");
  EXPECT_EQ(error_of<RegionUnit>(day("()")), "uregion: expected a face (outer hole*), got ()");
  EXPECT_EQ(error_of<RegionUnit>(day("3")), "uregion: expected a face (outer hole*), got 3");
  EXPECT_EQ(error_of<RegionUnit>(day("(((0 0 0 0) (1 0 1 0)))")),
            "uregion: expected a cycle of at least 3 moving corners ((x1 y1 x2 y2) ...), got ((0 0 0 0) (1 0 1 0))");
  EXPECT_EQ(error_of<RegionUnit>(day("(((0 0 0 0) (1 0 1 0) (1 1)))")), "uregion: expected (x1 y1 x2 y2), got (1 1)");
  EXPECT_EQ(error_of<RegionUnit>(day("(((0 0 0 0) (1 0 1 0) (1 1 TRUE 1)))")),
            "uregion: expected a number or a fraction p/q, got TRUE");
  EXPECT_EQ(error_of<MovingRegion>("a"), "mregion: expected (uregion*), in order of time, got a");
  EXPECT_EQ(error_of<MovingRegion>("(" + day(kGrowing) + " 7)"), "mregion: expected (interval (face+)), got 7");
}

TEST(moving_region, invalid_units_are_undefined_with_unit_segment_and_time) {
  EXPECT_EQ(reason_of<RegionUnit>("((1 0 TRUE TRUE) (" + kGrowing + "))"),
            "uregion: the end 2000-01-03 comes before the start 2000-01-04");
  EXPECT_EQ(reason_of<RegionUnit>("((0 0 TRUE TRUE) (" + kGrowing + "))"),
            "uregion: the corners move within a single instant");
  EXPECT_EQ(reason_of<RegionUnit>("((0 0 TRUE TRUE) ((((0 0 0 0) (1 0 1 0) (2 0 2 0)))))"),
            "uregion: segment (2 0)-(0 0) of face 1, cycle 1 overlaps segment (1 0)-(2 0) of face 1, cycle 1");
  EXPECT_EQ(reason_of<RegionUnit>(day("(((0 0 0 0) (4 0 4 0) (2 3 2 -3)))")),
            "uregion: segment (0 0)-(4 0) moving to (0 0)-(4 0) of face 1, cycle 1 and segment (4 0)-(2 3) moving to "
            "(4 0)-(2 -3) of face 1, cycle 1 overlap at about 0.5 of the unit");
  EXPECT_EQ(reason_of<MovingRegion>("(" + day(kGrowing) + " ((1 2 TRUE TRUE) ((((0 0 0 0) (4 0 4 0) (2 3 2 -3))))))"),
            "mregion: unit 2: segment (0 0)-(4 0) moving to (0 0)-(4 0) of face 1, cycle 1 and segment (4 0)-(2 3) "
            "moving to (4 0)-(2 -3) of face 1, cycle 1 overlap at about 0.5 of the unit");
}

std::string units(const std::vector<std::string>& intervals) {
  std::string text = "(";
  for (const std::string& interval : intervals) text += "(" + interval + " ((((0 0 0 0) (4 0 4 0) (2 3 2 3)))))";
  return text + ")";
}

TEST(moving_region, units_are_in_order_and_share_no_instant) {
  for (const auto& intervals :
       std::vector<std::vector<std::string>>{{"(0 1 TRUE FALSE)", "(1 2 TRUE FALSE)"},
                                             {"(0 1 TRUE TRUE)", "(1 2 FALSE FALSE)"},
                                             {"(0 1 TRUE FALSE)", "(1 1 TRUE TRUE)", "(1 2 FALSE TRUE)"},
                                             {"(0 1 TRUE FALSE)", "(1 2 FALSE FALSE)", "(5 6 TRUE TRUE)"}})
    EXPECT_EQ(moving_of(units(intervals)).units().size(), intervals.size());
  EXPECT_EQ(reason_of<MovingRegion>(units({"(0 1 TRUE TRUE)", "(1 2 TRUE TRUE)"})),
            "mregion: unit 2 (from 2000-01-04 to 2000-01-05) shares an instant with unit 1 (from 2000-01-03 to "
            "2000-01-04)");
  EXPECT_EQ(reason_of<MovingRegion>(units({"(0 1 TRUE TRUE)", "(5 6 TRUE TRUE)", "(3 4 TRUE TRUE)"})),
            "mregion: unit 3 (from 2000-01-06 to 2000-01-07) comes after the later unit 2 (from 2000-01-08 to "
            "2000-01-09)");
  EXPECT_EQ(reason_of<MovingRegion>(units({"(0 2 TRUE TRUE)", "(1 3 TRUE TRUE)"})),
            "mregion: unit 2 (from 2000-01-04 to 2000-01-06) shares an instant with unit 1 (from 2000-01-03 to "
            "2000-01-05)");
}

// --- Equality, order, hash

TEST(moving_region, equality_knows_no_order_of_cycles_and_corners) {
  const Value frame = value_of<RegionUnit>(day(kFrame));
  for (const std::string& same : std::vector<std::string>{
           "(((9 0 9 0) (9 9 9 9) (0 9 0 9) (0 0 0 0)) ((5 5 6 6) (7 5 8 6) (5 8 6 8)) ((1 1 1 1) (3 1 4 1) (1 3 1 "
           "4)))",
           "(((0 0 0 0) (0 9 0 9) (9 9 9 9) (9 0 9 0)) ((3 1 4 1) (1 1 1 1) (1 3 1 4)) ((5 5 6 6) (7 5 8 6) (5 8 6 "
           "8)))"}) {
    const Value other = value_of<RegionUnit>(day(same));
    EXPECT_TRUE(std::is_eq(compare(frame, other))) << same;
    EXPECT_EQ(hash(frame), hash(other));
  }
  const std::string a = "(((0 0 0 0) (1 0 1 0) (0 1 0 1)))", b = "(((5 0 6 0) (7 0 8 0) (5 1 6 1)))";
  EXPECT_TRUE(std::is_eq(compare(value_of<RegionUnit>(day(a + b)), value_of<RegionUnit>(day(b + a)))));
  for (const std::string& other : {day(a), day(b), day(kGrowing), "((0 1 TRUE TRUE) (" + kFrame + "))"}) {
    EXPECT_TRUE(std::is_neq(compare(frame, value_of<RegionUnit>(other))));
    EXPECT_NE(hash(frame), hash(value_of<RegionUnit>(other)));
  }
}

TEST(moving_region, order_is_by_time_first) {
  const Value early = value_of<RegionUnit>("((0 1 TRUE TRUE) (" + kFrame + "))");
  const Value late = value_of<RegionUnit>("((0 2 TRUE TRUE) (" + kGrowing + "))");
  EXPECT_TRUE(std::is_lt(compare(early, late)));
  EXPECT_LE(order_prefix(early), order_prefix(late));
  EXPECT_TRUE(std::is_lt(compare(value_of<MovingRegion>("()"), value_of<MovingRegion>("(" + day(kFrame) + ")"))));
}

// --- Bytes

TEST(moving_region, bytes_read_back_equal) {
  const std::string third = day("(((0 0 0 0) (1 1/3 1 0) (0 1 0 2/7)))");
  for (const std::string& text : {day(kGrowing), day(kFrame), third}) {
    const Value unit = value_of<RegionUnit>(text);
    const Value moving = value_of<MovingRegion>("(" + text + " ((1 2 TRUE TRUE) (" + kFrame + ")))");
    for (const Value* value : {&unit, &moving})
      for (const Origin origin : {Origin::own_store, Origin::elsewhere}) {
        const auto decoded = decode(value->type(), encode(*value), origin);
        ASSERT_TRUE(decoded.ok()) << decoded.error().text();
        EXPECT_TRUE(std::is_eq(compare(*decoded, *value)));
        EXPECT_EQ(decoded->to_nested().print(), value->to_nested().print());
        EXPECT_GT(heap_bytes(*value), 300U);
      }
  }
}

TEST(moving_region, any_change_of_the_bytes_gives_a_value_or_an_error) {
  std::mt19937 random(3);
  const Value value = value_of<MovingRegion>("(" + day(kFrame) + " ((1 2 TRUE TRUE) (" + kGrowing + ")))");
  std::string bytes;
  value.type().encode(value, bytes);
  int values = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string changed = bytes;
    changed[random() % changed.size()] = static_cast<char>(random());
    if (random() % 4 == 0) changed.resize(random() % (changed.size() + 2));
    const auto decoded = value.type().decode(changed, false);
    values += decoded.ok() ? 1 : 0;
    if (!decoded.ok()) {
      EXPECT_EQ(decoded.error().code, ErrorCode::database_corrupt);
    }
  }
  EXPECT_GT(values, 0);
}

// --- What it is at an instant

TEST(moving_region, areas_at_instants_are_those_of_the_shapes) {
  const RegionUnit growing = unit_of(day(kGrowing));
  EXPECT_EQ(doubled_area_at(growing, 0), 8);
  EXPECT_EQ(doubled_area_at(growing, kHalf), 18);
  EXPECT_EQ(doubled_area_at(growing, kMillisecondsPerDay), 32);
  EXPECT_EQ(doubled_area_at(growing, kMillisecondsPerDay / 3), Rational(128, 9));
  EXPECT_EQ(doubled_area_at(unit_of(day(kFrame)), 0), 2 * 81 - 4 - 6);
  EXPECT_EQ(growing.box(), (Box3{{0, 0, 0}, {4, 4, 0}}));
}

TEST(moving_region, parts_that_collapse_at_an_end_are_dropped_there) {
  // All of it, from a point.
  const RegionUnit opening = unit_of(day("(((1 1 0 0) (1 1 4 0) (1 1 4 4) (1 1 0 4)))"));
  EXPECT_EQ(doubled_area_at(opening, 0), 0);
  EXPECT_EQ(opening.at({0})->polygons().face_count(), 0U);
  EXPECT_EQ(doubled_area_at(opening, kHalf), 8);
  // A hole, from a point and from a segment.
  const std::string square = "((0 0 0 0) (8 0 8 0) (8 8 8 8) (0 8 0 8))";
  const RegionUnit hole = unit_of(day("(" + square + " ((3 3 2 2) (3 3 4 2) (3 3 4 4) (3 3 2 4)))"));
  EXPECT_EQ(hole.at({0})->polygons().cycle_count(), 1U);
  EXPECT_EQ(doubled_area_at(hole, 0), 128);
  EXPECT_EQ(doubled_area_at(hole, kMillisecondsPerDay), 120);
  const RegionUnit slit = unit_of(day("(" + square + " ((2 4 2 2) (6 4 6 2) (6 4 6 6) (2 4 2 6)))"));
  EXPECT_EQ(doubled_area_at(slit, 0), 128);
  EXPECT_EQ(slit.at({0})->polygons().cycle_count(), 1U);
  // A hole that reaches the boundary with a whole side becomes a notch.
  const RegionUnit notch = unit_of(day("(" + square + " ((2 1 2 0) (6 1 6 0) (6 3 6 3) (2 3 2 3)))"));
  EXPECT_EQ(doubled_area_at(notch, kMillisecondsPerDay), 128 - 24);
  EXPECT_EQ(notch.at({kMillisecondsPerDay})->polygons().cycle_count(), 1U);
  // One corner of an edge comes to lie on the other.
  const RegionUnit shorter = unit_of(day("(((0 0 0 0) (4 0 2 0) (4 4 2 4) (2 4 2 4) (0 4 0 4)))"));
  EXPECT_EQ(doubled_area_at(shorter, kMillisecondsPerDay), 16);
  EXPECT_EQ(shorter.at({kMillisecondsPerDay})->polygons().corners.size(), 4U);
}

TEST(moving_region, faces_that_meet_at_an_end_are_one_there) {
  const RegionUnit unit =
      unit_of(day("(((0 0 0 0) (2 0 2 0) (2 2 2 2) (0 2 0 2))) (((4 0 2 0) (6 0 4 0) (6 2 4 2) (4 2 2 2)))"));
  EXPECT_EQ(unit.at({0})->polygons().face_count(), 2U);
  EXPECT_EQ(unit.at({kMillisecondsPerDay})->polygons().face_count(), 1U);
  EXPECT_EQ(doubled_area_at(unit, kMillisecondsPerDay), 16);
  // Shifted by half a side: what they share at the end is no longer boundary.
  const RegionUnit shifted =
      unit_of(day("(((0 0 0 0) (2 0 2 0) (2 2 2 2) (0 2 0 2))) (((4 1 2 1) (6 1 4 1) (6 3 4 3) (4 3 2 3)))"));
  EXPECT_EQ(shifted.at({kMillisecondsPerDay})->polygons().face_count(), 1U);
  EXPECT_EQ(shifted.at({kMillisecondsPerDay})->polygons().corners.size(), 8U);
  EXPECT_EQ(doubled_area_at(shifted, kMillisecondsPerDay), 16);
}

TEST(moving_region, random_units_are_regions_at_all_times) {
  // Corners of a square that come together at an end in random ways.
  std::mt19937 random(17);
  int valid = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string cycle = "((";
    const auto any = [&] { return " " + std::to_string(random() % 3); };
    for (const char* corner : {"0 0", "9 0", "9 9", "4 4", "0 9"})
      cycle += std::string("(") + corner + any() + any() + ")";
    const auto reading = read<RegionUnit>(day(cycle + "))"));
    if (!reading.value.ok() || !reading.value->is_defined()) continue;
    ++valid;
    const auto& unit = reading.value->get<RegionUnit>();
    for (const std::int64_t instant : {std::int64_t{0}, kHalf / 3, kHalf, kMillisecondsPerDay})
      doubled_area_at(unit, instant);
    // The area changes as a quadratic in time: its values at 0, 1/2, 1 tell that at 1/4.
    const Rational start = doubled_area_at(unit, 0), half = doubled_area_at(unit, kHalf),
                   end = doubled_area_at(unit, kMillisecondsPerDay);
    EXPECT_EQ(doubled_area_at(unit, kHalf / 2), (3 * start + 6 * half - end) / 8);
  }
  EXPECT_GT(valid, 50);
}

TEST(moving_region, is_defined_where_its_units_are) {
  const MovingRegion moving = moving_of(
      units({"(0 1 TRUE FALSE)", "(1 1 TRUE TRUE)", "(1 2 FALSE FALSE)", "(2 3 FALSE TRUE)", "(5 6 FALSE TRUE)"}));
  const auto unit_at = [&](double days) -> std::ptrdiff_t {
    const RegionUnit* const unit =
        moving.unit_at({static_cast<std::int64_t>(days * static_cast<double>(kMillisecondsPerDay))});
    return unit == nullptr ? -1 : unit - moving.units().data();
  };
  const std::vector<std::pair<double, std::ptrdiff_t>> rows{{-1, -1}, {0, 0}, {0.5, 0}, {1, 1},  {1.5, 2}, {2, -1},
                                                            {2.5, 3}, {3, 3}, {4, -1},  {5, -1}, {6, 4},   {7, -1}};
  for (const auto& [days, unit] : rows) EXPECT_EQ(unit_at(days), unit) << days;
  const auto times = moving.times();
  ASSERT_EQ(times.size(), 3U);
  const std::vector<std::string> expected{R"(("2000-01-03" "2000-01-05" TRUE FALSE))",
                                          R"(("2000-01-05" "2000-01-06" FALSE TRUE))",
                                          R"(("2000-01-08" "2000-01-09" FALSE TRUE))"};
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(interval_to_nested(times[i]).print(), expected[i]);
  EXPECT_TRUE(MovingRegion().times().empty());
  EXPECT_EQ(MovingRegion().unit_at({0}), nullptr);
}

}  // namespace
}  // namespace algebra3d::moving_region_tests
