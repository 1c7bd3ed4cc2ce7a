// interrupt_sweep [--size N] [--moments S,...] [--bound S] [--part P] [--only WORD] [--list]
// How late everything hears an interrupt: every operator over large values, aggregates over many values, reading,
// writing and printing of values (parts `calls` and `values`), commands and operators over streams (`statements`).
// Prints a row for each that is slower than the bound, and the count of them; the exit status is 1 if there are any.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "base/temporary_folder.h"
#include "interrupts/call_sweep.h"
#include "interrupts/measured_call.h"
#include "interrupts/statement_sweep.h"
#include "queries/streams/all.h"

namespace {

using namespace algebra3d;
using namespace algebra3d::interrupts;

struct Settings {
  std::size_t size = 200'000;
  std::vector<double> moments{0.05};
  double bound = 0.2;
  std::string only;
  std::string part;
  bool lists = false;

  bool does(const std::string& name) const { return part.empty() || part == name; }
};

Settings settings_of(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--list") {
      settings.lists = true;
      continue;
    }
    const std::string value = i + 1 < argc ? argv[++i] : "";
    if (name == "--size") settings.size = std::stoul(value);
    if (name == "--bound") settings.bound = std::stod(value);
    if (name == "--only") settings.only = value;
    if (name == "--part") settings.part = value;
    if (name != "--moments") continue;
    settings.moments.clear();
    for (std::size_t begin = 0; begin < value.size();) {
      const std::size_t end = std::min(value.find(',', begin), value.size());
      settings.moments.push_back(std::stod(value.substr(begin, end - begin)));
      begin = end + 1;
    }
  }
  return settings;
}

struct Tally {
  std::size_t works = 0, interrupts = 0, ended = 0, late = 0;
  double latest = 0;
};

void sweep(const std::vector<Work>& works, const Settings& settings, Tally& tally) {
  for (const Work& work : works) {
    if (!settings.only.empty() && work.name.find(settings.only) == std::string::npos) continue;
    ++tally.works;
    for (const double moment : settings.moments) {
      const Measured measured = measure({.moment = moment, .traced = settings.bound}, work.run);
      if (!measured.late && !measured.is_killed) {
        ++tally.ended;
        if (settings.lists) fmt::print("{:8.3f}        -  {}  ({})\n", moment, work.name, measured.outcome);
        break;  // it ends before, so it does at later moments
      }
      ++tally.interrupts;
      const double late = measured.late.value_or(1e9);
      tally.latest = std::max(tally.latest, late);
      if (late > settings.bound) ++tally.late;
      if (late > settings.bound || settings.lists)
        fmt::print("{:8.3f} {:8.3f}  {}  ({}){}\n", moment, late, work.name, measured.outcome,
                   measured.place.empty() ? "" : "\n                     at " + measured.place);
    }
  }
}

/// Every operator over values of one kind of coordinates, and what is done with values themselves.
void sweep_values(const Registry& registry, LargeValues::Coordinates coordinates, const Settings& settings,
                  Tally& tally) {
  const LargeValues values(settings.size, coordinates);
  const std::string what = coordinates == LargeValues::Coordinates::doubles ? ", doubles" : ", fractions";
  if (settings.does("values")) sweep(value_work(registry, values, what), settings, tally);
  if (settings.does("calls")) sweep(calls(registry, values, what), settings, tally);
}

/// False, and told, if the statements cannot run or leave operators out.
bool sweep_statements(const Registry& registry, const Settings& settings, Tally& tally) {
  auto folder = TemporaryFolder::make();
  if (!folder) return false;
  const StatementSweep statements(registry, folder->path(), settings.size);
  if (!statements.obstacle().empty()) fmt::print("no database: {}\n", statements.obstacle());
  for (const std::string& name : statements.missing()) fmt::print("no statement uses {}\n", name);
  sweep(statements.statements(), settings, tally);
  return statements.obstacle().empty() && statements.missing().empty();
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  Registry registry = make_registry();
  queries::register_stream_operators(registry);
  Tally tally;
  fmt::print("  moment     late  of what; times in seconds of processor time, {} elements\n", settings.size);
  bool is_whole = true;
  if (settings.does("statements")) is_whole = sweep_statements(registry, settings, tally);
  for (const auto coordinates : {LargeValues::Coordinates::doubles, LargeValues::Coordinates::fractions})
    if (settings.does("values") || settings.does("calls")) sweep_values(registry, coordinates, settings, tally);
  if (settings.does("aggregates")) sweep(aggregations(registry, 2000), settings, tally);
  fmt::print("{} kinds of work, {} interrupts, {} ended before; {} later than {} s, the latest {:.3f} s\n", tally.works,
             tally.interrupts, tally.ended, tally.late, settings.bound, tally.latest);
  return is_whole && tally.late == 0 && tally.works > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
