#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "queries/language/typed_tree.h"

namespace queries {

// Views of the nodes of a plan, and replacements of nodes, for rewrites.

template <typename View>
std::optional<View> view_as(const TypedNode& node) {
  NodeView view = node.view();
  auto* found = std::get_if<View>(&view);
  return found == nullptr ? std::nullopt : std::optional<View>(*found);
}

/// The call of an operator with this role; nothing if the node is something else.
template <typename Role>
std::optional<StreamCallView> call_with(const TypedNode& node) {
  auto call = view_as<StreamCallView>(node);
  return call && std::holds_alternative<Role>(call->bound.role) ? call : std::nullopt;
}

/// The name of the stored relation that a call scans; empty if it scans another one.
std::string scanned_relation(const StreamCallView& scan);

/// The number of attributes of the tuples of a stream.
std::size_t attribute_count(const TypedNode& stream);

/// Puts another operator on the same arguments in the place of a call.
TypedPtr with_operator(const TypedPtr& node, const StreamCallView& call, BoundOperator bound);

/// Puts a call with other arguments in the place of a call.
TypedPtr with_arguments(const TypedPtr& node, const StreamCallView& call, BoundOperator bound,
                        std::vector<TypedPtr> arguments);

}  // namespace queries
