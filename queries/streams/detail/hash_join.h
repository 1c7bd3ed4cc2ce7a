#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "queries/streams/detail/hashed_pairs.h"
#include "queries/streams/detail/tuple_file.h"
#include "queries/streams/mapping.h"

namespace queries {

/// A Grace hash join of two streams: pairs of a tuple of the probe side and one of the build side with equal, defined
/// values of two attributes.
///
/// If the build side fits into the work memory, pairs come in the order of the probe side. If not, both sides are
/// partitioned by the hash of the key into temporary files and joined file by file; the order is then unspecified, but
/// the same in every run. Cost: linear in the input and the pairs while each file of the build side fits into memory;
/// larger files are joined in blocks. Source: [kitsuregawa1983].
class HashJoin final : public TupleStream {
 public:
  /// `output` has no predicate.
  HashJoin(TupleStreamPtr probe, TupleStreamPtr build, JoinOutput output, const Context& context);
  Result<TuplePtr> next() override;
  bool has_batches() const override { return true; }
  Result<const Batch*> next_batch(std::size_t most) override;

 private:
  /// A stream partitioned by the hash of a key.
  struct Partition {
    std::vector<std::size_t> key;
    std::vector<std::shared_ptr<TupleFile>> files;
  };

  Status begin();
  Status add_to(Partition& partition, const TuplePtr& tuple) const;
  Status partition_both(JoinTable table, BatchReader& build);
  bool open_next_file();
  void open(TupleStreamPtr pairs);

  TupleStreamPtr probe_;
  TupleStreamPtr build_;
  JoinOutput output_;
  const Context& context_;
  Partition probe_partition_;
  Partition build_partition_;
  std::size_t file_count_ = 0;  // 0: not partitioned
  std::size_t next_file_ = 0;
  TupleStreamPtr current_;
  std::optional<BatchReader> batches_;  // of it
};

}  // namespace queries
