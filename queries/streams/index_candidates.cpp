#include "queries/streams/index_candidates.h"

#include <algorithm>
#include <utility>

#include "algebra3d/kernel/search/boxes.h"
#include "base/propagate.h"
#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/mapping.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Candidates = std::optional<IndexCandidates>;

bool is_spatial_use(IndexUse use) {
  return use == IndexUse::meets || use == IndexUse::is_inside || use == IndexUse::contains || use == IndexUse::is_near;
}

/// The window of the boxes of an index; empty if no tuple fulfils the condition.
Box3 window_for(const IndexQuestion& question) {
  const Box3 box = window_of(question.operand);
  if (question.use != IndexUse::is_near || box.is_empty()) return box;
  const Value& limit = *question.limit;
  const double by = limit.type().name() == "int" ? static_cast<double>(limit.get<std::int64_t>()) : limit.get<double>();
  return by < 0 ? Box3() : algebra3d::padded(box, by);
}

Result<Candidates> spatial_candidates(const IndexQuestion& question, const SpatialIndex& index,
                                      std::uint64_t tuple_count) {
  // Empty values are not in the index, and are inside of everything; so is an empty operand.
  A3D_ASSIGN(const std::size_t entry_count, index.size());
  if (question.use == IndexUse::is_inside && entry_count != tuple_count) return Candidates();
  if (question.use == IndexUse::contains && window_of(question.operand).is_empty()) return Candidates();
  const Box3 window = window_for(question);
  A3D_ASSIGN(const auto found, ids_in_window(index, window));
  return Candidates({std::vector<TupleId>(found.begin(), found.end()), index.attribute(), window});
}

/// An operand as a key of the index; nothing if it cannot be one.
Result<std::optional<Value>> as_key(const Value& operand, const TypeExpr& key) {
  const auto conversion = conversion_to(key, operand.type().term());
  if (!conversion) return std::optional<Value>();
  A3D_ASSIGN(Value value, loaded_as(operand, *conversion));
  return std::optional(std::move(value));
}

Result<Candidates> ordered_candidates(const IndexQuestion& question, const TypeExpr& key, const OrderedIndex& index) {
  A3D_ASSIGN(const std::optional<Value> operand, as_key(question.operand, key));
  if (!operand) return Candidates();
  std::optional<Value> low = operand, high = operand;
  if (question.use == IndexUse::between) {
    A3D_ASSIGN(high, as_key(*question.limit, key));
    if (!high) return Candidates();
  }
  if (question.use == IndexUse::at_least) high.reset();
  if (question.use == IndexUse::at_most) low.reset();
  A3D_ASSIGN(std::vector<TupleId> ids, index.entries().range(low, high));
  std::ranges::sort(ids);
  return Candidates({std::move(ids), index.attribute(), std::nullopt});
}

}  // namespace

bool can_serve(const TypeExpr& index, IndexUse use, const TypeExpr& operand, const TypeExpr& limit,
               const algebra3d::Registry& registry) {
  if (is_spatial_use(use))
    return index.is("rtree3") && is_spatial(registry, operand) &&
           (use != IndexUse::is_near || limit.is("real") || limit.is("int"));
  if (!index.is("btree") || index.arguments().size() != 2) return false;
  const TypeExpr& key = index.arguments()[1];
  const bool is_number = key.is("int") || key.is("real");
  if (!is_number && !(key.is("string") && use == IndexUse::equals)) return false;
  return operand == key || (key.is("real") && operand.is("int"));
}

bool fits(const IndexCandidates& candidates, const Value& value) {
  return !candidates.window || window_of(value).intersects(*candidates.window);
}

Result<std::optional<IndexCandidates>> index_candidates(const Datum& index, const TypeExpr& index_type,
                                                        const IndexQuestion& question, std::uint64_t tuple_count) {
  // Then no tuple fulfils the condition, but the reason is reported where it is evaluated.
  if (!question.operand.is_defined() || (question.limit && !question.limit->is_defined())) return Candidates();
  if (is_spatial_use(question.use)) return spatial_candidates(question, *index.index(), tuple_count);
  return ordered_candidates(question, index_type.arguments()[1], *index.ordered_index());
}

}  // namespace queries
