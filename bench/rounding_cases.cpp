// The hard cases of rounding, as a table in Markdown: how far the boundary moved, by which method, and the processor
// time beside that of the operation (docs/decisions/0015-feature-snapping.md). Arguments: parts of names of families to
// be run (all without), and STEPS=n for the length of the chain. ALGEBRA3D_MODELS names STL files (models.h). The
// family "close" prints another table (rounding_chains.h) and is run only if asked for: CHAINS=n FIRST=n SECONDS=n
// PHASES=1 EACH=1.
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/library/shape_access.h"
#include "models.h"
#include "rounding_chains.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::CoordinateGrid;
using algebra3d::Operand;
using algebra3d::RoundedSolid;
using algebra3d::Solid;
using algebra3d::WindingVector;
using algebra3d::detail::ShapeAccess;

const TriangleMesh& mesh_of_solid(const Solid& solid) {
  return ShapeAccess::content(solid).mesh();
}

/// Processor time of all threads, which does not depend on what else runs.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The largest values of the roundings of a family, how many there were of each method, and the sums of the times.
struct Row {
  std::size_t count = 0, refused = 0, empty = 0, triangles_in = 0, triangles_out = 0, contacts = 0, above_64 = 0;
  double units = 0, operation = 0, rounding = 0;
  std::map<std::string, int> methods;

  RoundedSolid add(const TriangleMesh& solid, const CoordinateGrid& grid, double operation_seconds) {
    const auto start = std::clock();
    RoundedSolid rounded = algebra3d::rounded_solid(solid, grid).value();
    rounding += seconds_since(start);
    operation += operation_seconds;
    ++count;
    triangles_in = solid.face_count();
    if (!rounded.mesh) {
      ++refused;
      return rounded;
    }
    empty += rounded.mesh->is_empty() ? 1 : 0;
    triangles_out = rounded.mesh->face_count();
    contacts += rounded.contact_vertices;
    const double moved = rounded.largest_movement / grid.spacing_up_to(largest_coordinate(solid));
    units = std::max(units, moved);
    above_64 += moved > 64 ? 1 : 0;
    ++methods[name_of(rounded.method)];
    return rounded;
  }

  void print(const std::string& name) const {
    std::string how;
    for (const auto& [method, times] : methods)
      how += (how.empty() ? "" : ", ") + method + (count > 1 ? fmt::format(" {}", times) : "");
    if (refused > 0) how += fmt::format(", refused {}", refused);
    if (empty > 0) how += fmt::format(", empty {}", empty);
    fmt::print("| {} | {} | {:.3g} | {} | {} | {} | {:.3g} | {:.3g} |\n", name, triangles_in, units, above_64, how,
               contacts, operation, rounding);
    std::fflush(stdout);
  }
};

/// The sphere of the language without itself, turned; or the symmetric difference.
void close_spheres(int corners, double degrees, bool symmetric, const CoordinateGrid& grid, const std::string& name) {
  const Solid sphere = Solid::sphere({}, 1, corners).value();
  const Solid turned = sphere.rotated({}, {1, 2, 3}, degrees).value();
  const auto start = std::clock();
  const Solid shells = symmetric ? symmetric_difference(sphere, turned).value() : subtract(sphere, turned).value();
  const double operation = seconds_since(start);
  Row row;
  row.add(mesh_of_solid(shells), grid, operation);
  row.print(name);
}

void spheres() {
  for (const int corners : {16, 24, 32, 40, 80})
    for (const int digits : {6, 8, 10, 12})
      close_spheres(corners, std::pow(10.0, -digits), false, CoordinateGrid::doubles(),
                    fmt::format("1: sphere n = {} without itself, 1e-{} degrees", corners, digits));
}

/// V := rounded(V turned, intersected with a cube).
void chain(int steps) {
  const Solid cube = Solid::box({-1, -1, -1}, {1, 1, 1}).value();
  Solid solid = cube;
  Row row;
  for (int n = 1; n <= steps; ++n) {
    const auto start = std::clock();
    const Vec3 axis{static_cast<double>(n % 3), static_cast<double>(n % 5), 1};
    const Solid cut = intersect(solid.rotated({}, axis, n * 37.7).value(), cube).value();
    const RoundedSolid rounded = row.add(mesh_of_solid(cut), CoordinateGrid::doubles(), seconds_since(start));
    if (!rounded.mesh) break;
    solid = ShapeAccess::outer(algebra3d::Volume3d::trusted(*rounded.mesh));
  }
  row.print(fmt::format("2: chain of {} steps, {:.2f} times the triangles needed, volume {:.4f}", steps,
                        static_cast<double>(row.triangles_out) / (4.0 * 6 * (steps + 1) - 12), solid.volume()));
}

TriangleMesh united(const TriangleMesh& a, const TriangleMesh& b) {
  const auto in_any = [](const WindingVector& h) { return h[0] + h[1] > 0; };
  return algebra3d::combine_solids(std::array<Operand, 2>{{{&a, 0}, {&b, 1}}}, in_any).value();
}

/// A turned cube less all rods of a sponge at once.
void sponge(int level) {
  const double radians = kRoot2 / 2;
  std::vector<TriangleMesh> solids{mesh_of(sponge_cube(level, radians))};
  for (const Shape& rod : rods(level, radians)) solids.push_back(mesh_of(rod));
  std::vector<Operand> operands;
  for (const TriangleMesh& solid : solids) operands.push_back({&solid, operands.empty() ? 0U : 1U});
  const auto in_first_only = [](const WindingVector& h) { return h[0] > 0 && h[1] == 0; };
  const auto start = std::clock();
  const TriangleMesh rest = algebra3d::combine_solids(operands, in_first_only).value();
  const double operation = seconds_since(start);
  Row row;
  row.add(rest, CoordinateGrid::doubles(), operation);
  row.print(fmt::format("3: turned sponge of level {}", level));
}

void models_with_copies() {
  for (std::size_t i = 0; i < models().size(); ++i)
    for (const int variant : {0, 1}) {
      const TriangleMesh a = mesh_of(models()[i]), b = mesh_of(copy_of(models()[i], variant));
      const auto start = std::clock();
      const TriangleMesh both = united(a, b);
      const double operation = seconds_since(start);
      Row row;
      row.add(both, CoordinateGrid::doubles(), operation);
      row.print(fmt::format("3: model {} and a copy, {}", i, variant == 0 ? "turned" : "shifted by 1e-9 of its size"));
    }
}

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vec3 whole_point(int low, int high) {
    const int x = whole(low, high), y = whole(low, high), z = whole(low, high);
    return Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
  }

 private:
  std::mt19937_64 random_;
};

/// Unions of up to 8 boxes between points of a small grid, turned: what was common is a hair apart, or overlaps by one.
void turned_boxes(const CoordinateGrid& grid, const std::string& name) {
  Row row;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Chance chance(seed);
    const double radians = chance.between(0, 6);
    const Vec3 axis = chance.whole_point(1, 9);
    double operation = 0;
    TriangleMesh solid;
    for (int i = chance.whole(2, 8); i > 0; --i) {
      const Vec3 corner = chance.whole_point(0, 4), size = chance.whole_point(1, 3);
      const TriangleMesh next = mesh_of(moved(box(corner, corner + size), axis, radians, {}));
      const auto start = std::clock();
      solid = united(solid, next);
      operation += seconds_since(start);
    }
    row.add(solid, grid, operation);
  }
  row.print(name);
}

/// Turned slabs of some tenths to some units thickness.
void slabs() {
  Row row;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Chance chance(seed);
    const double thickness = 0.3 * chance.whole(1, 10);
    const Shape slab = moved(box({}, {40, 30, thickness}), chance.whole_point(1, 9), chance.between(0, 6), {});
    row.add(mesh_of(slab), CoordinateGrid::multiples(1), 0);
  }
  row.print("4: 60 turned slabs of 0.3 to 3 times the grid, 40 long");
}

void far_scales() {
  for (const double scale : {1e300, 1e-300}) {
    Shape a = sphere(7), b = other_sphere(7);
    for (Vec3& p : a.points) p = scale * p;
    for (Vec3& p : b.points) p = scale * p;
    const auto start = std::clock();
    const TriangleMesh both = united(mesh_of(a), mesh_of(b));
    const double operation = seconds_since(start);
    Row row;
    row.add(both, CoordinateGrid::doubles(), operation);
    row.print(fmt::format("4: union of spheres with coordinates about {}", scale));
  }
}

void coarse_grids() {
  Row row;
  const TriangleMesh solid = united(mesh_of(sphere(7)), mesh_of(other_sphere(7)));
  for (const double step : {0.03, 0.1, 0.3, 0.7, 1.0, 1.7, 3.0, 10.0})
    row.add(solid, CoordinateGrid::multiples(step), 0);
  row.print("4: union of spheres to grids of 0.03 to 10");
}

/// The arguments of the program.
struct Arguments {
  int steps = 300;
  ChainOptions chains;
  std::vector<std::string> wanted;

  Arguments(int count, char** texts) {
    for (int i = 1; i < count; ++i) add(texts[i]);
  }
  void add(const std::string& text) {
    const std::size_t sign = text.find('=');
    const std::string name = text.substr(0, sign);
    if (sign == std::string::npos) {
      wanted.push_back(text);
      return;
    }
    const int value = std::stoi(text.substr(sign + 1));
    if (name == "STEPS") steps = value;
    if (name == "CHAINS") chains.count = static_cast<std::size_t>(value);
    if (name == "FIRST") chains.first = static_cast<std::uint64_t>(value);
    if (name == "SECONDS") chains.seconds = value;
    if (name == "EACH") chains.tells_steps = value != 0;
    if (name == "PHASES") chains.tells_phases = value != 0;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments(argc, argv);
  const auto& [steps, chains, wanted] = arguments;
  // Exit status 1 if a step took longer than the goal.
  if (wanted == std::vector<std::string>{"close"}) return near_coincident_chains(chains) == 0 ? 0 : 1;
  const auto run = [&](const std::string& name, const auto& family) {
    bool is_wanted = wanted.empty();
    for (const std::string& part : wanted) is_wanted = is_wanted || name.find(part) != std::string::npos;
    if (is_wanted) family();
  };
  fmt::print("| case | triangles | moved by units | above 64 | method | contacts | operation, s | rounding, s |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  run("spheres", spheres);
  run("chain", [&, steps = arguments.steps] { chain(steps); });
  run("sponge", [] { sponge(3); });
  run("symmetric", [] {
    close_spheres(160, 0.01, true, CoordinateGrid::floats(),
                  "3: symmetric difference of spheres n = 160, 0.01 degrees, to floats");
  });
  run("models", models_with_copies);
  run("boxes", [] { turned_boxes(CoordinateGrid::doubles(), "4: 120 unions of up to 8 turned boxes"); });
  run("boxes", [] { turned_boxes(CoordinateGrid::floats(), "4: the same, to floats"); });
  run("slabs", slabs);
  run("scales", far_scales);
  run("coarse", coarse_grids);
}
