#include "queries/streams/hash_join.h"

#include <algorithm>
#include <bit>

namespace queries {
namespace {

/// Pairs as the join gives them: (passing, held).
TuplePtr pair_of(const Tuple& held, const Tuple& passing) {
  return concatenated(passing, held);
}

/// How many files each stream is divided into: their buffers take an eighth of the memory at most.
std::size_t number_of_files(const Context& context) {
  constexpr std::size_t kLeast = 4, kMost = 64;
  const std::size_t limit = context.memory != nullptr ? context.memory->limit() : 0;
  return std::bit_floor(std::clamp(limit / 16 / TupleFile::kBufferBytes, kLeast, kMost));
}

}  // namespace

HashJoin::HashJoin(TupleStreamPtr passing, TupleStreamPtr held, std::size_t passing_key, std::size_t held_key,
                   const Context& context)
    : passing_(std::move(passing)),
      held_(std::move(held)),
      table_(held_key, passing_key, context),
      context_(context),
      passing_division_{{passing_key}, {}},
      held_division_{{held_key}, {}} {}

Result<TuplePtr> HashJoin::next() {
  if (current_ == nullptr) RETURN_IF_ERROR(begin());
  while (true) {
    ASSIGN_OR_RETURN(TuplePtr pair, current_->next());
    if (pair != nullptr || next_file_ == file_count_) return pair;
    current_ = next_file();
  }
}

Status HashJoin::begin() {
  ASSIGN_OR_RETURN(const bool fits, held_.fill(table_, context_));
  if (fits) {
    current_ = partwise_join(std::move(table_), passing_, pair_of, context_);
    return {};
  }
  RETURN_IF_ERROR(divide_both());
  current_ = next_file();
  return {};
}

Status HashJoin::divide_both() {
  file_count_ = number_of_files(context_);
  for (Division* const division : {&held_division_, &passing_division_})
    for (std::size_t i = 0; i < file_count_; ++i) {
      ASSIGN_OR_RETURN(auto file, TupleFile::make(context_));
      division->files.push_back(std::move(file));
    }
  for (const TuplePtr& tuple : table_.tuples()) RETURN_IF_ERROR(divide(held_division_, tuple));
  table_.clear();
  const auto divide_held = [this](const TuplePtr& tuple) { return divide(held_division_, tuple); };
  RETURN_IF_ERROR(for_each_tuple(held_, context_, divide_held));
  return for_each_tuple(*passing_, context_,
                        [this](const TuplePtr& tuple) { return divide(passing_division_, tuple); });
}

// By bits of the hash that tables do not use for their buckets.
Status HashJoin::divide(Division& division, const TuplePtr& tuple) const {
  constexpr unsigned kUnusedBits = 40;
  ASSIGN_OR_RETURN(const Value key, tuple->attributes[division.key.front()].loaded());
  if (!key.is_defined()) return {};
  return division.files[hash(key) >> kUnusedBits & (file_count_ - 1)]->append(*tuple);
}

TupleStreamPtr HashJoin::next_file() {
  const auto held = std::move(held_division_.files[next_file_]);
  const auto passing = std::move(passing_division_.files[next_file_]);
  ++next_file_;
  return partwise_join(held->scan(0, held->end()), passing->scan(0, passing->end()),
                       HashTable(held_division_.key.front(), passing_division_.key.front(), context_), pair_of,
                       context_);
}

}  // namespace queries
