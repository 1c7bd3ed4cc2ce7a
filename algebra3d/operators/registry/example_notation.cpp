#include "algebra3d/operators/registry/example_notation.h"

#include <utility>

#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

using Kind = ExampleTerm::Kind;

const Type* type_of_atom(const NestedList& atom) {
  if (atom.is_int()) return &TypeOf<std::int64_t>::type();
  if (atom.is_real()) return &TypeOf<double>::type();
  if (atom.is_bool()) return &TypeOf<bool>::type();
  if (atom.is_string()) return &TypeOf<std::string>::type();
  return atom.is_text() ? &TypeOf<Text>::type() : nullptr;
}

Error not_understood(const NestedList& list) {
  return {ErrorCode::internal, "example: '{}' is not understood", list.print_short()};
}

ExampleTerm value_term(const Type* type, NestedList value) {
  ExampleTerm term;
  term.type = type;
  term.value = std::move(value);
  return term;
}

Result<ExampleTerm> term_of(const NestedList& list, const Registry& registry);

Result<ExampleTerm> applied(Kind kind, const Operator* op, const NestedList::List& elements, const Registry& registry) {
  ExampleTerm term;
  term.kind = kind;
  term.op = op;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    A3D_ASSIGN(ExampleTerm argument, term_of(elements[i], registry));
    term.arguments.push_back(std::move(argument));
  }
  return term;
}

Result<ExampleTerm> term_of_list(const NestedList& list, const Registry& registry) {
  const NestedList::List& elements = list.elements();
  if (elements.empty() || !elements[0].is_symbol()) return not_understood(list);
  const std::string& head = elements[0].as_symbol();
  if (const Type* type = registry.find_type(head); type != nullptr && elements.size() <= 2) {
    ExampleTerm term = value_term(type, elements.back());
    if (elements.size() == 1) term.kind = Kind::no_value;
    return term;
  }
  if (head == "count" && elements.size() == 2) return applied(Kind::row_count, nullptr, elements, registry);
  const Operator* op = registry.find_operator(head);
  if (op == nullptr || op->kind() != OperatorKind::scalar) return not_understood(list);
  return applied(Kind::call, op, elements, registry);
}

// Recursion as deep as our own examples.
Result<ExampleTerm> term_of(const NestedList& list, const Registry& registry) {
  if (list.is_list()) return term_of_list(list, registry);
  if (list.is_symbol("_")) {
    ExampleTerm shown;
    shown.kind = Kind::shown_call;
    return shown;
  }
  const Type* type = type_of_atom(list);
  if (type == nullptr) return not_understood(list);
  ExampleTerm atom = value_term(type, list);
  atom.is_plain_atom = true;
  return atom;
}

}  // namespace

Result<ExampleTerm> ExampleTerm::parse(std::string_view text, const Registry& registry) {
  A3D_ASSIGN(const NestedList list, NestedList::parse(text));
  return term_of(list, registry);
}

}  // namespace algebra3d
