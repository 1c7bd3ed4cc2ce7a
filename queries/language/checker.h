#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/registry.h"
#include "queries/language/plan_recorder.h"
#include "queries/language/typed_tree.h"

namespace queries {

/// Converts parsed to typed expressions: resolves operators in the registry and objects in the database. The object
/// source, the registry and `context` outlive the typed nodes. Diagnostics of constants go to `context`.
class Checker {
 public:
  /// `recorder`, if given, counts and times the operators when the expression runs; it outlives the nodes.
  Checker(const algebra3d::Registry& registry, ObjectSource& objects, Context& context,
          PlanRecorder* recorder = nullptr)
      : registry_(registry), objects_(objects), context_(context), recorder_(recorder) {}

  /// Checks an expression. Errors: type_error, unknown_name and invalid_value, each with line and column.
  Result<TypedPtr> check(const Expression& expression);
  /// Checks the expression of a query or of an object: an operator's stream of at most one tuple becomes a relation.
  Result<TypedPtr> check_result(const Expression& expression);
  /// The type of a type expression, `typeOf` included. Errors: unknown_name for a type that does not exist.
  Result<TypeExpr> resolve(const TypeSyntax& syntax);

 private:
  struct Parameter {
    std::string name;  ///< empty for the implicit parameters of an operator's function
    TypeExpr type;
  };
  struct Scope {
    std::vector<Parameter> parameters;
    bool is_implicit = false;
  };
  /// A function place of an operator: its pseudo types and the types they stand for.
  struct FunctionPlace {
    const std::vector<std::string>& pseudo_types;
    const std::vector<TypeExpr>& operands;
  };

  Result<TypedPtr> check(const Literal& literal, const SourcePlace& place);
  Result<TypedPtr> check(const TypedLiteral& literal, const SourcePlace& place);
  Result<TypedPtr> check(const HostValue& given, const SourcePlace& place);
  Result<TypedPtr> check(const NameUse& use, const SourcePlace& place);
  Result<TypedPtr> check(const AttributeUse& use, const SourcePlace& place);
  Result<TypedPtr> check(const ParameterUse& use, const SourcePlace& place);
  Result<TypedPtr> check(const Application& application, const SourcePlace& place);
  Result<TypedPtr> check(const FunctionCall& call, const SourcePlace& place);
  Result<TypedPtr> check(const ListExpression& list, const SourcePlace& place);
  Result<TypedPtr> check(const FunctionLiteral& function, const SourcePlace& place);
  Result<TypedPtr> check(const FunctionReference& reference, const SourcePlace& place);

  Result<TypedPtr> application_node(const algebra3d::Operator& op, const Application& application,
                                    const SourcePlace& place, std::vector<TypeExpr>& types);
  Result<TypedPtr> call_of_function(const Application& application, const SourcePlace& place,
                                    std::vector<TypedPtr>& checked);
  Result<TypedPtr> value_application(const algebra3d::Operator& op, const Application& application,
                                     std::vector<TypedPtr> checked, const SourcePlace& place,
                                     std::vector<TypeExpr>& types);
  Result<TypedPtr> stream_application(const algebra3d::Operator& op, const Application& application,
                                      const std::vector<TypedPtr>& checked, const SourcePlace& place,
                                      std::vector<TypeExpr>& shown_types);
  Result<TypedPtr> checked_argument(const Argument& argument, const TypedPtr& checked,
                                    const FunctionPlace& function_place, ArgumentType& type);
  Result<TypedPtr> function_argument(const Expression& expression, const FunctionPlace& place);
  Result<TypedPtr> explicit_function(const FunctionLiteral& function, const FunctionPlace& functions,
                                     const SourcePlace& place);
  Result<TypedPtr> make_checked_function(Scope scope, const Expression& body, const SourcePlace& place);
  Result<TypedPtr> implicit_parameter(int number, const SourcePlace& place, std::string_view shown);
  Result<TypedPtr> constant(const TypeExpr& type, const TypedLiteral& literal, const SourcePlace& place);
  Result<Datum> relation_constant(const TypeExpr& type, const TypedLiteral& literal, const SourcePlace& place);
  Result<TypedPtr> fitted(TypedPtr argument, const TypeExpr& wanted, const std::string& what);
  Status check_type_name(const TypeExpr& type, const SourcePlace& place);
  Status check_place_count(const algebra3d::Operator& op, const Application& application, const SourcePlace& place);
  Result<TypedPtr> find(const std::string& name, const SourcePlace& place);
  algebra3d::Error unknown_name(const std::string& name, const SourcePlace& place);
  std::string name_meant(const std::string& name);
  std::vector<std::string> attributes_in_reach(const std::string& name) const;
  const Scope* implicit_scope() const;

  const algebra3d::Registry& registry_;
  ObjectSource& objects_;
  Context& context_;
  PlanRecorder* recorder_;
  std::vector<Scope> scopes_;  // innermost last
};

/// Index of an attribute in a tuple type. Errors: unknown_name with the most similar name and all names.
Result<std::size_t> attribute_index(const TypeExpr& tuple, const std::string& name);

}  // namespace queries
