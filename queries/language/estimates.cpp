#include "queries/language/estimates.h"

#include <algorithm>
#include <cmath>

#include "algebra3d/values/types/nested_relation.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/language/column_pruning.h"
#include "queries/language/index_feed.h"
#include "queries/language/plan_views.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"

namespace queries {
namespace {

using Estimate = std::optional<std::uint64_t>;

class Estimator {
 public:
  Estimator(ObjectSource& objects, Context& context, bool is_in_function)
      : objects_(objects), context_(context), is_in_function_(is_in_function) {}

  Estimate of(const TypedNode& node) const {
    if (const auto* index = dynamic_cast<const IndexFeedNode*>(node.unmeasured().get())) return index->estimate();
    const auto call = view_as<StreamCallView>(node);
    return call ? std::visit([&](const auto& role) { return of_role(*call, role); }, call->bound.role) : Estimate();
  }

 private:
  Estimate of_role(const StreamCallView& call, const ScansRelation& /*role*/) const {
    const RelationPtr relation = scanned(call);
    if (relation == nullptr) return std::nullopt;
    const auto count = relation->count();
    return count ? Estimate(static_cast<std::uint64_t>(*count)) : std::nullopt;
  }
  Estimate of_role(const StreamCallView& call, const MakesTuples& /*role*/) const { return of(*call.arguments[0]); }
  Estimate of_role(const StreamCallView& call, const SortsTuples& role) const {
    const Estimate input = of(*call.arguments[0]);
    return input && role.most ? std::min<std::uint64_t>(*input, *role.most) : input;
  }
  Estimate of_role(const StreamCallView& call, const TakesFirst& /*role*/) const {
    const Estimate input = of(*call.arguments[0]);
    const auto count = view_as<ConstantView>(*call.arguments[1]);
    if (!input || !count || count->value == nullptr) return std::nullopt;
    return std::min(*input, static_cast<std::uint64_t>(std::max<std::int64_t>(0, count->value->get<std::int64_t>())));
  }
  // Where an index has found the tuples, the condition is asked of these alone.
  Estimate of_role(const StreamCallView& call, const SelectsElements& /*role*/) const {
    const TypedNode& from = *call.arguments[0];
    const Estimate input = of(from);
    const auto* const index = dynamic_cast<const IndexFeedNode*>(from.unmeasured().get());
    if (index != nullptr && index->scanned() == nullptr) return input;
    const auto scan = call_with<ScansRelation>(from);
    const RelationPtr relation = index != nullptr ? stored(*index->scanned()) : scan ? scanned(*scan) : nullptr;
    if (!input || relation == nullptr || is_in_function_) return std::nullopt;
    const auto part = part_of_sample(*relation, *call.arguments[1], *input);
    if (!part) return std::nullopt;
    return static_cast<std::uint64_t>(std::llround(*part * static_cast<double>(*input)));
  }
  Estimate of_role(const StreamCallView& call, const PairsTuples& role) const {
    const Estimate left = of(*call.arguments[0]);
    const Estimate right = of(*call.arguments[1]);
    return left && right && !role.keys && !role.has_predicate ? Estimate(*left * *right) : std::nullopt;
  }
  template <typename Other>
  Estimate of_role(const StreamCallView& /*call*/, const Other& /*role*/) const {
    return std::nullopt;
  }

  /// The stored relation that a call scans; null if it scans another one.
  RelationPtr scanned(const StreamCallView& scan) const {
    return scanned_relation(scan).empty() ? nullptr : stored(*scan.arguments[0]);
  }

  /// The relation that is an object; null if it cannot be read.
  RelationPtr stored(const TypedNode& relation) const {
    const auto object = objects_.value_of(view_as<ObjectView>(relation)->name);
    return object ? object->relation() : nullptr;
  }

  /// The part of a relation that a condition selects, of a sample; nothing if the condition fails, or reads large
  /// values.
  std::optional<double> part_of_sample(Relation& relation, const TypedNode& condition, std::uint64_t count) const {
    constexpr std::uint64_t kSample = 100;
    const auto& attributes = relation.tuple_type().attributes();
    const std::vector<bool> read = attributes_read(condition, attributes.size());
    for (std::size_t attribute = 0; attribute < attributes.size(); ++attribute)
      if (read[attribute] && undefined_of(attributes[attribute].type).type().is_large()) return std::nullopt;
    algebra3d::Diagnostics unheard;
    Context own = context_.with(unheard);
    if (own.unchanging.empty()) own.unchanging = "a plan is estimated";
    const auto function = condition.evaluate(nullptr, own);
    if (!function) return std::nullopt;
    std::uint64_t asked = 0, selected = 0;
    for (std::uint64_t i = 0; i < std::min(count, kSample); ++i) {
      const auto tuple = relation.fetch(static_cast<TupleId>(1 + i * count / std::min(count, kSample)));
      if (!tuple || *tuple == nullptr) continue;
      const Datum argument{*tuple};
      const auto holds = function->function().call_for_value({&argument, 1});
      if (!holds) return std::nullopt;
      ++asked;
      selected += is_true(*holds) ? 1 : 0;
    }
    if (asked == 0) return count == 0 ? std::optional(0.0) : std::nullopt;
    return static_cast<double>(selected) / static_cast<double>(asked);
  }

  ObjectSource& objects_;
  Context& context_;
  bool is_in_function_;
};

}  // namespace

std::optional<std::uint64_t> estimated_tuples(const TypedNode& node, ObjectSource& objects, Context& context,
                                              bool is_in_function) {
  if (!node.type().is_tuple_stream()) return std::nullopt;
  return Estimator(objects, context, is_in_function).of(node);
}

TypedPtr with_estimate(const TypedPtr& node, const RewriteContext& rewriting) {
  if (!rewriting.is_explained) return node;
  return node->replaced_by(node->unmeasured(),
                           estimated_tuples(*node, rewriting.objects, rewriting.context, rewriting.is_in_function));
}

}  // namespace queries
