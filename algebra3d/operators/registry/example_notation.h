#pragma once

#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/nested_list.h"

namespace algebra3d {

/// A parsed argument or view of an example. Written as nested lists:
///
///     5  -1.5  TRUE  "a"  'b'            values of the types int, real, bool, string, text
///     (point3d (1 2 3))  (int undefined) a value of a type, by its value list
///     (point3d)                          of an aggregate alone: no value, but of that type
///     (makePoint3D 1 2 3)                what a scalar operator gives for such arguments
///     _                                  in a view: the call that is shown
///     (count _)                          in a view: the number of rows of that call
struct ExampleTerm {
  enum class Kind : std::uint8_t { value, no_value, call, shown_call, row_count };

  Kind kind = Kind::value;
  const Type* type = nullptr;          ///< of a value, or of the values that an aggregate has none of
  NestedList value;                    ///< the value list
  bool is_plain_atom = false;          ///< of a value: written without its type
  const Operator* op = nullptr;        ///< of a call
  std::vector<ExampleTerm> arguments;  ///< of a call, or the call whose rows are counted

  /// Parses a term. Errors: internal, with the malformed part.
  static Result<ExampleTerm> parse(std::string_view text, const Registry& registry);
};

}  // namespace algebra3d
