#pragma once

#include <map>
#include <string>

#include "algebra3d/operators/descriptions/all.h"
#include "queries/language/checker.h"
#include "queries/language/parser.h"
#include "queries/streams/all.h"

namespace queries {

/// Every operator there is, so that the tests see the patterns that users see.
inline const algebra3d::Registry& full_registry() {
  static const algebra3d::Registry& registry = *[] {
    auto* made = new algebra3d::Registry(algebra3d::make_registry());
    register_stream_operators(*made);
    return made;
  }();
  return registry;
}

/// The nested-list form of an expression, or `error LINE:COLUMN MESSAGE`.
inline std::string parsed(const std::string& text) {
  auto expression = parse_expression(text, full_registry());
  if (expression) return to_nested(**expression).print();
  const algebra3d::Error& error = expression.error();
  return fmt::format("error {}:{} {}", error.place.line, error.place.column, error.text());
}

/// Objects with types and no values.
class TypesOnly final : public ObjectSource {
 public:
  explicit TypesOnly(std::map<std::string, TypeExpr> types) : types_(std::move(types)) {}
  Result<std::optional<TypeExpr>> type_of(const std::string& name) override {
    const auto found = types_.find(name);
    return found == types_.end() ? std::optional<TypeExpr>() : std::optional(found->second);
  }
  Result<std::optional<TypeExpr>> named_type(const std::string& name) override {
    return name == "parts" ? std::optional(TypeExpr::rel(TypeExpr::tuple({{"A", "int"}}))) : std::nullopt;
  }
  Result<Datum> value_of(const std::string& name) override {
    return algebra3d::Error{algebra3d::ErrorCode::internal, "{} has no value", name};
  }
  std::vector<std::string> names() override {
    std::vector<std::string> names;
    for (const auto& [name, type] : types_) names.push_back(name);
    return names;
  }

 private:
  std::map<std::string, TypeExpr> types_;
};

inline TypesOnly sample_objects() {
  const TypeExpr tuple = TypeExpr::tuple({{"Name", TypeExpr("string")}, {"Solid", TypeExpr("volume3d")}});
  return TypesOnly({{"Parts", TypeExpr::rel(tuple)},
                    {"Limit", TypeExpr("int")},
                    {"twice", TypeExpr::map({TypeExpr("int")}, TypeExpr("int"))},
                    {"area", TypeExpr("int")},
                    {"union", TypeExpr("rect3")},
                    {"length", TypeExpr::map({TypeExpr("int")}, TypeExpr("string"))},
                    {"between", TypeExpr::map({TypeExpr("int"), TypeExpr("int")}, TypeExpr("int"))}});
}

/// The type of an expression over `sample_objects`, or `error LINE:COLUMN MESSAGE`.
inline std::string type_of(const std::string& text) {
  const auto shown = [](const algebra3d::Error& error) {
    return fmt::format("error {}:{} {}", error.place.line, error.place.column, error.text());
  };
  auto expression = parse_expression(text, full_registry());
  if (!expression) return shown(expression.error());
  TypesOnly objects = sample_objects();
  algebra3d::Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  auto node = Checker(full_registry(), objects, context).check(**expression);
  return node ? (*node)->type().text() : shown(node.error());
}

}  // namespace queries
