#include "queries/language/constant_folding.h"

#include <algorithm>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "base/diagnostics.h"
#include "queries/language/plan_views.h"
#include "queries/streams/batch.h"

namespace queries {
namespace {

bool is_small_constant(const TypedPtr& node) {
  const auto constant = view_as<ConstantView>(*node);
  return constant && constant->value != nullptr && type_in_columns(node->type()) != nullptr;
}

}  // namespace

TypedPtr folded(TypedPtr call, Context& context) {
  const auto view = view_as<ValueCallView>(*call);
  if (!view || type_in_columns(call->type()) == nullptr || !view->call.op->is_pure_in(*view->call.overload) ||
      !std::ranges::all_of(view->arguments, is_small_constant))
    return call;
  algebra3d::Diagnostics notes;
  Context own = context.with(notes);
  auto value = call->evaluate_value(nullptr, own);
  if (!value || !value->is_defined() || !notes.empty()) return call;
  return make_folded(std::move(value).value(), call->place());
}

}  // namespace queries
