#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// The syntax of an operator: the parsed form of texts such as
///   `volume(_)`, `makeVector3D(_, _ ...)`, `_ + _`, `_ feed`, `_ _ product`, `_ rotate[_, _, _]`,
///   `_ filter[fun(TUPLE)]`, `_ groupby[attributes; functions(GROUP)]`, `_ hashjoin[attribute, attribute ...]`,
///   `_ rduph[...]` (brackets that may be left out).
/// Each operator has one pattern, shared by its overloads.
struct SyntaxPattern {
  enum class Shape : std::uint8_t {
    prefix,   ///< op(a, b)
    infix,    ///< a op b
    postfix,  ///< a b op, a op[...]
  };

  /// The kind of a place in parentheses or brackets.
  enum class PlaceKind : std::uint8_t {
    value,       ///< `_`: an expression
    attribute,   ///< `attribute`: one attribute name
    attributes,  ///< `attributes`: a list of attribute names, possibly empty
    keys,        ///< `keys`: attribute names, optionally followed by asc or desc
    function,    ///< `fun(P, ...)`: a function whose parameters the expression may leave implicit
    functions,   ///< `functions(P)`: a list of `Name: expression`, each a function of implicit parameters
    renames,     ///< `renames`: a list of `New: Old`
    name,        ///< `name`: a symbol
  };

  struct Place {
    PlaceKind kind = PlaceKind::value;
    std::vector<std::string> parameters;  ///< pseudo types of a function: TUPLE, TUPLE2, GROUP, STREAMELEM
    char before = ',';                    ///< separator before this place: ',' or ';' (of the first place: '[' or '(')
  };

  Shape shape = Shape::prefix;
  std::string name;
  std::size_t operand_count = 0;  ///< operands outside of the brackets: 0 for prefix, 2 for infix
  bool has_brackets = false;      ///< postfix with [...]
  std::vector<Place> places;      ///< within the parentheses or brackets
  bool is_open_ended = false;     ///< `...`: further values may follow, as the overloads say
  std::size_t place_count() const { return operand_count + places.size(); }

  /// Parses a pattern. Errors: internal, with the malformed part.
  static Result<SyntaxPattern> parse(std::string_view text);
};

}  // namespace algebra3d
