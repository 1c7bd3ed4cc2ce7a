#include "rounding_chains.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <ctime>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/time.h>

#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/library/shape_access.h"
#include "algebra3d/values/constructions/shape_makers.h"
#include "base/context.h"
#include "base/diagnostics.h"

namespace bench {
namespace {

using algebra3d::CoordinateGrid;
using algebra3d::Monitor;
using algebra3d::RoundedSolid;
using algebra3d::Solid;
using algebra3d::TriangleMesh;
using algebra3d::Vec3;
using algebra3d::detail::ShapeAccess;

constexpr double kGoal = 2;  // ms of processor time per given triangle
constexpr std::size_t kMostSteps = 4;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Ends the rounding of a step that takes too much processor time.
std::atomic<bool> is_stopped = false;

class Alarm {
 public:
  explicit Alarm(double seconds) {
    is_stopped = false;
    std::signal(SIGPROF, [](int) { is_stopped = true; });
    set(seconds);
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  ~Alarm() { set(0); }

 private:
  static void set(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  /// A power of ten with three digits, as the statements show it.
  double tiny(int least, int most) { return std::stod(fmt::format("{:.2e}", std::pow(10.0, -between(least, most)))); }
  /// Coordinates from -1 to 1 with three digits.
  Vec3 point() { return {whole(-1000, 1000) / 1000.0, whole(-1000, 1000) / 1000.0, whole(-1000, 1000) / 1000.0}; }
  Vec3 axis() {
    Vec3 axis;
    while (dot(axis, axis) == 0)
      axis = {static_cast<double>(whole(-3, 3)), static_cast<double>(whole(-3, 3)), static_cast<double>(whole(-3, 3))};
    return axis;
  }

 private:
  std::mt19937_64 random_;
};

std::string text(const char* maker, const Vec3& v) {
  return fmt::format("{}({}, {}, {})", maker, v.x, v.y, v.z);
}

/// A solid and the expression of the language that makes it.
struct Made {
  Solid solid;
  std::string expression;
};

Made first_solid(Chance& chance) {
  const int kind = chance.whole(0, 4), corners = chance.whole(3, 12);
  if (kind == 0)
    return {Solid::box({0, 0, 0}, {1, 1, 1}).value(), "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))"};
  if (kind < 3)
    return {Solid::sphere({0, 0, 0}, 1, corners).value(),
            fmt::format("createSphere(makePoint3D(0, 0, 0), 1, {})", corners)};
  algebra3d::Diagnostics diagnostics;
  algebra3d::Context context{.diagnostics = diagnostics};
  const auto cylinder =
      algebra3d::upright_prism(context, algebra3d::Point3d{algebra3d::ExactPoint(Vec3{0, 0, 0})}, 1, 1, corners);
  return {ShapeAccess::outer(cylinder.value().value()),
          fmt::format("createCylinder(makePoint3D(0, 0, 0), 1, 1, {})", corners)};
}

/// The solid V turned or moved by very little.
Made moved(const Solid& v, Chance& chance) {
  if (chance.whole(0, 4) == 0) {
    Vec3 by;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (chance.whole(0, 2) > 0) by[axis] = (chance.whole(0, 1) == 0 ? -1 : 1) * chance.tiny(7, 16);
    return {v.translated(by).value(), fmt::format("(V translate[{}])", text("makeVector3D", by))};
  }
  const Vec3 centre = chance.whole(0, 1) == 0 ? Vec3{} : chance.point(), axis = chance.axis();
  const double degrees = chance.tiny(4, 15);
  return {v.rotated(centre, axis, degrees).value(),
          fmt::format("(V rotate[{}, {}, {}])", text("makePoint3D", centre), text("makeVector3D", axis), degrees)};
}

Made combined(const Solid& v, const Solid& w, Chance& chance) {
  switch (chance.whole(0, 3)) {
    case 0:
      return {subtract(v, w).value(), "V minus W"};
    case 1:
      return {unite(v, w).value(), "V union W"};
    case 2:
      return {intersect(v, w).value(), "intersection(V, W)"};
    default:
      return {symmetric_difference(v, w).value(), "symmetricDifference(V, W)"};
  }
}

std::pair<CoordinateGrid, std::string> any_grid(Chance& chance) {
  switch (chance.whole(0, 4)) {
    case 0:
      return {CoordinateGrid::floats(), "\"floats\""};
    case 1: {
      const double width = std::pow(10.0, -chance.whole(6, 12));
      return {CoordinateGrid::multiples(width), fmt::format("{}", width)};
    }
    default:
      return {CoordinateGrid::doubles(), "\"doubles\""};
  }
}

/// Measurements of one step.
struct Step {
  std::uint64_t chain = 0;
  std::size_t number = 0, faces = 0;
  double seconds = 0, units = 0;
  std::string method, statements;
  std::vector<std::pair<std::string, double>> phases;

  double ms_per_face() const { return 1000 * seconds / static_cast<double>(faces); }
};

class Chains {
 public:
  explicit Chains(const ChainOptions& options) : options_(options) {}

  void run(std::uint64_t chain);
  std::size_t report();

 private:
  std::optional<RoundedSolid> rounded(const TriangleMesh& mesh, const CoordinateGrid& grid, Step& step) const;

  ChainOptions options_;
  std::vector<Step> steps_;
  std::size_t too_large_ = 0;
};

/// Nothing if it was stopped, or refused.
std::optional<RoundedSolid> Chains::rounded(const TriangleMesh& mesh, const CoordinateGrid& grid, Step& step) const {
  const Monitor::Report note = [&](const std::string& how_far) {
    if (how_far.starts_with("rounding: ")) step.phases.emplace_back(how_far.substr(10), processor_seconds());
  };
  const double start = processor_seconds();
  auto result = [&] {
    const Alarm alarm(options_.seconds);
    return rounded_solid(mesh, grid, {&is_stopped, &note});
  }();
  const double end = processor_seconds();
  step.seconds = end - start;
  for (std::size_t i = 0; i < step.phases.size(); ++i)
    step.phases[i].second = (i + 1 < step.phases.size() ? step.phases[i + 1].second : end) - step.phases[i].second;
  if (!result.ok()) {
    step.method = "stopped";
    return std::nullopt;
  }
  step.method = !result->mesh ? "refused" : result->mesh->is_empty() ? "nothing left" : name_of(result->method);
  step.units = result->largest_movement / grid.spacing_up_to(largest_coordinate(mesh));
  if (!result->mesh || result->mesh->is_empty()) return std::nullopt;
  return std::optional(*std::move(result));
}

void Chains::run(std::uint64_t chain) {
  Chance chance(chain);
  Made first = first_solid(chance);
  Solid v = std::move(first.solid);
  std::string statements = fmt::format("let_ V = {};\n", first.expression);
  const int step_count = chance.whole(1, kMostSteps);
  for (int n = 1; n <= step_count; ++n) {
    const Made w = moved(v, chance), x = combined(v, w.solid, chance);
    const auto [grid, grid_text] = any_grid(chance);
    statements += fmt::format("let_ W = {};\nlet_ X = {};\nlet_ R = roundCoordinates(X, {});\n", w.expression,
                              x.expression, grid_text);
    const TriangleMesh& mesh = ShapeAccess::content(x.solid).mesh();
    if (mesh.face_count() > options_.max_faces) ++too_large_;
    if (mesh.is_empty() || mesh.face_count() > options_.max_faces) return;
    Step step{.chain = chain, .number = static_cast<std::size_t>(n), .faces = mesh.face_count()};
    std::optional<RoundedSolid> r = rounded(mesh, grid, step);
    step.statements = statements;
    if (options_.tells_phases && step.ms_per_face() > kGoal) {
      fmt::print("chain {} step {}: {} triangles, {:.3g} s, {}, {:.3g} units\n", chain, n, step.faces, step.seconds,
                 step.method, step.units);
      for (const auto& [what, seconds] : step.phases) fmt::print("  {:8.3f} s  {}\n", seconds, what);
      std::fflush(stdout);
    }
    if (getenv("A3D_DBG")) fprintf(stderr, "DBG STEP %s %g units\n", step.method.c_str(), step.units);
    if (options_.tells_steps) {
      fmt::print("{}\t{}\t{}\t{:.4g}\t{:.4g}\t{}\n", chain, n, step.faces, step.seconds, step.units, step.method);
      std::fflush(stdout);
    }
    steps_.push_back(std::move(step));
    if (!r) return;
    v = ShapeAccess::outer(algebra3d::Volume3d::trusted(*std::move(r->mesh)));
    statements += "let_ V = R;\n";
  }
}

std::size_t Chains::report() {
  std::ranges::sort(steps_, std::greater(), &Step::ms_per_face);
  const auto above = static_cast<std::size_t>(
      std::ranges::count_if(steps_, [](const Step& step) { return step.ms_per_face() > kGoal; }));
  std::map<std::string, int> methods;
  double seconds = 0, units = 0;
  std::size_t above_64 = 0;
  for (const Step& step : steps_) {
    ++methods[step.method];
    seconds += step.seconds;
    units = std::max(units, step.units);
    above_64 += step.units > 64 ? 1 : 0;
  }
  const auto at = [&](double share) {
    return steps_.empty()
               ? 0
               : steps_[static_cast<std::size_t>(share * static_cast<double>(steps_.size() - 1))].ms_per_face();
  };
  fmt::print(
      "\n{} chains, {} steps, {} too large; processor time {:.3g} s, per triangle: median {:.3g} ms, 99 of 100 "
      "{:.3g} ms, largest {:.3g} ms; {} above {} ms; moved by up to {:.3g} units, {} above 64\n",
      options_.count, steps_.size(), too_large_, seconds, at(0.5), at(0.01), at(0), above, kGoal, units, above_64);
  for (const auto& [method, times] : methods) fmt::print("  {} {}\n", times, method);
  fmt::print("\n| chain | step | triangles | s | ms per triangle | units | method |\n|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(20, steps_.size()); ++i)
    fmt::print("| {} | {} | {} | {:.3g} | {:.3g} | {:.3g} | {} |\n", steps_[i].chain, steps_[i].number, steps_[i].faces,
               steps_[i].seconds, steps_[i].ms_per_face(), steps_[i].units, steps_[i].method);
  for (std::size_t i = 0; i < std::min(options_.shown, steps_.size()); ++i)
    fmt::print("\nchain {}:\n{}", steps_[i].chain, steps_[i].statements);
  return above;
}

}  // namespace

std::size_t near_coincident_chains(const ChainOptions& options) {
  Chains chains(options);
  for (std::uint64_t i = 0; i < options.count; ++i) chains.run(options.first + i);
  return chains.report();
}

}  // namespace bench
