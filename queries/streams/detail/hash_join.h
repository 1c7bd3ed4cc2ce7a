#pragma once

#include <memory>
#include <vector>

#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/hash_table.h"
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
  HashJoin(TupleStreamPtr probe, TupleStreamPtr build, std::size_t probe_key, std::size_t build_key,
           const Context& context);
  Result<TuplePtr> next() override;

 private:
  /// A stream partitioned by the hash of a key.
  struct Partition {
    std::vector<std::size_t> key;
    std::vector<std::shared_ptr<TupleFile>> files;
  };

  Status begin();
  Status add_to(Partition& partition, const TuplePtr& tuple) const;
  Status partition_both();
  TupleStreamPtr next_file();

  TupleStreamPtr probe_;
  StreamBlocks build_;
  HashTable table_;
  const Context& context_;
  Partition probe_partition_;
  Partition build_partition_;
  std::size_t file_count_ = 0;  // 0: not partitioned
  std::size_t next_file_ = 0;
  TupleStreamPtr current_;
};

}  // namespace queries
