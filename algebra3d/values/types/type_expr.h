#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/types/nested_list.h"

namespace algebra3d {

/// A type of the language as a term: `volume3d`, `(stream real)`, `(rel (tuple ((Name string) (Vol volume3d))))`, `(map
/// int bool)`. Immutable, cheap to copy, compared by structure. The names need not exist.
class TypeExpr {
 public:
  struct Attribute;

  TypeExpr() : TypeExpr("") {}
  TypeExpr(std::string_view name, std::vector<TypeExpr> arguments = {});  // NOLINT(google-explicit-constructor)
  TypeExpr(const char* name) : TypeExpr(std::string_view(name)) {}        // NOLINT(google-explicit-constructor)
  static TypeExpr tuple(std::vector<Attribute> attributes);
  static TypeExpr stream(TypeExpr element) { return {"stream", {std::move(element)}}; }
  static TypeExpr rel(TypeExpr tuple) { return {"rel", {std::move(tuple)}}; }
  static TypeExpr map(std::vector<TypeExpr> parameters, TypeExpr result);

  const std::string& name() const { return content_->name; }
  const std::vector<TypeExpr>& arguments() const { return content_->arguments; }
  const std::vector<Attribute>& attributes() const { return content_->attributes; }

  bool is(std::string_view name) const { return content_->name == name; }
  bool is_tuple() const { return is("tuple"); }
  /// `arel(tuple(...))`: a relation that is the value of an attribute.
  bool is_nested_relation() const { return is("arel") && arguments().size() == 1 && arguments()[0].is_tuple(); }
  bool is_relation() const { return is("rel") && arguments().size() == 1 && arguments()[0].is_tuple(); }
  bool is_stream() const { return is("stream") && arguments().size() == 1; }
  bool is_tuple_stream() const { return is_stream() && arguments()[0].is_tuple(); }
  bool is_function() const { return is("map"); }
  /// The element type of a stream, relation or nested relation.
  const TypeExpr& element() const { return arguments().front(); }
  /// The result type of a function: the last argument of the term.
  const TypeExpr& function_result() const { return arguments().back(); }
  std::vector<TypeExpr> function_parameters() const;

  NestedList to_nested() const;
  /// Reads a type. Errors: invalid_value with the part that is not a type.
  static Result<TypeExpr> from_nested(const NestedList& list);
  /// The nested-list form, as in messages and results.
  std::string text() const { return to_nested().print(); }

  friend bool operator==(const TypeExpr& a, const TypeExpr& b);

 private:
  struct Content {
    std::string name;
    std::vector<TypeExpr> arguments;
    std::vector<Attribute> attributes;  // of a tuple
  };
  std::shared_ptr<const Content> content_;
};

struct TypeExpr::Attribute {
  std::string name;
  TypeExpr type;
  friend bool operator==(const Attribute&, const Attribute&) = default;
};

}  // namespace algebra3d
