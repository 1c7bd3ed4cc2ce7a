#include "queries/streams/detail/hash_join.h"

#include <algorithm>
#include <bit>

#include "base/propagate.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/hash_table.h"

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

HashJoin::HashJoin(TupleStreamPtr probe, TupleStreamPtr build, JoinOutput output, const Context& context)
    : probe_(std::move(probe)),
      build_(std::move(build)),
      output_(std::move(output)),
      context_(context),
      probe_partition_{{output_.keys.left}, {}},
      build_partition_{{output_.keys.right}, {}} {}

Result<TuplePtr> HashJoin::next() {
  if (current_ == nullptr) A3D_TRY(begin());
  while (true) {
    A3D_ASSIGN(TuplePtr pair, current_->next());
    if (pair != nullptr || !open_next_file()) return pair;
  }
}

Result<const Batch*> HashJoin::next_batch(std::size_t most) {
  if (current_ == nullptr) A3D_TRY(begin());
  while (true) {
    A3D_ASSIGN(const Batch* const pairs, batches_->next(most));
    if (pairs != nullptr || !open_next_file()) return pairs;
  }
}

Status HashJoin::begin() {
  JoinTable table(output_.keys.right, context_);
  BatchReader build(*build_);
  while (true) {
    A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(const Batch* const batch, build.next(kBatchTuples));
    if (batch == nullptr) break;
    A3D_ASSIGN(const bool has_room, table.add(*batch));
    if (has_room) continue;
    A3D_TRY(partition_both(std::move(table), build));
    open_next_file();
    return {};
  }
  table.finish();
  open(hashed_pairs(probe_, std::move(table), output_, context_));
  return {};
}

void HashJoin::open(TupleStreamPtr pairs) {
  current_ = std::move(pairs);
  batches_.emplace(*current_);
}

Status HashJoin::partition_both(JoinTable table, BatchReader& build) {
  file_count_ = number_of_files(context_);
  for (Partition* const partition : {&build_partition_, &probe_partition_})
    for (std::size_t i = 0; i < file_count_; ++i) {
      A3D_ASSIGN(auto file, TupleFile::make(context_));
      partition->files.push_back(std::move(file));
    }
  for (std::uint32_t place = 0; place < table.size(); ++place) A3D_TRY(add_to(build_partition_, table.tuple(place)));
  table.clear();
  while (true) {
    A3D_TRY(context_.check_cancelled());
    A3D_ASSIGN(const Batch* const batch, build.next(kBatchTuples));
    if (batch == nullptr) break;
    for (std::size_t i = 0; i < batch->rows.count; ++i)
      A3D_TRY(add_to(build_partition_, tuple_of(*batch, batch->rows[i])));
  }
  return for_each_tuple(*probe_, context_, [this](const TuplePtr& tuple) { return add_to(probe_partition_, tuple); });
}

// By bits of the hash that tables do not use for their buckets.
Status HashJoin::add_to(Partition& partition, const TuplePtr& tuple) const {
  constexpr unsigned kUnusedBits = 40;
  A3D_ASSIGN(const Value key, tuple->attributes[partition.key.front()].loaded());
  if (!key.is_defined()) return {};
  return partition.files[hash(key) >> kUnusedBits & (file_count_ - 1)]->append(*tuple);
}

bool HashJoin::open_next_file() {
  if (next_file_ == file_count_) return false;
  const auto build = std::move(build_partition_.files[next_file_]);
  const auto probe = std::move(probe_partition_.files[next_file_]);
  ++next_file_;
  open(block_join(build->scan(0, build->end()), probe->scan(0, probe->end()),
                  HashTable(build_partition_.key.front(), probe_partition_.key.front(), context_), pair_of, context_));
  return true;
}

}  // namespace queries
