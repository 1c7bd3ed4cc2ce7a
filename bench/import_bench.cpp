// Import of mesh files beside CGAL, admesh and assimp, on the same files in the same run.
// - clean: 2 million triangles. Ours reads, welds, puts into spatial order and proves. CGAL reads a polygon soup,
//   welds, orients, makes a mesh, and in `cgal_with_proof` searches for self-intersections (we also prove winding
//   numbers). admesh looks for what is wrong with edges, assimp only joins vertices.
// - faulty: 100 thousand and 1 million triangles with no defect, 10, 100 or 1000, at places that are spread evenly.
//   CGAL repairs the soup, stitches, orients and closes holes, and says whether the result crosses itself; admesh does
//   what its program does. The counters show what they leave: only ours has to give a valid solid.
// - weld: equal corners alone.
// Compare lines of the same argument. The column CPU is that of all threads of the process.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <benchmark/benchmark.h>

#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "import_files.h"
#include "import_peers.h"

namespace {

using bench::Defect;
using bench::Format;
using bench::PeerMesh;
using bench::TemporaryFile;

constexpr std::uint32_t kCleanSteps = 707;

void import_ours(benchmark::State& state, const TemporaryFile& file) {
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  std::size_t triangles = 0;
  for (auto step : state) {
    const auto imported = algebra3d::import_solid(file.path());
    if (!imported) return state.SkipWithError("failed");
    if (!imported->solid) return state.SkipWithError(imported->status.c_str());
    triangles = imported->solid->mesh().face_count();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

void import_theirs(benchmark::State& state, const TemporaryFile& file, auto import) {
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  PeerMesh made;
  for (auto step : state) {
    made = import(file.path());
    if (!made.failure.empty()) return state.SkipWithError(made.failure.c_str());
  }
  state.counters["triangles"] = static_cast<double>(made.triangles);
  state.counters["closed"] = made.is_closed ? 1 : 0;
  state.counters["crosses_itself"] = made.crosses_itself ? 1 : 0;
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

void clean_ours(benchmark::State& state, Format format) {
  import_ours(state, TemporaryFile(format, kCleanSteps));
}
template <typename Import>
void clean_theirs(benchmark::State& state, Format format, Import import) {
  import_theirs(state, TemporaryFile(format, kCleanSteps), import);
}

/// Arguments: steps, defects.
TemporaryFile faulty_file(const benchmark::State& state, Defect defect) {
  return TemporaryFile(bench::faulty_torus(static_cast<std::uint32_t>(state.range(0)), defect,
                                           static_cast<std::uint32_t>(state.range(1))));
}
void faulty_ours(benchmark::State& state, Defect defect) {
  import_ours(state, faulty_file(state, defect));
}
template <typename Repair>
void faulty_theirs(benchmark::State& state, Repair repair) {
  import_theirs(state, faulty_file(state, Defect::all), repair);
}

void weld_ours(benchmark::State& state) {
  const auto soup = bench::faulty_torus(kCleanSteps, Defect::all, 0);
  for (auto step : state) benchmark::DoNotOptimize(algebra3d::weld(soup.triangles));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

void weld_cgal(benchmark::State& state) {
  const auto soup = bench::faulty_torus(kCleanSteps, Defect::all, 0);
  std::optional<bench::CgalSoup> cgal;  // made and destroyed outside of the time
  for (auto step : state) {
    state.PauseTiming();
    cgal.emplace(soup.triangles);
    state.ResumeTiming();
    benchmark::DoNotOptimize(cgal->merge());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(soup.triangles.size()));
}

PeerMesh cgal_with_proof(const std::filesystem::path& path) {
  return bench::import_with_cgal(path, true);
}
PeerMesh cgal_without_proof(const std::filesystem::path& path) {
  return bench::import_with_cgal(path, false);
}

using Name = std::string;

void set_up(benchmark::internal::Benchmark* benchmark) {
  benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

void register_clean(const Name& format_name, Format format) {
  const Name of_format = "/" + format_name;
  const auto add = [&](const Name& peer, auto import) {
    set_up(benchmark::RegisterBenchmark(
        ("clean" + of_format + "/" + peer).c_str(),
        [format, import](benchmark::State& state) { clean_theirs(state, format, import); }));
  };
  set_up(benchmark::RegisterBenchmark(("clean" + of_format + "/ours").c_str(),
                                      [format](benchmark::State& state) { clean_ours(state, format); }));
  add("cgal_with_proof", cgal_with_proof);
  if (format == Format::stl) add("cgal_without_proof", cgal_without_proof);
#ifdef BENCH_WITH_ADMESH
  if (format == Format::stl || format == Format::ascii_stl) add("admesh", bench::repair_with_admesh);
#endif
#ifdef BENCH_WITH_ASSIMP
  add("assimp", bench::import_with_assimp);
#endif
}

void faulty_arguments(benchmark::internal::Benchmark* benchmark) {
  set_up(benchmark);
  benchmark->ArgNames({"steps", "defects"});
  for (const std::int64_t steps : {158, 500})
    for (const std::int64_t defects : {0, 10, 100, 1000}) benchmark->Args({steps, defects});
}

void register_faulty(const Name& name, Defect defect) {
  faulty_arguments(benchmark::RegisterBenchmark(("faulty/" + name + "/ours").c_str(),
                                                [defect](benchmark::State& state) { faulty_ours(state, defect); }));
}

void register_faulty_peers() {
  const auto add = [](const Name& peer, auto repair) {
    faulty_arguments(benchmark::RegisterBenchmark(("faulty/all/" + peer).c_str(),
                                                  [repair](benchmark::State& state) { faulty_theirs(state, repair); }));
  };
  add("cgal", bench::repair_with_cgal);
#ifdef BENCH_WITH_ADMESH
  add("admesh", bench::repair_with_admesh);
#endif
}

void register_all() {
  register_clean("stl", Format::stl);
  register_clean("ascii_stl", Format::ascii_stl);
  register_clean("obj", Format::obj);
  register_clean("off", Format::off);
  set_up(benchmark::RegisterBenchmark("weld/ours", weld_ours));
  set_up(benchmark::RegisterBenchmark("weld/cgal", weld_cgal));
  register_faulty("all", Defect::all);
  register_faulty_peers();
  register_faulty("hole", Defect::hole);
  register_faulty("flipped", Defect::flipped);
  register_faulty("crack", Defect::crack);
  register_faulty("duplicate", Defect::duplicate);
  register_faulty("body", Defect::body);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
