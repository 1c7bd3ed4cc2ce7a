#pragma once

#include <string>
#include <utility>

namespace queries {

/// Base of the index objects of the language: the keys of one attribute with the ids of their tuples. An index is
/// either a definition on a stored relation, which the store keeps up to date, or a frozen copy of a stream.
class IndexObject {
 public:
  /// `relation` is the name of the stored relation that the index follows; empty for a frozen copy.
  IndexObject(std::string relation, std::string attribute)
      : relation_(std::move(relation)), attribute_(std::move(attribute)) {}

  const std::string& relation() const { return relation_; }
  const std::string& attribute() const { return attribute_; }
  bool is_definition() const { return !relation_.empty(); }

 private:
  std::string relation_;
  std::string attribute_;
};

}  // namespace queries
