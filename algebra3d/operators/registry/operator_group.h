#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/syntax_pattern.h"

namespace algebra3d {

class OperatorGroup;
class Registry;

/// Describes the operators of a group.
using Describe = void (*)(OperatorGroup&);

struct DescribedOperator {
  Operator op;
  SyntaxPattern syntax;
};

/// Operators of one family that are described together, when one of them is first asked for. Asking is thread-safe.
class OperatorGroup {
 public:
  /// A group of one operator, which is added from outside before it is asked for.
  explicit OperatorGroup(Family family) : family_(std::move(family)) {}
  /// `describe` adds so many operators.
  OperatorGroup(Family family, std::size_t count, Describe describe)
      : family_(std::move(family)), count_(count), describe_(describe) {}

  /// Adds an operator. Asserted: its name is new, its syntax is valid, and either all overloads are aggregates or none.
  void add(Operator op);
  /// Adds a note on the query language to the description of the operator of this name, present or to come.
  void add_language_note(std::string_view name, std::string note);

  /// The registry that describes the group, for functions that call other operators: types are there, operators only
  /// after the description.
  const Registry& registry() const { return *registry_; }
  const Family& family() const { return family_; }

  /// Null for a name of another group. Not to be called while this group is described.
  const DescribedOperator* find(std::string_view name, const Registry& registry);

 private:
  void describe_once(const Registry& registry);

  Family family_;
  std::size_t count_ = 1;
  Describe describe_ = nullptr;
  const Registry* registry_ = nullptr;
  std::once_flag once_;
  std::map<std::string, DescribedOperator, std::less<>> operators_;
  std::map<std::string, std::string, std::less<>> notes_;
};

}  // namespace algebra3d
