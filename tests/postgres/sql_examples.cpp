// Writes the examples of the registry as SQL: for each a line with a SELECT of a text and of whether the example gives
// what it says. The test of the extension runs them.
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/example_notation.h"
#include "algebra3d/values/types/scalars.h"
#include "exported.h"

namespace {

using algebra3d::ExampleTerm;
using algebra3d::NestedList;
using algebra3d::Operator;
using algebra3d::Registry;
using algebra3d::Type;
using algebra3d::TypeExpr;
using Kind = ExampleTerm::Kind;

/// An expression of SQL with its type; `is_rows` of a table.
struct Expression {
  std::string sql;
  const Type* type = nullptr;
  bool is_rows = false;
};

/// Nothing where SQL has no such function.
class Writer {
 public:
  Writer() : registry_(algebra3d::make_registry()) {
    for (const algebra3d_postgres::SqlFunction& sql : algebra3d_postgres::exported()) known_.insert(sql.signature());
  }

  const Registry& registry() const { return registry_; }
  std::vector<ExampleTerm> parsed(const std::vector<std::string>& texts) const {
    std::vector<ExampleTerm> terms;
    for (const std::string& text : texts) terms.push_back(*ExampleTerm::parse(text, registry_));
    return terms;
  }
  std::optional<Expression> call(const Operator& op, const std::vector<ExampleTerm>& terms) {
    std::vector<Expression> arguments;
    std::vector<TypeExpr> types;
    for (const ExampleTerm& term : terms) {
      auto argument = expression(term);
      if (!argument || argument->is_rows) return std::nullopt;
      types.push_back(argument->type->term());
      arguments.push_back(*std::move(argument));
    }
    if (op.kind() == algebra3d::OperatorKind::aggregate) types.resize(1);
    const auto resolved = registry_.resolve(op, types);
    if (!resolved) return std::nullopt;
    std::string signature = op.host_name + "(", list;
    for (const algebra3d::Parameter& parameter : resolved->overload->parameters) {
      const std::string type = algebra3d_postgres::sql_type(parameter.type->name());
      signature += (signature.back() == '(' ? "" : ", ") + type;
    }
    if (!known_.contains(signature + ")")) return std::nullopt;
    const bool is_aggregate = op.kind() == algebra3d::OperatorKind::aggregate;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      list += (list.empty() ? "" : ", ") + (is_aggregate ? "(" + arguments[i].sql + ")" : arguments[i].sql);
    if (resolved->overload->kind() == algebra3d::OperatorKind::table)
      return Expression{op.host_name + "(" + list + ")", nullptr, true};
    const std::string call = is_aggregate ? "(SELECT " + op.host_name + "(v) FROM (VALUES " + list + ") t(v))"
                                          : op.host_name + "(" + list + ")";
    return Expression{call, resolved->overload->result, false};
  }
  /// Whether the call, seen so, is the result: a condition of SQL.
  std::optional<std::string> condition(const ExampleTerm& view, const Expression& answer, const std::string& result) {
    shown_ = answer;
    const auto seen = expression(view);
    if (!seen || seen->is_rows) return std::nullopt;
    if (result == "undefined") return seen->sql + " IS NULL";
    const std::string_view type = seen->type->name();
    const NestedList list = *NestedList::parse(result);
    if (algebra3d_postgres::is_own(type)) return "as_text(" + seen->sql + ") = " + algebra3d_postgres::quoted(result);
    if (list.is_string()) return seen->sql + " = " + algebra3d_postgres::quoted(list.as_string());
    if (type == "bytes") return seen->sql + " = " + bytes_literal(list) + "::bytea";
    if (list.is_text()) return seen->sql + " = " + algebra3d_postgres::quoted(list.as_text());
    return seen->sql + " = " + result;
  }

 private:
  std::optional<Expression> expression(const ExampleTerm& term) {
    if (term.kind == Kind::shown_call) return shown_;
    if (term.kind == Kind::row_count) {
      const auto rows = term.arguments.front().kind == Kind::shown_call ? std::optional(shown_) : std::nullopt;
      if (!rows || !rows->is_rows) return std::nullopt;
      return Expression{"(SELECT count(*) FROM " + rows->sql + ")", &algebra3d::TypeOf<std::int64_t>::type(), false};
    }
    if (term.kind == Kind::call) return call(*term.op, term.arguments);
    const std::string type = algebra3d_postgres::sql_type(term.type->name());
    if (type.empty()) return std::nullopt;
    return Expression{literal(term) + "::" + type, term.type, false};
  }
  static std::string literal(const ExampleTerm& term) {
    const NestedList& list = term.value;
    if (term.kind == Kind::no_value || list.is_undefined()) return "NULL";
    if (term.type->name() == "bytes") return bytes_literal(list);
    if (list.is_string()) return algebra3d_postgres::quoted(list.as_string());
    if (list.is_text()) return algebra3d_postgres::quoted(list.as_text());
    return algebra3d_postgres::quoted(list.print());
  }
  static std::string bytes_literal(const NestedList& digits) {
    return algebra3d_postgres::quoted("\\x" + digits.as_text());
  }

  Registry registry_;
  std::set<std::string> known_;
  Expression shown_;
};

}  // namespace

int main() {
  a3d_session* const session = a3d_open(nullptr);
  Writer writer;
  for (const Operator* op : writer.registry().operators())
    for (const algebra3d::Example& example : op->examples) {
      const auto answer = writer.call(*op, writer.parsed(example.arguments));
      if (!answer) continue;
      const auto condition = writer.condition(writer.parsed({example.view}).front(), *answer, example.result);
      if (!condition) continue;
      std::string text = algebra3d_postgres::quoted(op->name + ": " + *condition);
      for (char& c : text)
        if (c == '\n') c = ' ';
      std::cout << "SELECT (" << *condition << ") IS TRUE, " << text << ";\n";
    }
  a3d_close(session);
  return 0;
}
