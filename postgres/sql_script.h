#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What a script of CREATE statements makes, such as algebra3d--1.0.sql: functions, aggregates, operators, casts.
namespace algebra3d_postgres {

struct SqlParameter {
  std::string name;  ///< may be empty
  std::string type;
};

struct CreatedFunction {
  std::string name;
  std::vector<SqlParameter> parameters;
  std::string result;  ///< as the script has it: "float8", "SETOF bigint", "TABLE (...)"; empty for an aggregate
  bool is_aggregate = false;
  bool is_strict = false;
  bool is_volatile = false;
  bool is_internal = false;  ///< has a parameter or result that statements of users cannot have

  std::string signature() const {
    std::string text = name + "(";
    for (const SqlParameter& parameter : parameters) text += (text.back() == '(' ? "" : ", ") + parameter.type;
    return text + ")";
  }
};

struct CreatedOperator {
  std::string symbol, left, right, function;
};

struct CreatedCast {
  std::string from, to, context;  ///< context: "explicit", "in assignments" or "implicit"
};

struct SqlScript {
  std::vector<CreatedFunction> functions;
  std::vector<CreatedOperator> operators;
  std::vector<CreatedCast> casts;
  std::vector<std::pair<std::string, std::string>> comments;  ///< of functions: signature and text
};

inline std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return std::string(text);
}

/// The statements of a script without their semicolons, comments and lines of psql. Semicolons in quotes, and between
/// BEGIN ATOMIC and END, end none.
inline std::vector<std::string> statements_of(std::string_view script) {
  std::vector<std::string> statements;
  std::string current;
  char quote = 0;  // ' or ", or $ in a text between dollars
  bool begins_line = true;
  for (std::size_t i = 0; i < script.size(); ++i) {
    const char c = script[i];
    const bool is_remark = quote == 0 && (script.substr(i, 2) == "--" || (begins_line && c == '\\'));
    if (is_remark) {
      i = script.find('\n', i);
      if (i == std::string_view::npos) break;
      continue;
    }
    begins_line = c == '\n';
    if (script.substr(i, 2) == "$$" && (quote == 0 || quote == '$')) {
      quote = quote == 0 ? '$' : '\0';
      current += script[i++];
    } else if ((c == '\'' || c == '"') && (quote == 0 || quote == c)) {
      quote = quote == 0 ? c : '\0';
    }
    const bool is_in_body = current.find(" BEGIN ATOMIC ") != std::string::npos && !current.ends_with(" END");
    if (c == ';' && quote == 0 && !is_in_body) {
      statements.push_back(trimmed(current));
      current.clear();
    } else {
      current += c;
    }
  }
  return statements;
}

/// The length of a text in parentheses, which are its first and last character.
inline std::size_t length_in_parentheses(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i + 1;
  }
  return text.size();
}

/// The parts between commas that are in no parentheses.
inline std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  std::string current;
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ',' && depth == 0) {
      parts.push_back(trimmed(current));
      current.clear();
    } else {
      current += c;
    }
  }
  if (!trimmed(current).empty()) parts.push_back(trimmed(current));
  return parts;
}

inline SqlParameter parameter_of(std::string text) {
  for (const std::string_view word : {" DEFAULT ", " = "})
    if (const auto place = text.find(word); place != std::string::npos) text.resize(place);
  const auto space = text.find(' ');
  if (space == std::string::npos || text.starts_with("double ")) return {"", text};
  std::string name = text.substr(0, space);
  if (name.front() == '"') name = name.substr(1, name.size() - 2);
  return {name, trimmed(text.substr(space))};
}

/// "name(parameters) ..." behind CREATE FUNCTION or CREATE AGGREGATE; `rest` receives what follows.
inline CreatedFunction head_of(std::string_view text, std::string& rest) {
  CreatedFunction made;
  const std::size_t open = text.find('(');
  made.name = trimmed(text.substr(0, open));
  const std::size_t length = length_in_parentheses(text.substr(open));
  for (const std::string& part : parts_of(text.substr(open + 1, length - 2)))
    made.parameters.push_back(parameter_of(part));
  rest = trimmed(text.substr(open + length));
  return made;
}

inline bool is_internal_type(std::string_view type) {
  return type == "internal" || type == "cstring";
}

inline CreatedFunction function_of(std::string_view text) {
  std::string rest;
  CreatedFunction made = head_of(text, rest);
  if (rest.starts_with("RETURNS ")) {
    rest = rest.substr(8);
    const bool is_table = rest.starts_with("TABLE");
    const std::size_t open = is_table ? rest.find('(') : 0;
    const std::size_t end = is_table ? open + length_in_parentheses(std::string_view(rest).substr(open))
                                     : std::min(rest.find(" AS "), rest.find(" LANGUAGE "));
    made.result = trimmed(rest.substr(0, end));
    rest = rest.substr(std::min(end, rest.size()));
  }
  made.is_strict = rest.find(" STRICT") != std::string::npos;
  made.is_volatile = rest.find(" VOLATILE") != std::string::npos;
  made.is_internal = is_internal_type(made.result);
  for (const SqlParameter& parameter : made.parameters) made.is_internal |= is_internal_type(parameter.type);
  return made;
}

/// The word behind "KEY = " in the options of a CREATE OPERATOR.
inline std::string option_of(std::string_view options, std::string_view key) {
  for (const std::string& part : parts_of(options))
    if (part.starts_with(key) && part.find('=') != std::string::npos) return trimmed(part.substr(part.find('=') + 1));
  return "";
}

inline CreatedOperator operator_of(std::string_view text) {
  const std::size_t open = text.find('(');
  const std::string_view options = text.substr(open + 1, text.rfind(')') - open - 1);
  std::string function = option_of(options, "FUNCTION");
  if (function.empty()) function = option_of(options, "PROCEDURE");
  return {trimmed(text.substr(0, open)), option_of(options, "LEFTARG"), option_of(options, "RIGHTARG"), function};
}

inline CreatedCast cast_of(std::string_view text) {
  const std::size_t open = text.find('('), as = text.find(" AS "), close = text.find(')');
  const std::string_view rest = text.substr(close);
  const char* context = "explicit";
  if (rest.find("AS ASSIGNMENT") != std::string_view::npos) context = "in assignments";
  if (rest.find("AS IMPLICIT") != std::string_view::npos) context = "implicit";
  return {trimmed(text.substr(open + 1, as - open - 1)), trimmed(text.substr(as + 4, close - as - 4)), context};
}

/// A text in single quotes, without them.
inline std::string unquoted(std::string_view text) {
  std::string result;
  const std::size_t begin = text.find('\'') + 1, end = text.rfind('\'');
  for (std::size_t i = begin; i < end; ++i) {
    result += text[i];
    if (text[i] == '\'') ++i;  // written twice
  }
  return result;
}

inline SqlScript read_script(std::string_view text) {
  SqlScript script;
  for (const std::string& statement : statements_of(text)) {
    const auto behind = [&](std::string_view beginning) {
      return statement.starts_with(beginning) ? std::string_view(statement).substr(beginning.size())
                                              : std::string_view();
    };
    std::string_view rest;
    std::string options;
    if (!(rest = behind("CREATE FUNCTION ")).empty() || !(rest = behind("CREATE OR REPLACE FUNCTION ")).empty()) {
      script.functions.push_back(function_of(rest));
    } else if (!(rest = behind("CREATE AGGREGATE ")).empty()) {
      script.functions.push_back(head_of(rest, options));
      script.functions.back().is_aggregate = true;
    } else if (!(rest = behind("CREATE OPERATOR ")).empty()) {
      if (!rest.starts_with("CLASS ") && !rest.starts_with("FAMILY ")) script.operators.push_back(operator_of(rest));
    } else if (!(rest = behind("CREATE CAST ")).empty()) {
      script.casts.push_back(cast_of(rest));
    } else if (!(rest = behind("COMMENT ON FUNCTION ")).empty() || !(rest = behind("COMMENT ON AGGREGATE ")).empty()) {
      const std::size_t is = rest.find(" IS ");
      script.comments.emplace_back(std::string(rest.substr(0, is)), unquoted(rest.substr(is)));
    }
  }
  return script;
}

}  // namespace algebra3d_postgres
