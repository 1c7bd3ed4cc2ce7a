#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/language/token.h"

namespace queries {

/// A constant given as text. Each command that uses it converts it to a value of its type, and so reports why it is
/// undefined, if it is.
struct WrittenConstant {
  std::string type;
  NestedList list;
};
/// The value of `$name` in the commands of a session. It is an operand, never text of the command, so quotes and
/// brackets in it have no meaning. Values are loaded.
using SessionParameter = std::variant<WrittenConstant, HostValue>;

struct SessionParameters {
  std::map<std::string, SessionParameter, std::less<>> values = {};
  /// Advice for messages about a missing parameter; `{}` is its name.
  std::string_view advice = "start the program with -p {}=VALUE";
};

/// Parses `NAME=VALUE` (a number is an int or a real, TRUE and FALSE are bools, all else is a string, see plain_kind)
/// or `NAME:TYPE=VALUE` (list_of_text). Errors: wrong_usage, with what was found and expected; also for invalid UTF-8
/// and for a number without a type that is out of range.
algebra3d::Result<std::pair<std::string, SessionParameter>> parse_session_parameter(
    std::string_view text, const algebra3d::Registry& registry);

/// The value of type `type_name` that a text writes (list_of_text). Errors: wrong_usage if there is no such type; those
/// of the text.
algebra3d::Result<SessionParameter> session_parameter(std::string_view type_name, std::string_view value,
                                                      const algebra3d::Registry& registry);

/// The constant that the token names. `parameters` may be null. Errors: unknown_name at its position, with the known
/// names.
algebra3d::Result<ExpressionNode> parameter_constant(const SessionParameters* parameters, const Token& token);

/// The content of a parameter that is a string or a text, where a command expects a file name.
algebra3d::Result<std::string> parameter_text(const SessionParameters* parameters, const Token& token);

}  // namespace queries
