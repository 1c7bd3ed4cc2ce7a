#include "queries/streams/detail/hash_join.h"

#include <algorithm>
#include <bit>

#include "base/propagate.h"

namespace queries {
namespace {

/// Pairs as the join gives them: (probe, build).
TuplePtr pair_of(const Tuple& build, const Tuple& probe) {
  return concatenated(probe, build);
}

/// Number of files for each side: their buffers take an eighth of the memory at most.
std::size_t number_of_files(const Context& context) {
  constexpr std::size_t kLeast = 4, kMost = 64;
  const std::size_t limit = context.memory != nullptr ? context.memory->limit() : 0;
  return std::bit_floor(std::clamp(limit / 16 / TupleFile::kBufferBytes, kLeast, kMost));
}

}  // namespace

HashJoin::HashJoin(TupleStreamPtr probe, TupleStreamPtr build, std::size_t probe_key, std::size_t build_key,
                   const Context& context)
    : probe_(std::move(probe)),
      build_(std::move(build)),
      table_(build_key, probe_key, context),
      context_(context),
      probe_partition_{{probe_key}, {}},
      build_partition_{{build_key}, {}} {}

Result<TuplePtr> HashJoin::next() {
  if (current_ == nullptr) A3D_TRY(begin());
  while (true) {
    A3D_ASSIGN(TuplePtr pair, current_->next());
    if (pair != nullptr || next_file_ == file_count_) return pair;
    current_ = next_file();
  }
}

Status HashJoin::begin() {
  A3D_ASSIGN(const bool fits, build_.fill(table_, context_));
  if (fits) {
    current_ = block_join(std::move(table_), probe_, pair_of, context_);
    return {};
  }
  A3D_TRY(partition_both());
  current_ = next_file();
  return {};
}

Status HashJoin::partition_both() {
  file_count_ = number_of_files(context_);
  for (Partition* const partition : {&build_partition_, &probe_partition_})
    for (std::size_t i = 0; i < file_count_; ++i) {
      A3D_ASSIGN(auto file, TupleFile::make(context_));
      partition->files.push_back(std::move(file));
    }
  for (const TuplePtr& tuple : table_.tuples()) A3D_TRY(add_to(build_partition_, tuple));
  table_.clear();
  const auto add_build = [this](const TuplePtr& tuple) { return add_to(build_partition_, tuple); };
  A3D_TRY(for_each_tuple(build_, context_, add_build));
  return for_each_tuple(*probe_, context_, [this](const TuplePtr& tuple) { return add_to(probe_partition_, tuple); });
}

// By bits of the hash that tables do not use for their buckets.
Status HashJoin::add_to(Partition& partition, const TuplePtr& tuple) const {
  constexpr unsigned kUnusedBits = 40;
  A3D_ASSIGN(const Value key, tuple->attributes[partition.key.front()].loaded());
  if (!key.is_defined()) return {};
  return partition.files[hash(key) >> kUnusedBits & (file_count_ - 1)]->append(*tuple);
}

TupleStreamPtr HashJoin::next_file() {
  const auto build = std::move(build_partition_.files[next_file_]);
  const auto probe = std::move(probe_partition_.files[next_file_]);
  ++next_file_;
  return block_join(build->scan(0, build->end()), probe->scan(0, probe->end()),
                    HashTable(build_partition_.key.front(), probe_partition_.key.front(), context_), pair_of, context_);
}

}  // namespace queries
