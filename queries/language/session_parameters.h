#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "algebra3d/registry/registry.h"
#include "queries/language/syntax_tree.h"
#include "queries/language/token.h"

namespace queries {

/// What `$name` stands for in the commands of a session: a constant that is given when the program starts. It takes the
/// place of an operand as a value, never as text, so that no quote or bracket in it can mean anything.
struct SessionParameter {
  std::string type;
  NestedList value;
};
using SessionParameters = std::map<std::string, SessionParameter, std::less<>>;

/// Reads `NAME=VALUE` (a number is an int or a real, TRUE and FALSE are bools, anything else is a string, see
/// plain_kind) or `NAME:TYPE=VALUE` (list_of_text). Errors: wrong_usage, with what was found and expected; also for
/// bytes that are no text.
algebra3d::Result<std::pair<std::string, SessionParameter>> parse_session_parameter(
    std::string_view text, const algebra3d::Registry& registry);

/// The constant that the token names. `parameters` may be null. Errors: unknown_name at its place, with what there is.
algebra3d::Result<ExpressionNode> parameter_constant(const SessionParameters* parameters, const Token& token);

/// The content of a parameter that is a string or a text, for places where a command expects a name of a file.
algebra3d::Result<std::string> parameter_text(const SessionParameters* parameters, const Token& token);

}  // namespace queries
