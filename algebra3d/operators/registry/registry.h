#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/operator_group.h"
#include "base/context.h"

namespace algebra3d {

namespace detail {
class MadeOverloads;
}

/// An overload that accepts the given types, possibly after conversions (conversion.h).
struct ResolvedCall {
  const Operator* op = nullptr;
  const Overload* overload = nullptr;
};

/// Reports the reason of an undefined result of a call, as "NAME: reason".
void report_undefined(const ResolvedCall& call, const Undefined& undefined, Context& context);

/// All types and operators of a process. Filled once at the start; then concurrent reading is safe. Types and operators
/// keep their addresses. Operators of a group are known by their names alone, and described when one of them is first
/// asked for: to describe all of them takes longer than a short statement.
class Registry {
 public:
  Registry();
  void add(const Type& type);
  /// Sets the family of the operators that are added from here on; of families with one name the first sentence is
  /// kept.
  void begin_family(Family family) { family_ = std::move(family); }
  /// Adds a note on the query language to the description of a registered operator.
  void add_language_note(std::string_view name, std::string note);
  /// Adds an operator. Asserted: its name is new, its syntax is valid, and either all overloads are aggregates or none.
  void add(Operator op);
  /// Adds the operators that `describe` adds to its group. `names` are their names, separated by blanks, which outlive
  /// the registry. Asserted: they are new, and, once they are described, these and no others.
  void add(std::string_view names, Describe describe);

  const Type* find_type(std::string_view name) const;
  /// The object of a type of values: a registered type, or one of nested relations. Null for every other term.
  const Type* value_type(const TypeExpr& term) const;
  const Operator* find_operator(std::string_view name) const;
  /// The parsed syntax of a registered operator.
  const SyntaxPattern& syntax(const Operator& op) const;
  const std::vector<const Type*>& types() const { return types_; }
  /// Sorted by name.
  std::vector<const Operator*> operators() const;
  /// The families, in order of definition.
  const std::vector<Family>& families() const { return families_; }
  /// The operators of a family, sorted by name; for an empty name those added before the first family.
  std::vector<const Operator*> operators_of(std::string_view family) const;

  /// The overload for these argument types: an exact match, else the one with the cheapest conversions (conversion.h).
  /// Errors: type_error "volume: expected (volume3d), got (int)".
  Result<ResolvedCall> resolve(const Operator& op, std::span<const TypeExpr> arguments) const;
  /// The overload of a generic operator (Operator::overload_for) for the type of this term, created on first use; null
  /// if the operator is not generic or the term names no value type.
  const Overload* overload_for(const Operator& op, const TypeExpr& term) const;

  /// Calls a scalar with arguments of the types for which it was resolved: converts, gives undefined for undefined
  /// where the overload does not ask for it, and reports the reason of a new undefined as "NAME: reason". The arguments
  /// are used up. Aggregates run by Aggregation (aggregate.h).
  /// Errors: those of the operator; internal for an exception that it throws. `context` takes the calls that end with
  /// the error internal (failed_calls.h).
  static Result<Value> call(const ResolvedCall& call, std::span<Value> arguments, Context& context);
  /// Calls an operator that yields a table, as `call` does. No rows for undefined arguments that the overload does not
  /// accept.
  static Result<RowSourcePtr> rows(const ResolvedCall& call, std::span<Value> arguments, Context& context);

  /// The operator name most similar to a misspelt one; empty if none is similar.
  std::string suggestion(std::string_view word) const;

 private:
  void note_family();
  /// Null for a name that is not registered.
  const DescribedOperator* find(std::string_view name) const;

  std::vector<const Type*> types_;
  std::vector<std::unique_ptr<OperatorGroup>> groups_;
  std::map<std::string_view, OperatorGroup*> group_of_;
  Family family_;
  std::vector<Family> families_;
  std::shared_ptr<detail::MadeOverloads> made_overloads_;
};

/// A list as text, "A, B or C": at most `limit` items and the number of the others.
std::string enumerate(const std::vector<std::string>& items, std::size_t limit = 8);
/// True for words that are equal but for the case of letters.
bool is_equal_but_for_case(std::string_view a, std::string_view b);
/// The candidate with the smallest edit distance to `word` (a third of its length at most), or empty. Two neighbours
/// that are swapped are one edit, letters that differ only in case half; words that differ in case only always match.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);
/// The types as text: "(volume3d real)".
std::string argument_list_text(std::span<const TypeExpr> types);

}  // namespace algebra3d
