#include "queries/language/rewriting.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/propagate.h"
#include "queries/language/column_pruning.h"
#include "queries/language/estimates.h"
#include "queries/language/filter_placement.h"
#include "queries/language/hash_rewrites.h"
#include "queries/language/index_rewrites.h"
#include "queries/language/plan_views.h"
#include "queries/language/row_group_rewrites.h"

namespace queries {
namespace {

// `sortby[...] head[n]`
void keep_first(const BoundOperator& bound, std::vector<TypedPtr>& arguments, const RewriteContext& rewriting) {
  // To keep more tuples, and to sort them several times, costs as much as the sort.
  constexpr std::int64_t kMost = std::int64_t{1} << 16U;
  if (!std::holds_alternative<TakesFirst>(bound.role)) return;
  const auto sort = call_with<SortsTuples>(*arguments[0]);
  const auto count = view_as<ConstantView>(*arguments[1]);
  if (!sort || !count || count->value == nullptr || count->value->type().name() != "int") return;
  const auto wanted = count->value->get<std::int64_t>();
  if (wanted < 0 || wanted > kMost) return;
  const auto& role = std::get<SortsTuples>(sort->bound.role);
  arguments[0] =
      with_estimate(with_operator(arguments[0], *sort, role.of_first(static_cast<std::size_t>(wanted))), rewriting);
}

// `R feed count`: the relation knows the number.
void count_without_reading(BoundOperator& bound, std::vector<TypedPtr>& arguments) {
  if (!std::holds_alternative<CountsElements>(bound.role)) return;
  TypedPtr input = arguments[0];
  while (const auto call = call_with<MakesTuples>(*input)) {
    if (call->arguments.size() > 1 && std::ranges::any_of(call->arguments, [](const TypedPtr& each) {
          const auto list = view_as<ListView>(*each);
          return list && !list->elements.empty();
        }))
      return;
    input = call->arguments[0];
  }
  const auto scan = call_with<ScansRelation>(*input);
  if (!scan) return;
  arguments[0] = scan->arguments[0];
  bound.how = "the number that the relation keeps";
}

}  // namespace

Status rewrite(const algebra3d::Operator& op, BoundOperator& bound, std::vector<TypedPtr>& arguments,
               const RewriteContext& rewriting) {
  A3D_TRY(move_conditions_down(op, bound, arguments, rewriting));
  A3D_TRY(read_by_index(bound, arguments, rewriting));
  leave_out_groups(bound, arguments);
  keep_first(bound, arguments, rewriting);
  pair_by_hash(bound, arguments);
  group_by_hash(bound, arguments);
  count_without_reading(bound, arguments);
  take_own_tuples(bound, arguments);
  read_needed_attributes(bound, arguments);
  return {};
}

}  // namespace queries
