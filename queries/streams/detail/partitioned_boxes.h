#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <random>
#include <unordered_map>
#include <vector>

#include "algebra3d/base/box3.h"
#include "base/work_memory.h"
#include "queries/streams/detail/record_sequences.h"
#include "queries/streams/detail/space_partition.h"
#include "queries/streams/detail/tuple_file.h"
#include "queries/streams/detail/tuple_pair.h"

namespace queries {

/// Pairs of tuples of two sides whose boxes meet, for sides that do not fit into the work memory: both are divided by
/// space, so that of each part the boxes of the first side fit. Tuples go to a file once, and are read again for the
/// pairs alone. Each pair is found in one part: that of the low corner of what both boxes have in common. Order: that
/// of the second side, and for each of its tuples that of the first. Cost: n log n, with each box written twice, and
/// once more for each part that it meets. Source: [patel1996], [dittrich2000].
class PartitionedBoxes {
 public:
  /// Of two sides; or of one side with itself, each pair once, its earlier tuple first. Errors: disk_full, io_error.
  static Result<std::unique_ptr<PartitionedBoxes>> make(bool is_of_one_side, const algebra3d::Context& context);

  /// Adds a tuple of the first side. `box` is not empty.
  Status add_build(const Tuple& tuple, const algebra3d::Box3& box);
  /// Adds a tuple of the second side, with the box that those of the first must meet, not empty. Of one side: for each
  /// tuple, after add_build.
  Status add_probe(const Tuple& tuple, const algebra3d::Box3& window);
  /// Ends adding; finds all pairs. Errors: interrupted, disk_full, io_error.
  Status join();
  /// The next pair; null on both sides at the end.
  Result<TuplePair> next();

 private:
  /// A box with the position of its tuple.
  struct PlacedBox {
    algebra3d::Box3 box;
    std::uint64_t place;
  };
  /// A pair by the positions of its tuples.
  struct PlacedPair {
    std::uint64_t probe, build;
    friend auto operator<=>(const PlacedPair&, const PlacedPair&) = default;
  };
  /// One side: its tuples, and their boxes.
  struct Side {
    std::shared_ptr<TupleFile> tuples;
    RecordSequences<PlacedBox> boxes;
  };
  /// A sequence of pairs that is being merged, with its first pair that was not given.
  struct Run {
    PlacedPair first;
    std::size_t reader;
    friend bool operator>(const Run& a, const Run& b) { return a.first > b.first; }
  };

  PartitionedBoxes(bool is_of_one_side, Side build, Side probe, const algebra3d::Context& context)
      : is_of_one_side_(is_of_one_side), build_(std::move(build)), probe_(std::move(probe)), context_(context) {}
  static Result<Side> make_side(const algebra3d::Context& context);
  void sample(const algebra3d::Box3& box);
  Result<RecordSequences<PlacedBox>> divide(const RecordSequences<PlacedBox>& boxes, const SpacePartition& parts) const;
  Status join_part(const RecordSequences<PlacedBox>& build, const RecordSequences<PlacedBox>& probe,
                   const SpacePartition& parts, std::size_t part);
  Status begin_merge();
  Result<TuplePtr> build_tuple(std::uint64_t place);

  bool is_of_one_side_;
  Side build_, probe_;
  const algebra3d::Context& context_;
  std::vector<algebra3d::Box3> sample_;
  std::uint64_t sampled_from_ = 0;
  std::minstd_rand dice_{1};
  std::optional<RecordSequences<PlacedPair>> pairs_;
  std::vector<RecordSequences<PlacedPair>::Reader> readers_;
  std::priority_queue<Run, std::vector<Run>, std::greater<>> runs_;
  std::shared_ptr<TupleFile::Scan> build_scan_, probe_scan_;
  std::uint64_t probe_place_ = 0;
  TuplePtr probe_tuple_;
  std::unordered_map<std::uint64_t, TuplePtr> kept_;  // tuples of the first side that were read last
  std::size_t kept_bytes_ = 0;
  std::uint32_t steps_ = 0;
};

}  // namespace queries
