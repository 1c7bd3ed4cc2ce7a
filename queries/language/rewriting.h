#pragma once

#include <vector>

#include "queries/language/typed_tree.h"

namespace queries {

// Rewrites of plans. The plan of a query is its typed tree: what a stream operator does is its role
// (queries/streams/stream_operator.h), and its inputs are its arguments. A rewrite puts an input in the place of
// another one that gives fewer tuples or the same ones sooner, so that the operator gives the same tuples in the same
// order. Conditions are still asked of each tuple that comes. The notes are some of those of the plain plan: what a
// condition would note, or fail at, for tuples that do not come is not known.

struct RewriteContext {
  const algebra3d::Registry& registry;
  ObjectSource& objects;
  Context& context;
  bool is_explained = false;    ///< describe in detail how relations are read
  bool is_in_function = false;  ///< values of parameters are not known yet
};

/// Rewrites the plan of an operator whose inputs have been rewritten:
/// - conditions of a filter are asked below operators that hand their attributes on,
/// - a filter on a relation reads by an index that a condition allows,
/// - `sortby` or `sort` before `head` keeps as many tuples as are wanted,
/// - `product` before `filter`, and `symmjoin`, with a condition that attributes are equal, find pairs by a hash table.
Status rewrite(const algebra3d::Operator& op, BoundOperator& bound, std::vector<TypedPtr>& arguments,
               const RewriteContext& rewriting);

}  // namespace queries
