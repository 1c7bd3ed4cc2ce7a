#include "queries/language/plan_views.h"

namespace queries {

std::string scanned_relation(const StreamCallView& scan) {
  const auto object = view_as<ObjectView>(*scan.arguments[0]);
  return object && scan.arguments[0]->type().is_relation() ? object->name : std::string();
}

std::size_t attribute_count(const TypedNode& stream) {
  return stream.type().element().attributes().size();
}

TypedPtr with_operator(const TypedPtr& node, const StreamCallView& call, BoundOperator bound) {
  return with_arguments(node, call, std::move(bound), {call.arguments.begin(), call.arguments.end()});
}

TypedPtr with_arguments(const TypedPtr& node, const StreamCallView& call, BoundOperator bound,
                        std::vector<TypedPtr> arguments) {
  return node->renewed(make_stream_call(call.op, std::move(bound), std::move(arguments), node->place()));
}

}  // namespace queries
