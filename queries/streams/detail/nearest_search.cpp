#include "queries/streams/detail/nearest_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "algebra3d/values/spatial_relations/place_of_box.h"
#include "base/propagate.h"
#include "base/scheduler.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {

namespace {

using algebra3d::Box3;
using algebra3d::Rational;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;
using Cursor = rtree::NearestCursor<std::uint64_t>;

}  // namespace

double distance_bound(const Rational& squared_distance) {
  return std::nextafter(squared_distance.nearest_root(), Box3::kInfinity);
}

bool may_be_within(double distance_of_boxes, double bound) {
  // For the rounding of sums of squares, and of subnormal numbers.
  constexpr double kMargin = 0x1p-40, kSmallest = 0x1p-1070;
  return distance_of_boxes * (1 - kMargin) <= bound + kSmallest;
}

/// The partners that fit into the work memory, with an R-tree over their boxes.
class NearestSearch::Table {
 public:
  Table(std::size_t key, const Context& context) : key_(key), account_(context.memory) {}

  Result<bool> add(const TuplePtr& tuple) {
    const Box3 box = window_of(tuple->attributes[key_]);
    if (!box.is_empty()) {
      if (!account_.take(heap_bytes(*tuple) + sizeof(Partner) + 3 * sizeof(Entry)) && !partners_.empty()) return false;
      entries_.push_back({box, partners_.size()});
      partners_.push_back({tuple, added_count_});
    }
    ++added_count_;
    return true;
  }
  void finish() { tree_ = Tree::bulk_load(std::exchange(entries_, {})); }
  /// Of the next block; places go on.
  void clear() {
    partners_.clear();
    tree_ = Tree();
    account_.clear();
  }
  void start_anew() {
    clear();
    added_count_ = 0;
  }

  struct Partner {
    TuplePtr tuple;
    std::uint64_t place;
  };
  const Partner& partner(std::uint64_t position) const { return partners_[position]; }
  const Value& key(std::uint64_t position) const { return partners_[position].tuple->attributes[key_]; }
  const Tree& tree() const { return tree_; }

 private:
  std::size_t key_;
  algebra3d::MemoryAccount account_;
  std::vector<Partner> partners_;
  std::vector<Entry> entries_;
  Tree tree_;
  std::uint64_t added_count_ = 0;
};

/// The candidates that are examined at the same time.
class NearestSearch::Round {
 public:
  Round(const Table& table, const NearestTask& task, std::span<const NearestProbe> probes)
      : table_(table), task_(task), extra_(std::max<std::size_t>(4, task.limit)) {
    for (std::uint32_t i = 0; i < probes.size(); ++i)
      searches_.push_back({i, table.tree().nearest(window_of(probes[i].tuple->attributes[task.probe_key])), {}, {}});
  }

  bool is_over() const { return searches_.empty(); }

  /// Proposes the next candidates of each probe; probes without any are done.
  void propose(std::span<const NearestProbe> probes, double reach) {
    algebra3d::parallel_for(searches_.size(), 16, [&](std::size_t i) {
      Search& search = searches_[i];
      const NearestProbe& probe = probes[search.probe];
      const std::size_t known = probe.nearest.size();
      // More and more, since the number of near boxes is unknown.
      propose(search, probe, known < task_.limit ? task_.limit - known : extra_, std::min(reach, probe.bound));
    });
    std::erase_if(searches_, [](const Search& search) { return search.candidates.empty(); });
    extra_ = std::min(2 * extra_, kMostExtra);
    pairs_.clear();
    candidates_.clear();
    for (const Search& search : searches_)
      for (const std::uint64_t candidate : search.candidates) {
        pairs_.push_back({&probes[search.probe].tuple->attributes[task_.probe_key], &table_.key(candidate)});
        candidates_.push_back({search.probe, candidate});
      }
  }

  struct Candidate {
    std::uint32_t probe;
    std::uint64_t partner;  ///< position in the table
  };
  const std::vector<ValuePair>& pairs() const { return pairs_; }
  const std::vector<Candidate>& candidates() const { return candidates_; }
  const Table& table() const { return table_; }

 private:
  static constexpr std::size_t kMostExtra = 256;

  struct Search {
    std::uint32_t probe;
    Cursor cursor;
    std::optional<rtree::Neighbor<std::uint64_t>> pending;  // found and too far for now
    std::vector<std::uint64_t> candidates;
  };

  void propose(Search& search, const NearestProbe& probe, std::size_t wanted, double bound) const {
    search.candidates.clear();
    while (search.candidates.size() < wanted) {
      const auto next = search.pending ? std::exchange(search.pending, std::nullopt) : search.cursor.next();
      if (!next) return;
      if (!may_be_within(next->distance, bound)) {
        search.pending = next;
        return;
      }
      if (is_partner(probe.place, table_.partner(next->payload).place)) search.candidates.push_back(next->payload);
    }
  }

  bool is_partner(std::uint64_t probe, std::uint64_t partner) const {
    switch (task_.partners) {
      case Partners::others:
        return partner != probe;
      case Partners::later:
        return partner > probe;
      default:
        return true;
    }
  }

  const Table& table_;
  const NearestTask& task_;
  std::vector<Search> searches_;
  std::size_t extra_;  // candidates of a probe that has enough neighbours
  std::vector<ValuePair> pairs_;
  std::vector<Candidate> candidates_;
};

NearestSearch::NearestSearch(TupleBuffer partners, NearestTask task, const Context& context)
    : partners_(std::move(partners)),
      task_(task),
      context_(context),
      examiner_(context),
      table_(std::make_unique<Table>(task.partner_key, context)) {}

NearestSearch::~NearestSearch() = default;

Status NearestSearch::search(std::span<NearestProbe> probes) {
  probe_count_ += probes.size();
  A3D_TRY(search_all(probes));
  return settle(probes);
}

Status NearestSearch::search_all(std::span<NearestProbe> probes) {
  if (is_whole_) return search_table(probes);
  StreamBlocks blocks(partners_.scan());
  table_->start_anew();
  for (bool is_first = true, is_last = false; !is_last; is_first = false) {
    table_->clear();
    A3D_ASSIGN(is_last, blocks.fill(*table_, context_));
    table_->finish();
    is_whole_ = is_first && is_last;
    A3D_TRY(search_table(probes));
  }
  return {};
}

/// In groups, since a search holds all boxes that are equally far, up to all partners.
Status NearestSearch::search_table(std::span<NearestProbe> probes) {
  constexpr std::size_t kLeastGroup = 128, kBoxesHeld = std::size_t{1} << 22;
  const std::size_t group = std::max(kLeastGroup, kBoxesHeld / (table_->tree().size() + 1));
  for (std::size_t begin = 0; begin < probes.size(); begin += group)
    A3D_TRY(search_group(probes.subspan(begin, std::min(group, probes.size() - begin))));
  return {};
}

Status NearestSearch::search_group(std::span<NearestProbe> probes) {
  Round round(*table_, task_, probes);
  while (true) {
    A3D_TRY(context_.check_cancelled());
    round.propose(probes, reach_);
    if (round.is_over()) return {};
    A3D_TRY(take_distances(probes, round));
  }
}

namespace {

/// If there are `limit` neighbours at the distance 0: drops all that cannot precede the last of them, and ends the
/// search. For candidates come by the distance of their boxes, then by place, so all others at the distance 0 come
/// later.
bool is_settled_by_zeros(NearestProbe& probe, std::size_t limit) {
  constexpr double kNothing = -1;  // no distance is within this bound
  std::vector<std::uint64_t> zeros;
  for (const NearTuple& near : probe.nearest)
    if (near.distance.upper == 0) zeros.push_back(near.place);
  if (zeros.size() < limit) return false;
  const auto last = zeros.begin() + static_cast<std::ptrdiff_t>(limit) - 1;
  std::ranges::nth_element(zeros, last);
  std::erase_if(probe.nearest, [&](const NearTuple& near) { return near.distance.lower > 0 || near.place > *last; });
  probe.bound = kNothing;
  return true;
}

/// Sorts neighbours whose order is known, and keeps the nearest ones.
void keep_nearest(NearestProbe& probe, std::size_t limit) {
  std::ranges::sort(probe.nearest, [](const NearTuple& a, const NearTuple& b) { return a.is_before(b); });
  if (probe.nearest.size() > limit)
    probe.nearest.erase(probe.nearest.begin() + static_cast<std::ptrdiff_t>(limit), probe.nearest.end());
}

/// Keeps the neighbours that may be among the nearest ones, `limit` of them if no distances are equal.
void drop_distant(NearestProbe& probe, std::size_t limit) {
  if (probe.nearest.size() < limit || is_settled_by_zeros(probe, limit)) return;
  std::vector<double> upper;
  for (const NearTuple& near : probe.nearest) upper.push_back(near.distance.upper);
  const auto last = upper.begin() + static_cast<std::ptrdiff_t>(limit) - 1;
  std::ranges::nth_element(upper, last);
  probe.bound = *last;
  std::erase_if(probe.nearest, [&](const NearTuple& near) { return near.distance.lower > probe.bound; });
}

}  // namespace

/// The candidates of a round that the box of the smaller value does not show to be too far away.
Result<std::vector<std::uint32_t>> NearestSearch::near_candidates(std::span<const NearestProbe> probes,
                                                                  const Round& round) {
  std::vector<std::uint8_t> is_far(round.pairs().size());
  const auto question = [&](std::size_t i, const Box3& box, bool, const LoadedSet& other) {
    const double bound = std::min(reach_, probes[round.candidates()[i].probe].bound);
    if (bound == Box3::kInfinity) return;
    const algebra3d::PlaceOfBox place = place_of_box(box, other.set, bound);
    is_far[i] = place.gap > bound && !place.is_inside ? 1 : 0;
  };
  const std::string progress = fmt::format("{} boxes for {} tuples", round.pairs().size(), probe_count_);
  A3D_TRY(examiner_.ask_boxes(round.pairs(), progress, question));
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < is_far.size(); ++i)
    if (is_far[i] == 0) near.push_back(i);
  candidate_count_ += is_far.size();
  far_box_count_ += is_far.size() - near.size();
  return near;
}

/// Bounds the distances of the candidates, and keeps those that may be among the nearest ones.
Status NearestSearch::take_distances(std::span<NearestProbe> probes, const Round& round) {
  A3D_ASSIGN(const std::vector<std::uint32_t> near, near_candidates(probes, round));
  std::vector<ValuePair> pairs;
  pairs.reserve(near.size());
  for (const std::uint32_t i : near) pairs.push_back(round.pairs()[i]);
  std::vector<std::optional<algebra3d::DistanceRange>> ranges(near.size());
  const auto question = [&](std::size_t i, const LoadedSet& a, const LoadedSet& b,
                            const algebra3d::Monitor& monitor) -> Status {
    const double bound = std::min(reach_, probes[round.candidates()[near[i]].probe].bound);
    A3D_ASSIGN(ranges[i], distance_range_of(a.set, b.set, bound, monitor));
    return {};
  };
  const std::string progress = fmt::format("{} pairs for {} tuples", pairs.size(), probe_count_);
  A3D_TRY(examiner_.ask(pairs, progress, question));
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto [probe, position] = round.candidates()[near[i]];
    if (ranges[i]) {
      const Table::Partner& partner = round.table().partner(position);
      const bool is_zero = ranges[i]->upper == 0;
      probes[probe].nearest.push_back(
          {*ranges[i], is_zero ? std::optional<Rational>(0) : std::nullopt, partner.place, partner.tuple});
    }
    // The candidates of a probe follow one another.
    if (i + 1 == ranges.size() || round.candidates()[near[i + 1]].probe != probe)
      drop_distant(probes[probe], task_.limit);
  }
  return thin_out(probes);
}

/// Where many neighbours are equally far, as far as ranges show, decides exactly which are kept, so that they do not
/// pile up.
Status NearestSearch::thin_out(std::span<NearestProbe> probes) {
  const std::size_t most = 4 * task_.limit + 64;
  std::vector<OpenDistance> open;
  for (NearestProbe& probe : probes) {
    if (probe.nearest.size() <= most) continue;
    for (NearTuple& near : probe.nearest)
      if (!near.squared_distance) open.push_back({probe.tuple.get(), &near});
  }
  A3D_TRY(make_exact(open));
  for (NearestProbe& probe : probes) {
    if (probe.nearest.size() <= most) continue;
    keep_nearest(probe, task_.limit);
    probe.bound = std::min(probe.bound, distance_bound(*probe.nearest.back().squared_distance));
  }
  return {};
}

/// Sorts the neighbours, and keeps the nearest ones. Where ranges overlap, the squares of the distances decide.
Status NearestSearch::settle(std::span<NearestProbe> probes) {
  std::vector<OpenDistance> open;
  for (NearestProbe& probe : probes) {
    std::vector<NearTuple>& nearest = probe.nearest;
    std::ranges::sort(nearest, {}, [](const NearTuple& near) { return std::pair(near.distance.lower, near.place); });
    // Groups of overlapping ranges, as far as they begin among the nearest ones.
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < std::min(nearest.size(), task_.limit); begin = end) {
      double upper = nearest[begin].distance.upper;
      for (end = begin + 1; end < nearest.size() && nearest[end].distance.lower <= upper; ++end)
        upper = std::max(upper, nearest[end].distance.upper);
      if (end == begin + 1) continue;
      for (std::size_t i = begin; i < end; ++i)
        if (!nearest[i].squared_distance) open.push_back({probe.tuple.get(), &nearest[i]});
    }
    nearest.erase(nearest.begin() + static_cast<std::ptrdiff_t>(end), nearest.end());
  }
  A3D_TRY(make_exact(open));
  for (NearestProbe& probe : probes) keep_nearest(probe, task_.limit);
  return {};
}

Status NearestSearch::make_exact(std::span<const OpenDistance> open) {
  std::vector<ValuePair> pairs;
  for (const OpenDistance& each : open)
    pairs.push_back({&each.probe->attributes[task_.probe_key], &each.neighbour->tuple->attributes[task_.partner_key]});
  exact_count_ += pairs.size();
  return examiner_.ask(
      pairs, fmt::format("{} exact distances", pairs.size()),
      [&](std::size_t i, const LoadedSet& a, const LoadedSet& b, const algebra3d::Monitor& monitor) -> Status {
        A3D_ASSIGN(open[i].neighbour->squared_distance, squared_distance_of(a.set, b.set, monitor));
        return {};
      });
}

Status NearestSearch::make_first_exact(std::span<NearestProbe> probes) {
  double smallest = Box3::kInfinity;
  for (const NearestProbe& probe : probes)
    if (!probe.nearest.empty()) smallest = std::min(smallest, probe.nearest.front().distance.upper);
  std::vector<OpenDistance> open;
  for (NearestProbe& probe : probes) {
    if (probe.nearest.empty()) continue;
    NearTuple& first = probe.nearest.front();
    if (!first.squared_distance && first.distance.lower <= smallest) open.push_back({probe.tuple.get(), &first});
  }
  return make_exact(open);
}

std::vector<StageCount> NearestSearch::stages() const {
  return {{"tuples searched for", probe_count_},
          {"candidates by boxes", candidate_count_},
          {"too far by one hierarchy", far_box_count_},
          {"exact distances", exact_count_},
          {"geometries loaded", examiner_.load_count()}};
}

}  // namespace queries
