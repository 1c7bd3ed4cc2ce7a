#pragma once

#include <string>
#include <string_view>

#include "algebra3d/registry/registry.h"
#include "queries/language/command.h"
#include "queries/language/session_parameters.h"
#include "queries/language/syntax_tree.h"

namespace queries {

/// Deepest nesting of brackets in the text of an expression or type; beyond it: error limit_exceeded. With it the
/// parser needs some 3 MB of stack in the sanitizer build, and a tenth of that otherwise. The program has a stack of
/// its own for this.
inline constexpr int kMaxBracketDepth = 200;
/// Highest expression tree, to which operators in a row contribute, in a text and in a nested list alike; beyond it:
/// error limit_exceeded.
inline constexpr int kMaxExpressionHeight = 400;
/// The error that tells of a tree beyond kMaxExpressionHeight.
algebra3d::Error too_high(const SourcePlace& place);

/// Reads one command (without the `;` that ends it). Operators are recognised by the syntax patterns of `registry`.
/// A text that begins with `(` is a command as a nested list, `(query (+ 1 2))`.
/// Errors: syntax_error and unknown_name with line and column, what was found and what is possible.
/// `parameters`: what `$name` stands for in a text; null for none.
algebra3d::Result<Command> parse_command(std::string_view text, const algebra3d::Registry& registry,
                                         const SourcePlace& start = {"", 1, 1},
                                         const SessionParameters* parameters = nullptr);

/// Reads one expression that is all of `text`.
algebra3d::Result<ExpressionPtr> parse_expression(std::string_view text, const algebra3d::Registry& registry,
                                                  const SourcePlace& start = {"", 1, 1});

/// True for the words that stand for implicit parameters in nested lists: `tuple1` to `tuple9`, `tuple`, `group`. A
/// parameter or an object of that name would capture what is written `.A` in a text.
bool means_implicit_parameter(std::string_view word);

/// What is written in place of SQL's `select`.
inline constexpr std::string_view kInsteadOfSelect =
    "write query RELATION feed filter[CONDITION] project[ATTRIBUTES] consume";

/// True for the words of the language, which cannot name anything. Names of operators are not among them.
bool is_reserved(std::string_view word);
/// The message where a reserved word stands for an operand.
std::string no_operand_text(std::string_view word);

}  // namespace queries
