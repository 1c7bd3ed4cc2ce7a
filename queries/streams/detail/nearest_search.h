#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/exact/rational.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/spatial_pairs.h"
#include "queries/streams/mapping.h"
#include "queries/streams/spatial_index.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A tuple near another one. `place` is its number in its stream, by which equal distances are ordered.
struct NearTuple {
  algebra3d::DistanceRange distance;
  std::optional<algebra3d::Rational> squared_distance;  ///< where the range does not decide the order
  std::uint64_t place = 0;
  TuplePtr tuple;

  /// For tuples whose squared distances are known, or whose ranges are apart.
  bool is_before(const NearTuple& other) const {
    if (!squared_distance || !other.squared_distance) return distance.upper < other.distance.lower;
    const auto order = *squared_distance <=> *other.squared_distance;
    return order != 0 ? order < 0 : place < other.place;
  }
};

/// A tuple whose neighbours are searched. Its value is defined and not empty.
struct NearestProbe {
  TuplePtr tuple;
  std::uint64_t place = 0;
  std::vector<NearTuple> nearest = {};        ///< the result, the nearest one first
  double bound = algebra3d::Box3::kInfinity;  ///< sets farther away are not among them
};

/// The tuples that may be neighbours of a probe.
enum class Partners : std::uint8_t {
  all,
  others,  ///< of the probe's own stream: all but itself
  later,   ///< of the probe's own stream: those after it
};

/// A smallest double that is not less than a distance, given its square.
double distance_bound(const algebra3d::Rational& squared_distance);
/// True if sets whose boxes have a rounded distance may be at most `bound` apart.
bool may_be_within(double distance_of_boxes, double bound);

/// What a NearestSearch looks for.
struct NearestTask {
  std::size_t probe_key, partner_key;  ///< attribute indices
  std::size_t limit;                   ///< largest number of neighbours; positive
  Partners partners = Partners::all;
};

/// The search for the nearest partners of many tuples by the exact distance of their geometry. Boxes of partners are in
/// an R-tree: candidates come by the distance of their boxes, several for each probe at a time, until the next box is
/// farther away than the last neighbour. Their distances are bounded in parallel by SpatialPairs, in rounded
/// arithmetic; where these bounds leave the order of neighbours open, squares of distances are compared exactly. If the
/// partners exceed the work memory, there are several trees, one after the other, for each call. Interruptible. Source:
/// [hjaltason1999] for the order of candidates.
class NearestSearch {
 public:
  NearestSearch(TupleBuffer partners, NearestTask task, const Context& context);
  NearestSearch(const NearestSearch&) = delete;
  NearestSearch& operator=(const NearestSearch&) = delete;
  ~NearestSearch();

  /// Fills `nearest` of the probes. Errors: those of reading and loading, interrupted.
  Status search(std::span<NearestProbe> probes);
  /// Computes the squared distance of the first neighbour of each probe that may have the nearest one of all.
  Status make_first_exact(std::span<NearestProbe> probes);
  /// From now on, neighbours that are farther away are not wanted.
  void set_reach(double reach) { reach_ = reach; }

  std::vector<StageCount> stages() const;

 private:
  class Table;
  class Round;

  Status search_all(std::span<NearestProbe> probes);
  Status search_table(std::span<NearestProbe> probes);
  Status search_group(std::span<NearestProbe> probes);
  Result<std::vector<std::uint32_t>> near_candidates(std::span<const NearestProbe> probes, const Round& round);
  Status take_distances(std::span<NearestProbe> probes, const Round& round);
  Status thin_out(std::span<NearestProbe> probes);
  Status settle(std::span<NearestProbe> probes);
  /// A neighbour whose squared distance is needed.
  struct OpenDistance {
    const Tuple* probe;
    NearTuple* neighbour;
  };
  Status make_exact(std::span<const OpenDistance> open);

  TupleBuffer partners_;
  NearestTask task_;
  const Context& context_;
  SpatialPairs examiner_;
  std::unique_ptr<Table> table_;
  bool is_whole_ = false;  // the table has all partners
  double reach_ = algebra3d::Box3::kInfinity;
  std::uint64_t probe_count_ = 0;
  std::uint64_t candidate_count_ = 0;
  std::uint64_t far_box_count_ = 0;  // of these candidates
  std::uint64_t exact_count_ = 0;
};

}  // namespace queries
