#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/typed_tree.h"

namespace queries::fuzz {

/// Random numbers that are the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  /// 0 to limit - 1; 0 if limit is 0.
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  template <typename T>
  const T& of(const std::vector<T>& items) {
    return items[below(items.size())];
  }

 private:
  std::mt19937 engine_;
};

/// Makes commands and expressions, most of which are well-formed and many well-typed. Operators are written as their
/// syntax patterns say, with arguments that follow from overloads, operand types and the kinds of places; whether what
/// came out has a type, and which, is asked of the checker. So a new operator or type needs no change here.
class QueryGrammar {
 public:
  QueryGrammar(const algebra3d::Registry& registry, std::map<std::string, TypeExpr> objects);

  std::string command(Dice& dice);
  /// An expression of any type; streams are ended.
  std::string query(Dice& dice);
  /// What a token may be replaced with: operators, types, objects, words of the language, edge cases of numbers.
  std::string word(Dice& dice);
  /// Operators that are written in the same way, the given one included.
  const std::vector<std::string>& written_like(const std::string& op) const;

 private:
  struct Typed {
    std::string text;
    TypeExpr type;
  };
  using Scope = std::vector<Typed>;  // what an expression may refer to: .A, group, parameters
  using Place = algebra3d::SyntaxPattern::Place;

  std::string value(Dice& dice, const TypeExpr& type, const Scope& scope, int depth);
  std::string any_value(Dice& dice, const Scope& scope, int depth);
  std::string literal(Dice& dice, const TypeExpr& type);
  std::string value_call(Dice& dice, const algebra3d::Operator& op, const algebra3d::Overload& overload,
                         const Scope& scope, int depth);
  std::string type(Dice& dice, int depth);
  TypeExpr simple_type(Dice& dice);
  std::string name(Dice& dice);

  /// Operators one after the other, begun with an object or a literal.
  Typed chain(Dice& dice, const Scope& scope, int depth);
  Typed beginning(Dice& dice, const Scope& scope, int depth);
  static Scope plain_names(const Scope& scope);
  /// With one more operator, or nothing if that did not fit.
  std::vector<Typed> applied(Dice& dice, const Typed& operand, const Scope& scope, int depth);
  Typed further_operand(Dice& dice, const Typed& first, const Scope& scope, int depth);
  std::string places(Dice& dice, const algebra3d::SyntaxPattern& pattern, const std::vector<TypeExpr>& operands,
                     const Scope& scope, int depth);
  std::string place(Dice& dice, const Place& place, std::size_t number, const std::vector<TypeExpr>& operands,
                    const Scope& scope, int depth);
  std::string function(Dice& dice, const Place& place, const std::vector<TypeExpr>& operands, const Scope& scope,
                       int depth);
  std::string bracket_value(Dice& dice, const std::vector<TypeExpr>& operands, const Scope& scope, int depth);
  std::string attribute(Dice& dice, const std::vector<TypeExpr>& operands, std::size_t number);

  std::string object_command(Dice& dice);
  std::string other_command(Dice& dice);
  std::string example(Dice& dice);
  std::string nested(const std::string& expression) const;

  /// The type of an expression over the objects and `known`, or an empty name.
  TypeExpr type_of(const std::string& text, const Scope& known) const;

  const algebra3d::Registry& registry_;
  std::map<std::string, TypeExpr> objects_;
  std::vector<std::string> names_;                                         // of the objects
  std::vector<std::string> collections_;                                   // of those that are relations and indexes
  std::map<std::string, std::vector<const algebra3d::Operator*>> giving_;  // value operators by the type of the result
  std::vector<const algebra3d::Operator*> operators_;
  std::vector<const algebra3d::Operator*> postfix_;
  std::map<std::string, std::vector<std::string>> alike_;  // by the form of the pattern
  std::vector<std::string> words_;
  // What fitted before, by the kind of the operand: found while generating.
  std::map<std::string, std::vector<const algebra3d::Operator*>> fitting_;
};

}  // namespace queries::fuzz
