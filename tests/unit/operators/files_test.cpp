#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "support/scratch_folder.h"
#include "unit/operators/call_operator.h"

namespace algebra3d {
namespace {

using calls::Answer;
using calls::call;
using calls::call_values;
using calls::cube;
using calls::point;
using calls::value;

class Files : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) const { folder_.write(name, content); }
  Answer import(const char* name) const { return call_values("importSTL", {value(name)}, folder_.path("")); }
  Answer import_strictly(const char* name) const {
    return call_values("importSTL", {value(name), value("strict")}, folder_.path(""));
  }
  Answer export_to(const char* name, const Value& solid, bool is_binary = true) const {
    return call_values("exportSTL", {solid, value(std::string("part")), value(name), value(is_binary)},
                       folder_.path(""));
  }

  ScratchFolder folder_;
};

std::string facet(std::string_view a, std::string_view b, std::string_view c, std::string_view normal = "0 0 0") {
  std::ostringstream text;
  text << "facet normal " << normal << " outer loop vertex " << a << " vertex " << b << " vertex " << c
       << " endloop endfacet\n";
  return text.str();
}
// The corner of a cube, outward: x, y and z axes of length 1, volume 1/6.
std::string tetrahedron(const std::string& normal = "0 0 0") {
  return facet("0 0 0", "0 1 0", "1 0 0", normal) + facet("0 0 0", "1 0 0", "0 0 1") +
         facet("0 0 0", "0 0 1", "0 1 0") + facet("1 0 0", "0 1 0", "0 0 1");
}
std::string turned_tetrahedron() {
  return facet("0 0 0", "1 0 0", "0 1 0", "0 0 -1") + facet("0 0 0", "0 0 1", "1 0 0") +
         facet("0 0 0", "0 1 0", "0 0 1") + facet("1 0 0", "0 0 1", "0 1 0");
}
std::string solid(const std::string& facets) {
  return "solid part\n" + facets + "endsolid part\n";
}

TEST_F(Files, a_solid_comes_back_as_it_was_written_in_both_formats) {
  const Volume3d before = call("createSphere", point(1, 2, 3), 0.5, 8).get<Volume3d>();
  // Halves and quarters are floats, other coordinates of this sphere are not: once rounded, they stay.
  for (const bool is_binary : {true, false}) {
    EXPECT_EQ(export_to("part.stl", value(before), is_binary).text(), "TRUE");
    const Answer once = import("part.stl");
    ASSERT_TRUE(once.is_defined());
    EXPECT_TRUE(once.diagnostics.empty());
    EXPECT_NEAR(call("volume", once.single()).get<double>(), call("volume", before).get<double>(), 1e-6);
    EXPECT_EQ(export_to("again.stl", once.single(), is_binary).text(), "TRUE");
    const Answer twice = import("again.stl");
    EXPECT_EQ(compare(once.single(), twice.single()), std::strong_ordering::equal);
  }
}

TEST_F(Files, file_names_start_at_the_folder_of_the_session) {
  EXPECT_EQ(export_to("here.stl", value(cube(point(0, 0, 0), point(1, 1, 1)))).text(), "TRUE");
  EXPECT_TRUE(std::filesystem::exists(folder_.path("here.stl")));
  EXPECT_EQ(call("volume", import("here.stl").single()).get<double>(), 1.0);
}

TEST_F(Files, a_solid_inside_out_is_turned_and_that_is_said) {
  write("part.stl", solid(turned_tetrahedron()));
  const Answer answer = import("part.stl");
  ASSERT_TRUE(answer.is_defined());
  EXPECT_EQ(call("volume", answer.single()).get<double>(), Rational(1, 6).nearest_double());
  ASSERT_EQ(answer.diagnostics.size(), 2U);
  EXPECT_NE(answer.diagnostics[0].find("importSTL: turned right side out"), std::string::npos);
  EXPECT_NE(answer.diagnostics[0].find("part.stl"), std::string::npos);
  EXPECT_NE(answer.diagnostics[1].find("1 normal contradicts the order of the corners (triangle 1)"),
            std::string::npos);
  EXPECT_EQ(import_solid(folder_.path("part.stl"))->status, "ok: turned right side out");
}

TEST_F(Files, normals_that_contradict_the_corners_change_nothing) {
  write("part.stl", solid(tetrahedron("0 0 1")));
  const Answer answer = import("part.stl");
  EXPECT_TRUE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("1 normal contradicts"), std::string::npos);
  EXPECT_EQ(import_solid(folder_.path("part.stl"))->status, "ok");
}

TEST_F(Files, a_hole_is_counted_and_located) {
  write("part.stl", solid(facet("0 0 0", "0 1 0", "1 0 0") + facet("0 0 0", "1 0 0", "0 0 1")));
  const Answer answer = import_strictly("part.stl");
  EXPECT_FALSE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_EQ(answer.diagnostics[0].find("importSTL: part.stl: no valid solid: 4 boundary edges (triangle 1, near ("), 0U)
      << answer.diagnostics[0];
}

TEST_F(Files, crossing_solids_are_counted_as_pairs) {
  std::string other = tetrahedron();
  for (std::size_t at = 0; (at = other.find("vertex 0", at)) != std::string::npos; ++at)
    other.replace(at, 8, "vertex 0.25");
  write("part.stl", solid(tetrahedron() + other));
  const Answer answer = import_strictly("part.stl");
  EXPECT_FALSE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("intersecting pairs (triangles "), std::string::npos) << answer.diagnostics[0];
}

TEST_F(Files, a_degenerate_and_a_duplicate_triangle_are_named_by_their_numbers) {
  write("part.stl", solid(tetrahedron() + facet("0 0 0", "1 0 0", "2 0 0") + facet("0 0 0", "0 1 0", "1 0 0")));
  const Answer answer = import_strictly("part.stl");
  EXPECT_FALSE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("1 degenerate triangle (triangle 5"), std::string::npos)
      << answer.diagnostics[0];
  EXPECT_NE(answer.diagnostics[0].find("1 duplicate triangle (triangles 1 and 6"), std::string::npos)
      << answer.diagnostics[0];
}

TEST_F(Files, what_is_no_solid_because_of_the_file_is_undefined_with_the_reason) {
  write("short.stl", std::string(80, 'x') + std::string("\x05\0\0\0", 4) + "too short");
  std::filesystem::create_directory(folder_.path("folder.stl"));
  for (const auto& [name, reason] : std::map<std::string, std::string>{
           {"missing.stl", "No such file"}, {"folder.stl", "Is a directory"}, {"short.stl", "byte"}}) {
    const Answer answer = import(name.c_str());
    EXPECT_FALSE(answer.is_defined());
    ASSERT_EQ(answer.diagnostics.size(), 1U);
    EXPECT_NE(answer.diagnostics[0].find(name), std::string::npos) << answer.diagnostics[0];
    EXPECT_NE(answer.diagnostics[0].find(reason), std::string::npos) << answer.diagnostics[0];
  }
}

TEST_F(Files, no_facets_are_the_empty_solid) {
  write("part.stl", "solid nothing\nendsolid nothing\n");
  const Answer answer = import("part.stl");
  ASSERT_TRUE(answer.is_defined());
  EXPECT_EQ(answer.text(), "()");
}

TEST_F(Files, export_refuses_what_floats_would_break) {
  const Answer answer = export_to("part.stl", value(cube(point(1e9, 0, 0), point(1e9 + 1, 1, 1))));
  EXPECT_EQ(answer.text(), "FALSE");
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("part.stl: rounded to floats, nothing of the solid is left"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("part.stl")));
}

TEST_F(Files, export_divides_triangles_that_cross_when_rounded_to_floats) {
  // At 1e9 floats are 64 apart.
  const Answer answer = export_to("part.stl", call("createSphere", point(1e9, 0, 0), 100.0, 50).single());
  EXPECT_EQ(answer.text(), "TRUE");
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("rounded to floats, which moves the remaining boundary by at most "),
            std::string::npos)
      << answer.diagnostics[0];
  EXPECT_TRUE(import("part.stl").is_defined());
}

// At 1e7 floats are 1 apart: the cube becomes one of edge 1.
TEST_F(Files, export_says_so_if_rounding_is_seen) {
  const Answer answer =
      export_to("part.stl", value(cube(point(1e7 + 0.45, 0.45, 0.45), point(1e7 + 0.55, 0.55, 0.55))));
  EXPECT_EQ(answer.text(), "TRUE");
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_TRUE(answer.diagnostics[0].starts_with(
      "exportSTL: rounded to floats, which moves the remaining boundary by at most 0.4"))
      << answer.diagnostics[0];
  EXPECT_NE(answer.diagnostics[0].find(" and makes the volume 0.0"), std::string::npos) << answer.diagnostics[0];
  EXPECT_NE(answer.diagnostics[0].find(" instead of 0.00"), std::string::npos) << answer.diagnostics[0];
  EXPECT_NE(answer.diagnostics[0].find("exportOBJ and exportOFF in ASCII keep doubles (part.stl)"), std::string::npos)
      << answer.diagnostics[0];
  // Moved as a whole: the volume is right, but not the place.
  const Answer moved = export_to("part.stl", value(cube(point(1e7 + 0.4, 0, 0), point(1e7 + 3.4, 1, 1))));
  ASSERT_EQ(moved.diagnostics.size(), 1U);
  EXPECT_EQ(moved.diagnostics[0].find("volume"), std::string::npos) << moved.diagnostics[0];
  // A plate that becomes a fifth thicker, though nothing moves far.
  const Answer plate = export_to("part.stl", value(cube(point(0, 0, 1000), point(1e4, 1e4, 1000.00005))));
  ASSERT_EQ(plate.diagnostics.size(), 1U);
  EXPECT_NE(plate.diagnostics[0].find(" and makes the volume "), std::string::npos) << plate.diagnostics[0];
}

// The plate is thinner than floats are at its place, though they are fine enough for the other body.
TEST_F(Files, export_says_so_if_a_body_vanishes) {
  const Value both =
      call("union", cube(point(0, 0, 0), point(1e-50, 1, 1)), cube(point(5, 0, 0), point(6, 1, 1))).single();
  const Answer answer = export_to("part.stl", both);
  EXPECT_EQ(answer.text(), "TRUE");
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("; 1 shell instead of 2: some vanished or merged; exportOBJ "),
            std::string::npos)
      << answer.diagnostics[0];
  const Answer rounded = call("roundCoordinates", both, 0.001);
  ASSERT_EQ(rounded.diagnostics.size(), 1U);
  EXPECT_NE(rounded.diagnostics[0].find("; 1 shell instead of 2: some vanished or merged"), std::string::npos)
      << rounded.diagnostics[0];
}

// The crumb is thinner than floats are at its place, and vanishes; the other body stays where it is.
TEST_F(Files, the_distance_of_a_rounding_is_that_of_what_remains) {
  const Value both =
      call("union", cube(point(0, 0, 0), point(9, 9, 9)), cube(point(20, 0, 0), point(20.125, 0.125, 0.125))).single();
  const Answer rounded = call("roundCoordinates", both, 1.0);
  ASSERT_EQ(rounded.diagnostics.size(), 1U);
  EXPECT_EQ(rounded.diagnostics[0],
            "roundCoordinates: 7 of 16 vertices moved, but not the remaining boundary; method: vertices moved; 1 shell "
            "instead of 2: some vanished or merged");
  const Value far =
      call("union", cube(point(0, 0, 0), point(1e9, 1e9, 1e9)), cube(point(2e9, 0, 0), point(2e9 + 1, 1, 1))).single();
  const Answer exported = export_to("part.stl", far);
  ASSERT_EQ(exported.diagnostics.size(), 1U);
  EXPECT_TRUE(
      exported.diagnostics[0].starts_with("exportSTL: rounded to floats, which does not move the remaining boundary "
                                          "(vertices moved); 1 shell instead of 2"))
      << exported.diagnostics[0];
}

TEST_F(Files, export_is_quiet_if_rounding_is_not_seen) {
  for (const double x : {0.1, 1000.1, 100'000.1}) {
    EXPECT_TRUE(export_to("part.stl", value(cube(point(x, 0.3, 0.3), point(x + 100, 90.7, 80.9)))).diagnostics.empty());
    EXPECT_TRUE(
        export_to("part.stl", call("createSphere", point(x, 0.1, 0.7), 100.0, 20).single()).diagnostics.empty());
  }
}

TEST_F(Files, a_content_of_another_format_is_read_as_what_it_is) {
  const std::string off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const std::map<std::string, std::string> contents = {{"STL", solid(tetrahedron())}, {"OFF", off}, {"OBJ", obj}};
  for (const auto& [found, content] : contents)
    for (const std::string asked : {"STL", "OBJ", "OFF"}) {
      write("part." + asked, content);
      const Answer answer = call_values("import" + asked, {value(("part." + asked).c_str())}, folder_.path(""));
      ASSERT_TRUE(answer.is_defined()) << found << " as " << asked;
      if (found == asked)
        EXPECT_TRUE(answer.diagnostics.empty());
      else
        EXPECT_EQ(answer.diagnostics,
                  (std::vector<std::string>{"import" + asked + ": the content is " + found + ", not " + asked +
                                            ", and is read as that (part." + asked + ")"}));
    }
  EXPECT_EQ(call_values("checkSTL", {value("part.OBJ")}, folder_.path("")).text(), "'ok'");
}

TEST_F(Files, what_is_wrong_with_a_content_of_another_format_is_named) {
  write("part.stl", "OFF\n4 4 0\n0 0 0\n1 0 x\n");
  const Answer answer = import("part.stl");
  EXPECT_FALSE(answer.is_defined());
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_TRUE(
      answer.diagnostics[0].starts_with("importSTL: " + folder_.path("part.stl").string() + ": byte 20, line 4: "))
      << answer.diagnostics[0];
  EXPECT_TRUE(answer.diagnostics[0].ends_with(" (the content is OFF, not STL)")) << answer.diagnostics[0];
}

TEST_F(Files, export_refuses_coordinates_beyond_floats_and_keeps_the_old_file) {
  write("part.stl", "old");
  const Answer answer = export_to("part.stl", value(cube(point(0, 0, 0), point(1e39, 1, 1))));
  EXPECT_EQ(answer.text(), "FALSE");
  ASSERT_EQ(answer.diagnostics.size(), 1U);
  EXPECT_NE(answer.diagnostics[0].find("part.stl: rounded to floats, a coordinate is out of range"), std::string::npos);
  EXPECT_EQ(folder_.bytes("part.stl"), "old");
}

TEST_F(Files, export_of_undefined_or_to_nowhere_is_false_with_a_reason) {
  const Answer undefined = export_to("part.stl", Value(TypeOf<Volume3d>::type()));
  EXPECT_EQ(undefined.text(), "FALSE");
  EXPECT_EQ(undefined.diagnostics, std::vector<std::string>{"exportSTL: the solid is undefined"});
  const Answer nowhere = export_to("no/such/part.stl", value(cube(point(0, 0, 0), point(1, 1, 1))));
  EXPECT_EQ(nowhere.text(), "FALSE");
  ASSERT_EQ(nowhere.diagnostics.size(), 1U);
  EXPECT_NE(nowhere.diagnostics[0].find("no/such"), std::string::npos);
}

TEST_F(Files, export_of_the_empty_solid_gives_a_file_that_reads_as_empty) {
  EXPECT_EQ(export_to("part.stl", value(Volume3d())).text(), "TRUE");
  EXPECT_EQ(import("part.stl").text(), "()");
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

using NamedCells = std::map<std::string, std::string>;

// The rows of MANIFEST.csv, whose counts and volumes come from other programs.
std::vector<NamedCells> manifest(const std::filesystem::path& folder) {
  std::ifstream file(folder / "MANIFEST.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> columns = split(line);
  std::vector<NamedCells> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = split(line);
    NamedCells& row = rows.emplace_back();
    for (std::size_t i = 0; i < fields.size() && i < columns.size(); ++i) row[columns[i]] = fields[i];
  }
  return rows;
}

void expect_as_in_manifest(NamedCells& row, const ImportedSolid& imported) {
  ASSERT_TRUE(imported.solid) << imported.status;
  EXPECT_EQ(std::to_string(imported.solid->mesh().face_count()), row["triangles"]);
  EXPECT_TRUE(is_closed(imported.solid->mesh()));
  const double expected = std::stod(row["volume"]);
  EXPECT_NEAR(call("volume", *imported.solid).get<double>(), expected, 1e-6 * std::abs(expected));
}

TEST(ImportCorpus, clean_files_are_solids_as_the_manifest_says_and_others_have_a_reason) {
  const char* folder = std::getenv("ALGEBRA3D_CORPUS");
  if (folder == nullptr) GTEST_SKIP() << "ALGEBRA3D_CORPUS is not set: no folder of real files to import";
  std::size_t clean_count = 0;
  for (NamedCells& row : manifest(folder)) {
    if (!row["fmt"].starts_with("stl_")) continue;
    SCOPED_TRACE(row["file"]);
    const auto imported = import_solid(std::filesystem::path(folder) / row["file"]);
    ASSERT_TRUE(imported) << imported.error().text();
    if (row["class"].starts_with("clean_")) {
      ++clean_count;
      expect_as_in_manifest(row, *imported);
      continue;
    }
    EXPECT_FALSE(imported->status.empty());
    if (!imported->solid) {
      EXPECT_FALSE(imported->status.starts_with("ok")) << imported->status;
    }
  }
  EXPECT_GT(clean_count, 0U) << "no clean STL file in the manifest of " << folder;
}

}  // namespace
}  // namespace algebra3d
