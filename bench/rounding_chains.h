#pragma once

#include <cstddef>
#include <cstdint>

namespace bench {

/// Selection of the near-coincident chains that are run.
struct ChainOptions {
  std::uint64_t first = 1;  ///< the number of the first chain; the same number gives the same chain
  std::size_t count = 2000;
  std::size_t shown = 3;           ///< of how many of the slowest steps the statements are printed
  double seconds = 60;             ///< of processor time, after which the rounding of one step is stopped and counted
  bool tells_steps = false;        ///< a line for each step, tab separated, to compare two versions
  bool tells_phases = false;       ///< the processor time of each method tried, for every step above the goal
  std::size_t max_faces = 10'000;  ///< a chain ends before a step with more triangles
};

/// Random chains of up to four steps V := rounded(V operation (V turned or moved by very little)), from spheres,
/// cylinders and boxes with few corners; operation: difference, union, intersection or symmetric difference. Prints the
/// processor time of the roundings per given triangle, and the slowest steps as statements of the language. The goal is
/// 2 ms per triangle (docs/decisions/0015-feature-snapping.md). Returns the number of steps above it.
std::size_t near_coincident_chains(const ChainOptions& options);

}  // namespace bench
