#pragma once

#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/command.h"
#include "queries/language/session_parameters.h"
#include "queries/language/syntax_tree.h"

namespace queries {

/// Deepest nesting of brackets in the text of an expression or type; beyond it: error limit_exceeded. At this depth the
/// parser needs about 3 MB of stack in the sanitizer build, a tenth of that in others; the program runs on a larger
/// stack.
inline constexpr int kMaxBracketDepth = 200;
/// Maximum height of an expression tree, to which chained operators contribute; beyond it: error limit_exceeded.
inline constexpr int kMaxExpressionHeight = 400;
/// The error for a tree beyond kMaxExpressionHeight.
algebra3d::Error too_high(const SourcePlace& place);

/// Parses one command (without the `;` that ends it). Operators are recognised by the syntax patterns of `registry`. A
/// text that begins with `(` is a command in nested-list form, `(query (+ 1 2))`. `parameters`: the values of `$name`
/// in a text; null for none. Errors: syntax_error and unknown_name with line and column, what was found and what was
/// expected.
algebra3d::Result<Command> parse_command(std::string_view text, const algebra3d::Registry& registry,
                                         const SourcePlace& start = {"", 1, 1},
                                         const SessionParameters* parameters = nullptr);

/// Parses a text that is one expression.
algebra3d::Result<ExpressionPtr> parse_expression(std::string_view text, const algebra3d::Registry& registry,
                                                  const SourcePlace& start = {"", 1, 1});

/// True for the names of implicit parameters in nested lists: `tuple1` to `tuple9`, `tuple`, `group`. A parameter or an
/// object of such a name would capture `.A` of a text.
bool means_implicit_parameter(std::string_view word);

/// The message for users who write SQL's `select`.
inline constexpr std::string_view kInsteadOfSelect =
    "write query RELATION feed filter[CONDITION] project[ATTRIBUTES] consume";

/// ", did you mean 'inside' or 'withinDistance'?" for an unknown operator, also one of another language or host; empty
/// if no operator is near.
std::string did_you_mean(std::string_view word, const algebra3d::Registry& registry);

/// True for reserved words, which cannot be names. Names of operators are not reserved.
bool is_reserved(std::string_view word);
/// Whether a name from outside of the language can be that of an object or attribute, `what` ("a relation"). Errors:
/// wrong_usage, reserved_name.
algebra3d::Status check_object_name(std::string_view name, std::string_view what);
/// The message for a reserved word in place of an operand.
std::string no_operand_text(std::string_view word);

}  // namespace queries
