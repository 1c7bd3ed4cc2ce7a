#include <cfenv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <sstream>
#include <unordered_set>
#include <utility>

#include <gtest/gtest.h>

#include "algebra3d/geometry/box_index.h"
#include "algebra3d/geometry/mesh_files.h"
#include "algebra3d/geometry/solid.h"
#include "algebra3d/geometry/surface.h"

namespace algebra3d {
namespace {

const std::vector<Vec3> kCorners{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
const std::vector<std::array<std::uint32_t, 3>> kTetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

Solid box(double low, double high) {
  return *Solid::box({low, low, low}, {high, high, high});
}

TEST(Solid, measures_of_a_tetrahedron) {
  const Solid solid = *Solid::of_triangles(kCorners, kTetrahedron);
  EXPECT_EQ(solid.triangle_count(), 4U);
  EXPECT_EQ(solid.point_count(), 4U);
  EXPECT_EQ(solid.volume(), 36);
  EXPECT_EQ(solid.exact_volume(), "36");
  EXPECT_EQ(*solid.centroid(), (Vec3{1.5, 1.5, 1.5}));
  EXPECT_EQ(solid.box(), (Box3{{0, 0, 0}, {6, 6, 6}}));
  EXPECT_FALSE(solid.has_fractions());
}

TEST(Solid, what_bounds_none_is_an_error) {
  const auto open = Solid::of_triangles(kCorners, std::span(kTetrahedron).first(3));
  ASSERT_FALSE(open.ok());
  EXPECT_EQ(open.error().code, ErrorCode::invalid_value);
  EXPECT_NE(open.error().text().find("boundary edges"), std::string::npos) << open.error().text();
  const std::vector<std::array<std::uint32_t, 3>> wrong{{0, 1, 4}};
  EXPECT_EQ(Solid::of_triangles(kCorners, wrong).error().text(),
            "triangle 0: there is no point 4; there are 4, numbered from 0");
  EXPECT_EQ(Solid::box({0, 0, 0}, {1, 0, 1}).error().code, ErrorCode::invalid_value);
  EXPECT_EQ(Solid::box({0, 0, 0}, {Box3::kInfinity, 1, 1}).error().code, ErrorCode::invalid_value);
}

TEST(Solid, set_operations_obey_the_laws) {
  const Solid a = box(0, 2), b = box(1, 3);
  const Solid both = *intersect(a, b), either = *unite(a, b);
  EXPECT_EQ(both, box(1, 2));
  EXPECT_EQ(either.volume(), 15);
  EXPECT_EQ(*unite(*subtract(a, b), both), a);
  EXPECT_EQ(*symmetric_difference(a, b), *subtract(either, both));
  EXPECT_EQ(*unite(std::vector{a, b, both}), either);
  EXPECT_EQ(intersect(std::span<const Solid>()).error().code, ErrorCode::wrong_usage);
  EXPECT_TRUE(unite(std::span<const Solid>())->is_empty());
}

TEST(Solid, is_equal_ordered_and_hashed_by_its_points) {
  const Solid whole = box(0, 2);
  const Solid halves = *unite(*Solid::box({0, 0, 0}, {1, 2, 2}), *Solid::box({1, 0, 0}, {2, 2, 2}));
  EXPECT_EQ(whole, halves);
  EXPECT_EQ(whole.hash(), halves.hash());
  EXPECT_NE(whole, box(0, 1));
  EXPECT_TRUE((whole < box(0, 1)) != (box(0, 1) < whole));
  EXPECT_EQ((std::unordered_set<Solid>{whole, halves, box(0, 1)}).size(), 2U);
}

TEST(Solid, goes_through_bytes_and_text_unchanged) {
  const Solid turned = *box(0, 2).rotated({0, 0, 0}, {1, 2, 3}, 30);
  const Solid cut = *intersect(turned, box(-1, 1));
  EXPECT_TRUE(cut.has_fractions());
  EXPECT_EQ(*Solid::of_bytes(cut.bytes()), cut);
  EXPECT_EQ(*Solid::of_text(cut.text()), cut);
  std::ostringstream out;
  out << cut;
  EXPECT_EQ(out.str(), cut.text());
  EXPECT_EQ(Solid::of_bytes("nothing").error().code, ErrorCode::database_corrupt);
  EXPECT_FALSE(Solid::of_text("((").ok());
  EXPECT_FALSE(cut.rounded()->has_fractions());
}

TEST(Solid, motions) {
  const Solid unit = box(0, 1);
  EXPECT_EQ(*unit.translated({2, 2, 2}), box(2, 3));
  EXPECT_EQ(*unit.scaled({0, 0, 0}, {3, 3, 3}), box(0, 3));
  EXPECT_EQ(*unit.mirrored({0, 0, 0}, {1, 0, 0}), *Solid::box({-1, 0, 0}, {0, 1, 1}));
  EXPECT_EQ(*unit.rotated({0, 0, 0}, {0, 0, 1}, 90), *Solid::box({-1, 0, 0}, {0, 1, 1}));
  EXPECT_EQ(unit.rotated({0, 0, 0}, {0, 0, 0}, 90).error().text(), "rotated: the axis is the zero vector");
  EXPECT_EQ(unit.scaled({0, 0, 0}, {1, 0, 1}).error().code, ErrorCode::invalid_value);
}

TEST(Solid, parts) {
  const SplitSolid parts = *split(box(0, 2), {0, 0, 0.5}, {0, 0, 1});
  EXPECT_EQ(parts.in_front.volume(), 6);
  EXPECT_EQ(parts.behind.volume(), 2);
  const auto bodies = unite(box(0, 1), box(5, 6))->components();
  EXPECT_EQ(std::unordered_set<Solid>(bodies->begin(), bodies->end()),
            (std::unordered_set<Solid>{box(0, 1), box(5, 6)}));
}

TEST(Solid, work_that_is_cancelled_is_an_error) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(unite(*Solid::sphere({0, 0, 0}, 1, 200), *Solid::sphere({1, 0, 0}, 1, 200), &cancel).error().code,
            ErrorCode::interrupted);
}

TEST(Solid, errors_name_the_function) {
  EXPECT_EQ(Solid::sphere({0, 0, 0}, -1, 8).error().text(), "sphere: the radius is -1; it must be positive");
  EXPECT_EQ(Solid::box({0, 0, 0}, {1, 0, 1}).error().text(),
            "box: the corners have a coordinate in common, so the solid has no extent there");
  EXPECT_EQ(box(0, 1).scaled({0, 0, 0}, {1, 0, 1}).error().text(), "scaled: a zero factor would flatten the shape");
  EXPECT_EQ(box(0, 1).mirrored({0, 0, 0}, {0, 0, 0}).error().text(), "mirrored: the normal is the zero vector");
  EXPECT_EQ(split(box(0, 1), {0, 0, 0}, {0, 0, 0}).error().text(), "split: the normal is the zero vector");
  EXPECT_EQ(section(box(0, 1), {0, 0, 0}, {0, 0, 0}).error().text(), "section: the normal is the zero vector");
  EXPECT_EQ(Solid().centroid().error().text(), "centroid: an empty solid has no centroid");
}

TEST(Solid, of_too_many_points_or_triangles_is_refused_before_they_are_read) {
  const Vec3 point;
  const std::array<std::uint32_t, 3> triangle{};
  const std::span points(&point, std::size_t{1} << 33U);
  const std::span triangles(&triangle, std::size_t{1} << 33U);
  EXPECT_EQ(Solid::of_triangles(points, kTetrahedron).error().code, ErrorCode::limit_exceeded);
  EXPECT_EQ(Surface::of_triangles(kCorners, triangles).error().code, ErrorCode::limit_exceeded);
  const Box3 empty;
  EXPECT_THROW(BoxIndex(std::span(&empty, std::size_t{1} << 33U)), std::bad_alloc);
}

TEST(Solid, results_do_not_follow_the_rounding_mode_of_the_caller) {
  const int before = std::fegetround();
  for (const int mode : {FE_UPWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const Solid ball = *Solid::sphere({0.1, 0.2, 0.3}, 0.7, 12);
    const Solid turned = *ball.rotated({0, 0, 0}, {1, 2, 3}, 33.3);
    const Solid both = *intersect(ball, turned);
    const double volume = both.volume(), area = both.area();
    const Vec3 centroid = *both.centroid();
    const bool is_equal = both == *Solid::of_text(both.text());
    const double distance = BoxIndex(std::vector<Box3>{ball.box()}).nearest(Box3::of({3, 0.1, 7.7}), 1)[0].distance;
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(before);
    EXPECT_TRUE(is_equal);
    const Solid right_ball = *Solid::sphere({0.1, 0.2, 0.3}, 0.7, 12);
    const Solid right = *intersect(right_ball, *right_ball.rotated({0, 0, 0}, {1, 2, 3}, 33.3));
    EXPECT_EQ(both, right);
    EXPECT_EQ(volume, right.volume());
    EXPECT_EQ(area, right.area());
    EXPECT_EQ(centroid, *right.centroid());
    EXPECT_EQ(distance, BoxIndex(std::vector<Box3>{right_ball.box()}).nearest(Box3::of({3, 0.1, 7.7}), 1)[0].distance);
  }
}

TEST(Solid, planes_that_are_not_finite_are_errors) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Vec3& wrong : {Vec3{nan, 0, 0}, Vec3{0, inf, 0}}) {
    EXPECT_EQ(box(0, 1).mirrored(wrong, {0, 0, 1}).error().code, ErrorCode::invalid_value);
    EXPECT_EQ(box(0, 1).mirrored({0, 0, 0}, wrong).error().code, ErrorCode::invalid_value);
    EXPECT_EQ(split(box(0, 1), wrong, {0, 0, 1}).error().code, ErrorCode::invalid_value);
    EXPECT_EQ(section(box(0, 1), {0, 0, 0}, wrong).error().code, ErrorCode::invalid_value);
  }
}

TEST(Solid, that_was_moved_from_keeps_its_value) {
  Solid solid = box(0, 1);
  const Solid taken = std::move(solid);
  EXPECT_EQ(solid, taken);  // NOLINT(bugprone-use-after-move): what is tested
}

TEST(Solid, what_a_monitor_throws_is_an_error) {
  const Monitor::Report report = [](const std::string&) { throw 42; };
  const Solid ball = *Solid::sphere({0, 0, 0}, 1, 80);
  const auto united = unite(ball, *ball.rotated({0, 0, 0}, {1, 2, 3}, 10), Monitor{nullptr, &report});
  ASSERT_FALSE(united.ok());
  EXPECT_EQ(united.error().code, ErrorCode::internal);
}

TEST(Surface, of_a_solid_and_of_triangles) {
  const Surface shell = boundary(box(0, 1));
  EXPECT_EQ(shell.area(), 6);
  EXPECT_EQ(section(box(0, 2), {0, 0, 1}, {0, 0, 1})->area(), 4);
  const Surface triangle = *Surface::of_triangles(kCorners, std::span(kTetrahedron).first(1));
  EXPECT_EQ(triangle.area(), 18);
  EXPECT_EQ(*Surface::of_bytes(triangle.bytes()), triangle);
  EXPECT_EQ(*intersect(triangle, triangle), triangle);
  EXPECT_TRUE(subtract(triangle, triangle)->is_empty());
}

TEST(MeshFiles, are_written_and_read_again) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "geometry_test";
  std::filesystem::create_directories(folder);
  for (const char* name : {"part.stl", "part.OBJ", "part.off"}) {
    const Status written = write_solid(box(0, 2), folder / name);
    ASSERT_TRUE(written.ok()) << written.error().text();
    const ReadSolid read = *read_solid(folder / name);
    EXPECT_EQ(read.status, "ok");
    EXPECT_EQ(read.solid, box(0, 2));
    EXPECT_EQ(read_surface(folder / name)->area(), 24);
  }
  EXPECT_EQ(write_solid(box(0, 2), folder / "part.ply").error().code, ErrorCode::wrong_usage);
  EXPECT_EQ(read_solid(folder / "part.stl", "gaps=many").error().code, ErrorCode::invalid_value);
  EXPECT_FALSE(read_solid(folder / "none.stl")->solid.has_value());
  std::filesystem::remove_all(folder);
}

TEST(MeshFiles, that_cannot_be_used_have_the_code_of_the_reason) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "geometry_codes_test";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(read_surface(folder / "none.stl").error().code, ErrorCode::file_missing);
  EXPECT_EQ(read_surface(folder).error().code, ErrorCode::file_missing);
  std::ofstream(folder / "wrong.off") << "OFF\n1 1";
  EXPECT_EQ(read_surface(folder / "wrong.off").error().code, ErrorCode::file_format);
  const Status nowhere = write_solid(box(0, 2), folder / "none" / "part.stl");
  EXPECT_EQ(nowhere.error().code, ErrorCode::file_missing);
  EXPECT_NE(nowhere.error().text().find("there is no folder"), std::string::npos) << nowhere.error().text();
  std::filesystem::create_directories(folder / "folder.stl");
  EXPECT_EQ(write_solid(box(0, 2), folder / "folder.stl").error().code, ErrorCode::io_error);
  ASSERT_TRUE(write_solid(box(0, 2), folder / "part.stl").ok());
  const std::string with_zero = (folder / "part.stl").string() + std::string("\0.stl", 5);
  EXPECT_EQ(read_surface(with_zero).error().code, ErrorCode::file_missing);
  EXPECT_NE(read_solid(with_zero)->status.find("zero byte"), std::string::npos);
  EXPECT_EQ(write_solid(box(0, 1), with_zero).error().code, ErrorCode::file_missing);
  EXPECT_EQ(*read_solid(folder / "part.stl")->solid, box(0, 2));
  std::filesystem::remove_all(folder);
}

TEST(BoxIndex, that_was_moved_from_is_empty) {
  BoxIndex index(std::vector<Box3>{{{0, 0, 0}, {1, 1, 1}}});
  const BoxIndex taken = std::move(index);
  EXPECT_EQ(taken.size(), 1U);
  // NOLINTBEGIN(bugprone-use-after-move): what is tested
  EXPECT_EQ(index.size(), 0U);
  EXPECT_TRUE(index.meeting_pairs(taken).empty());
  EXPECT_FALSE(index.erase({{0, 0, 0}, {1, 1, 1}}, 0));
  EXPECT_TRUE(index.insert({{0, 0, 0}, {1, 1, 1}}, 7));
  EXPECT_EQ(index.meeting({{0, 0, 0}, {1, 1, 1}}), std::vector<BoxIndex::Number>{7});
  // NOLINTEND(bugprone-use-after-move)
}

TEST(BoxIndex, finds_what_meets_and_what_is_near) {
  std::vector<Box3> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back({{2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}});
  BoxIndex index(boxes);
  EXPECT_EQ(index.size(), 100U);
  EXPECT_EQ(index.meeting({{3, 0, 0}, {4, 1, 1}}).size(), 2U);
  const auto near = index.nearest(Box3::of({-1, 0, 0}), 2);
  ASSERT_EQ(near.size(), 2U);
  EXPECT_EQ(near[1].number, 1U);
  EXPECT_EQ(near[1].distance, 3);
  EXPECT_TRUE(index.meeting_pairs().empty());
  EXPECT_TRUE(index.insert({{0.5, 0, 0}, {2.5, 1, 1}}, 100));
  EXPECT_EQ(index.meeting_pairs().size(), 2U);
  EXPECT_TRUE(index.erase({{0.5, 0, 0}, {2.5, 1, 1}}, 100));
  EXPECT_EQ(index.meeting_pairs(BoxIndex(boxes)).size(), 100U);
}

}  // namespace
}  // namespace algebra3d
