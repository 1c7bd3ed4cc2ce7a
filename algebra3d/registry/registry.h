#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "algebra3d/base/context.h"
#include "algebra3d/base/error.h"
#include "algebra3d/registry/operator.h"

namespace algebra3d {

/// An overload that accepts the given types, if need be after a conversion (conversion.h).
struct ResolvedCall {
  const Operator* op = nullptr;
  const Overload* overload = nullptr;
};

/// All types and operators of a process: filled once at start by calls such as `register_measure(registry)`, then only
/// read, by any number of threads. Types and operators keep their addresses.
class Registry {
 public:
  void add(const Type& type);
  /// The operators that are added from here on belong to this family, such as "joins".
  void begin_family(std::string family) { family_ = std::move(family); }
  /// A name is added once and its syntax parses (asserted: the registry is our own text).
  void add(Operator op);

  const Type* find_type(std::string_view name) const;
  const Operator* find_operator(std::string_view name) const;
  /// The parsed syntax of a registered operator.
  const SyntaxPattern& syntax(const Operator& op) const;
  const std::vector<const Type*>& types() const { return types_; }
  /// Sorted by name.
  std::vector<const Operator*> operators() const;
  /// The families in the order in which they were begun; an operator of an empty family belongs to none.
  std::vector<std::string> families() const;

  /// The overload for these argument types: one that fits exactly, or else the one that fits with the cheapest
  /// conversions (conversion.h). Errors: type_error "volume: expected (volume3d), got (int)".
  Result<ResolvedCall> resolve(const Operator& op, std::span<const TypeExpr> arguments) const;

  /// Calls an overload with arguments of the types for which it was resolved: converts, gives undefined for undefined
  /// where the overload does not ask for it, and reports the reason of a new undefined as "NAME: reason".
  static Result<std::variant<Value, std::vector<Value>>> call(const ResolvedCall& call,
                                                              std::span<const Value> arguments, Context& context);
  /// The same for an overload that gives no stream; the arguments are used up.
  static Result<Value> call_for_value(const ResolvedCall& call, std::span<Value> arguments, Context& context);

  /// The known operator name nearest to a misspelt one, or empty if none is near.
  std::string suggestion(std::string_view word) const;

 private:
  struct Entry {
    Operator op;
    SyntaxPattern syntax;
  };
  std::vector<const Type*> types_;
  std::map<std::string, Entry, std::less<>> operators_;
  std::string family_;
  std::vector<std::string> families_;  // that have an operator
};

/// "A, B or C", at most `limit` items and then how many more there are.
std::string enumerate(const std::vector<std::string>& items, std::size_t limit = 8);
/// True for words that differ in nothing but the case of letters, or not at all.
bool is_equal_but_for_case(std::string_view a, std::string_view b);
/// The candidate with the smallest edit distance to `word` (a third of its length at most), or empty. Two neighbours
/// that are swapped are one edit, letters that differ only in case half; what differs in nothing else is always near.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);
/// "(volume3d real)"
std::string argument_list_text(std::span<const TypeExpr> types);

}  // namespace algebra3d
