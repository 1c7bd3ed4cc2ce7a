#pragma once

#include <memory>
#include <string>
#include <utility>

namespace queries {

/// Base of the index objects of the language: the keys of one attribute with the ids of their tuples, in a `TreeType`.
/// An index is either a definition on a stored relation, whose tree the store keeps up to date, or a frozen copy of a
/// stream.
template <typename TreeType>
class IndexObject {
 public:
  using Tree = TreeType;

  /// `relation` is the name of the stored relation that the index follows; empty for a frozen copy.
  IndexObject(std::string relation, std::string attribute, std::shared_ptr<Tree> tree)
      : relation_(std::move(relation)), attribute_(std::move(attribute)), tree_(std::move(tree)) {}

  const std::string& relation() const { return relation_; }
  const std::string& attribute() const { return attribute_; }
  bool is_definition() const { return !relation_.empty(); }
  const Tree& tree() const { return *tree_; }
  Tree& tree() { return *tree_; }

 private:
  std::string relation_;
  std::string attribute_;
  std::shared_ptr<Tree> tree_;
};

}  // namespace queries
