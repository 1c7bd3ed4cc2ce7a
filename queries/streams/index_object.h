#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "algebra3d/base/error.h"

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

/// The error for a tuple that the index of an attribute has, and whose row is not in the file, or has another value.
algebra3d::Error index_disagrees(std::string_view relation, std::string_view attribute, std::int64_t tuple,
                                 bool has_row);

}  // namespace queries
