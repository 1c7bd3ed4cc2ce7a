#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/values/spatial_relations/relation.h"
#include "base/work_memory.h"
#include "queries/streams/datum.h"
#include "queries/streams/mapping.h"

namespace queries {

/// A loaded spatial value, and its geometry.
struct LoadedSet {
  Value value;
  algebra3d::SpatialSet set;  ///< refers to `value`
};

/// Two defined spatial values that are not empty, perhaps deferred. The caller keeps them; equal addresses are one
/// value.
struct ValuePair {
  const Value* first;
  const Value* second;
};

/// Questions about pairs of spatial values, asked in parallel.
///
/// Pairs are asked along a space-filling curve. The geometry of each value is loaded once for all pairs of a call; if
/// it exceeds the work memory, there are several batches, and values that the next one also needs stay loaded.
/// Interruptible; reports its progress.
class SpatialPairs {
 public:
  explicit SpatialPairs(const Context& context) : context_(context), account_(context.memory) {}

  /// Asked once for each pair, from several threads at once, in any order.
  using Question = std::function<Status(std::size_t pair, const LoadedSet& a, const LoadedSet& b,
                                        const algebra3d::Monitor& monitor)>;
  /// Errors: those of loading; that of the first pair on the curve whose question fails; interrupted.
  Status ask(std::span<const ValuePair> pairs, const std::string& progress, const Question& question);

  /// Asked about a pair of which one value is deferred and much smaller than the other: of its box, and the other one.
  using BoxQuestion =
      std::function<void(std::size_t pair, const algebra3d::Box3& box, bool is_box_of_first, const LoadedSet& other)>;
  /// Asks about each such pair once, likewise, so that only the larger values are loaded. Errors: as `ask`.
  Status ask_boxes(std::span<const ValuePair> pairs, const std::string& progress, const BoxQuestion& question);

  /// Number of values that were loaded so far, some of them several times.
  std::uint64_t load_count() const { return load_count_; }

 private:
  struct Batches;

  Status load(Batches& all, std::span<const std::uint32_t> pairs);
  Status ask_batch(const Batches& all, std::span<const std::uint32_t> pairs, const std::string& progress,
                   const Question& question) const;

  const Context& context_;
  algebra3d::MemoryAccount account_;
  std::uint64_t load_count_ = 0;
};

/// Positions of boxes, which are not empty, in Morton order of their centres; equal ones in their order.
std::vector<std::uint32_t> morton_order(std::span<const algebra3d::Box3> boxes);

}  // namespace queries
