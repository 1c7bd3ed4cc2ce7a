#pragma once

#include <memory>
#include <vector>

#include "queries/language/typed_tree.h"

namespace queries {

/// The tuples of a stream that knows their ids and some of their attributes, with others that are read by the ids [late
/// materialization]: a node above an operator that keeps few tuples of a stored relation.
class LateReadingNode final : public TypedNode {
 public:
  /// `relation`: of the tuples of `tuples`. `read`: attributes.
  LateReadingNode(TypedPtr tuples, TypedPtr relation, std::vector<bool> read);
  Result<Datum> evaluate(const Frame* frame, Context& context) const override;

  /// A node that reads other attributes.
  TypedPtr reading(std::vector<bool> read) const;

 private:
  TypedPtr tuples_;
  TypedPtr relation_;
  std::vector<bool> read_;
};

}  // namespace queries
