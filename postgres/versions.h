#pragma once

#include <cctype>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sql_script.h"

/// Versions of the extension: what a script declares, and the script that makes one version of another one.
///
/// A version is released when there is a list of its members, algebra3d--VERSION.members. What a released version
/// declares stays as it is in all later ones, but for comments, costs and the functions by which predicates use an
/// index.
namespace algebra3d_postgres {

/// The object that a statement of a script declares.
struct Declared {
  std::string kind;      ///< "function", "operator class", ... ; "" of an unknown statement
  std::string identity;  ///< among those of its kind
  std::string statement;
};

/// With single blanks between words.
inline std::string one_line(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!is_blank) result += c;
    if (is_blank && !result.empty() && result.back() != ' ') result += ' ';
  }
  return trimmed(result);
}

inline Declared declared_by(const std::string& statement) {
  const std::string text = one_line(statement);
  const auto behind = [&](std::string_view beginning) {
    return text.starts_with(beginning) ? text.substr(beginning.size()) : std::string();
  };
  const auto before = [](const std::string& whole, std::string_view word) { return whole.substr(0, whole.find(word)); };
  std::string rest, options;
  if (!(rest = behind("CREATE FUNCTION ")).empty()) return {"function", function_of(rest).signature(), statement};
  if (!(rest = behind("CREATE AGGREGATE ")).empty())
    return {"aggregate", head_of(rest, options).signature(), statement};
  if (!(rest = behind("CREATE TYPE ")).empty())
    return {rest.find('(') == std::string::npos ? "type without functions" : "type", before(rest, " ("), statement};
  if (!(rest = behind("CREATE OPERATOR CLASS ")).empty()) {
    const std::string method = rest.substr(rest.find(" USING ") + 1);
    return {"operator class", before(rest, " ") + " " + before(method, " AS "), statement};
  }
  if (!(rest = behind("CREATE OPERATOR ")).empty()) {
    const CreatedOperator made = operator_of(rest);
    return {"operator", made.symbol + " (" + made.left + ", " + made.right + ")", statement};
  }
  if (!(rest = behind("CREATE CAST ")).empty()) return {"cast", rest.substr(0, rest.find(')') + 1), statement};
  if (!(rest = behind("COMMENT ON ")).empty()) return {"comment", before(rest, " IS '"), statement};
  if (!(rest = behind("ALTER TYPE ")).empty()) return {"setting of a type", before(rest, " ("), statement};
  if (!(rest = behind("ALTER FUNCTION ")).empty() && rest.find(" SUPPORT ") != std::string::npos)
    return {"support", before(rest, " SUPPORT "), statement};
  if (text.starts_with("GRANT ") || text.starts_with("REVOKE ")) return {"right", text, statement};
  return {"", text, statement};
}

inline std::vector<Declared> declared_in(std::string_view script) {
  std::vector<Declared> all;
  for (const std::string& statement : statements_of(script)) all.push_back(declared_by(statement));
  return all;
}

/// Clauses that later versions may declare in another way.
inline bool may_change(const Declared& declared) {
  return declared.kind == "comment" || declared.kind == "support";
}

struct Costed {
  std::string statement;  ///< without the cost
  std::string cost;
};

inline Costed costed(const std::string& statement) {
  const std::size_t at = statement.find(" COST "), begin = at + 6;
  if (at == std::string::npos) return {statement, "1"};
  std::size_t end = begin;
  while (end < statement.size() && std::isdigit(static_cast<unsigned char>(statement[end])) != 0) ++end;
  return {statement.substr(0, at) + statement.substr(end), statement.substr(begin, end - begin)};
}

/// A checksum of what stays the same: FNV-1a of 64 bits.
inline std::string checksum(std::string_view text) {
  std::uint64_t sum = 14695981039346656037U;
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211U;
  std::string digits(16, '0');
  std::snprintf(digits.data(), digits.size() + 1, "%016llx", static_cast<unsigned long long>(sum));
  return digits;
}

/// The C functions that a script names.
inline std::set<std::string> symbols_of(const std::vector<Declared>& script) {
  std::set<std::string> symbols;
  for (const Declared& declared : script) {
    const std::string_view mark = " AS 'MODULE_PATHNAME', '";
    const std::string text = one_line(declared.statement);
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + mark.size();
    symbols.insert(text.substr(begin, text.find('\'', begin) - begin));
  }
  return symbols;
}

/// The list of members of a released version: its script with a checksum, each member with kind, identity and checksum,
/// and the C functions.
inline std::string members_of(std::string_view name, std::string_view script) {
  const std::vector<Declared> all = declared_in(script);
  std::string text = "script\t" + std::string(name) + "\t" + checksum(script) + "\n";
  for (const Declared& declared : all)
    if (!may_change(declared))
      text += declared.kind + "\t" + declared.identity + "\t" +
              checksum(costed(one_line(declared.statement)).statement) + "\n";
  for (const std::string& symbol : symbols_of(all)) text += "symbol\t" + symbol + "\t\n";
  return text;
}

struct Difference {
  std::vector<std::string> statements;
  std::vector<std::string> errors;  ///< what has changed and must not
};

/// "CREATE OPERATOR CLASS name ... USING method AS items": the items.
inline std::vector<std::string> items_of_class(const std::string& statement) {
  const std::string text = one_line(statement);
  return parts_of(std::string_view(text).substr(text.find(" AS ") + 4));
}

/// Operators that a class has gained; those of a released class stay in it.
inline void add_to_class(Difference& result, const Declared& before, const Declared& now) {
  const std::vector<std::string> old = items_of_class(before.statement), all = items_of_class(now.statement);
  const std::set<std::string> known(old.begin(), old.end()), still(all.begin(), all.end());
  std::string added;
  for (const std::string& item : old)
    if (!still.contains(item)) result.errors.push_back("operator class " + now.identity + " has lost: " + item);
  for (const std::string& item : all) {
    if (known.contains(item)) continue;
    if (!item.starts_with("OPERATOR ")) {
      result.errors.push_back("operator class " + now.identity + ": only operators can be added, not: " + item);
      continue;
    }
    added += (added.empty() ? " ADD\n  " : ",\n  ") + item;
  }
  if (!added.empty()) result.statements.push_back("ALTER OPERATOR FAMILY " + now.identity + added);
}

inline void add_difference(Difference& result, const Declared& before, const Declared& now) {
  const Costed old = costed(one_line(before.statement)), made = costed(one_line(now.statement));
  if (old.statement == made.statement && old.cost == made.cost) return;
  if (may_change(now)) {
    result.statements.push_back(now.statement);
  } else if (now.kind == "function" && old.statement == made.statement) {
    result.statements.push_back("ALTER FUNCTION " + now.identity + " COST " + made.cost);
  } else if (now.kind == "operator class") {
    add_to_class(result, before, now);
  } else {
    result.errors.push_back(now.kind + " " + now.identity + " was\n  " + before.statement + "\nand is now\n  " +
                            now.statement);
  }
}

/// The script that makes a database with the released version one with all that `now` declares.
inline Difference difference(const std::vector<Declared>& released, const std::vector<Declared>& now) {
  Difference result;
  std::map<std::pair<std::string, std::string>, const Declared*> before, after;
  for (const Declared& declared : released) before[{declared.kind, declared.identity}] = &declared;
  for (const Declared& declared : now) {
    if (declared.kind.empty()) result.errors.push_back("unknown statement: " + declared.statement);
    after[{declared.kind, declared.identity}] = &declared;
    const auto found = before.find({declared.kind, declared.identity});
    if (found == before.end())
      result.statements.push_back(declared.statement);
    else
      add_difference(result, *found->second, declared);
  }
  for (const Declared& declared : released)
    if (!after.contains({declared.kind, declared.identity}))
      result.errors.push_back(declared.kind + " " + declared.identity + " is gone");
  return result;
}

/// All statements of a version that is made from a released one: its own, but for those that the difference replaces,
/// then the difference. So new and upgraded databases have the same.
inline std::vector<std::string> whole(const std::vector<Declared>& released, const Difference& made) {
  std::set<std::pair<std::string, std::string>> replaced;
  for (const std::string& statement : made.statements) {
    const Declared declared = declared_by(statement);
    if (may_change(declared)) replaced.insert({declared.kind, declared.identity});
  }
  std::vector<std::string> statements;
  for (const Declared& declared : released)
    if (!replaced.contains({declared.kind, declared.identity})) statements.push_back(declared.statement);
  statements.insert(statements.end(), made.statements.begin(), made.statements.end());
  return statements;
}

}  // namespace algebra3d_postgres
