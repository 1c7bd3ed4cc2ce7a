#include "algebra3d/operators/registry/detail/host_name.h"

#include <algorithm>
#include <array>

namespace algebra3d {
namespace {

bool is_upper(char c) {
  return 'A' <= c && c <= 'Z';
}
bool is_lower(char c) {
  return 'a' <= c && c <= 'z';
}

// What PostgreSQL reserves or does not allow as the name of a function, and the keywords of Python.
constexpr auto kReserved = std::to_array<std::string_view>({"all",
                                                            "analyse",
                                                            "analyze",
                                                            "and",
                                                            "any",
                                                            "array",
                                                            "as",
                                                            "asc",
                                                            "assert",
                                                            "async",
                                                            "asymmetric",
                                                            "await",
                                                            "between",
                                                            "binary",
                                                            "both",
                                                            "break",
                                                            "case",
                                                            "cast",
                                                            "check",
                                                            "class",
                                                            "collate",
                                                            "column",
                                                            "constraint",
                                                            "continue",
                                                            "create",
                                                            "cross",
                                                            "current_date",
                                                            "current_time",
                                                            "current_timestamp",
                                                            "current_user",
                                                            "def",
                                                            "default",
                                                            "deferrable",
                                                            "del",
                                                            "desc",
                                                            "distinct",
                                                            "do",
                                                            "elif",
                                                            "else",
                                                            "end",
                                                            "except",
                                                            "exists",
                                                            "extract",
                                                            "false",
                                                            "fetch",
                                                            "finally",
                                                            "for",
                                                            "foreign",
                                                            "freeze",
                                                            "from",
                                                            "full",
                                                            "global",
                                                            "grant",
                                                            "group",
                                                            "having",
                                                            "if",
                                                            "ilike",
                                                            "import",
                                                            "in",
                                                            "initially",
                                                            "inner",
                                                            "intersect",
                                                            "interval",
                                                            "into",
                                                            "is",
                                                            "isnull",
                                                            "join",
                                                            "lambda",
                                                            "lateral",
                                                            "leading",
                                                            "left",
                                                            "like",
                                                            "limit",
                                                            "localtime",
                                                            "localtimestamp",
                                                            "natural",
                                                            "nonlocal",
                                                            "not",
                                                            "notnull",
                                                            "null",
                                                            "offset",
                                                            "on",
                                                            "only",
                                                            "or",
                                                            "order",
                                                            "outer",
                                                            "overlaps",
                                                            "overlay",
                                                            "pass",
                                                            "placing",
                                                            "position",
                                                            "primary",
                                                            "raise",
                                                            "references",
                                                            "return",
                                                            "returning",
                                                            "right",
                                                            "row",
                                                            "select",
                                                            "session_user",
                                                            "similar",
                                                            "some",
                                                            "substring",
                                                            "symmetric",
                                                            "table",
                                                            "tablesample",
                                                            "then",
                                                            "to",
                                                            "trailing",
                                                            "trim",
                                                            "true",
                                                            "try",
                                                            "union",
                                                            "unique",
                                                            "user",
                                                            "using",
                                                            "values",
                                                            "variadic",
                                                            "verbose",
                                                            "when",
                                                            "where",
                                                            "while",
                                                            "window",
                                                            "with",
                                                            "yield"});

}  // namespace

std::string snake_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const char before = i > 0 ? name[i - 1] : '_';
    const char after = i + 1 < name.size() ? name[i + 1] : '_';
    if (c == '2' && is_lower(before) && is_lower(after)) {
      result += "_to_";
      continue;
    }
    if (is_upper(c) && (is_lower(before) || (is_upper(before) && is_lower(after)))) result += '_';
    result += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

bool is_reserved_in_a_host(std::string_view name) {
  return std::ranges::find(kReserved, name) != kReserved.end();
}

}  // namespace algebra3d
