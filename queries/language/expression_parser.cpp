#include "queries/language/expression_parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/file_atom.h"
#include "base/propagate.h"
#include "queries/language/parser.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Operator;
using algebra3d::SyntaxPattern;
using Kind = Token::Kind;
using Shape = SyntaxPattern::Shape;

constexpr std::array<std::pair<std::string_view, int>, 11> kPrecedences = {{
    {"or", 1},
    {"and", 2},
    {"+", 4},
    {"-", 4},
    {"union", 4},
    {"minus", 4},
    {"*", 5},
    {"/", 5},
    {"div", 5},
    {"mod", 5},
    {"intersection", 5},
}};

// Every infix operator that the table leaves out is a predicate and stands with the comparisons.
int precedence_of(std::string_view name) {
  const auto* const row = std::ranges::find(kPrecedences, name, [](const auto& entry) { return entry.first; });
  return row == kPrecedences.end() ? 3 : row->second;
}

bool is_number(const Token& token) {
  return token.kind == Kind::integer || token.kind == Kind::real;
}

Argument value_argument(ExpressionPtr value) {
  Argument argument;
  argument.place = value->place;
  argument.value = std::move(value);
  return argument;
}

}  // namespace

ExpressionPtr ExpressionParser::make(SourcePlace place, ExpressionNode node) const {
  const int height = 1 + height_below(node);
  return std::make_shared<const Expression>(Expression{std::move(place), std::move(node), height});
}

// Operators in a row make deep trees without nesting, and whatever walks a tree recurses on its height.
Status ExpressionParser::check_height(const Expression& expression) const {
  if (expression.height <= kMaxExpressionHeight) return {};
  return too_high(expression.place);
}

bool ExpressionParser::accept(std::string_view spelling) {
  if (!at(spelling)) return false;
  scanner_.take();
  return true;
}

Status ExpressionParser::expect(std::string_view spelling, std::string_view context) {
  if (accept(spelling)) return {};
  return unexpected(fmt::format("'{}' {}", spelling, context));
}

Status ExpressionParser::expect_end() {
  if (scanner_.peek().kind == Kind::end && !scanner_.error()) return {};
  return unexpected("the end of the command");
}

Result<std::string> ExpressionParser::name(std::string_view what) {
  if (!scanner_.peek().is_name()) return unexpected(what);
  return scanner_.take().text;
}

Status ExpressionParser::deeper() {
  if (depth_ < kMaxBracketDepth) return {};
  return Error(ErrorCode::limit_exceeded, "brackets are nested deeper than {} levels", kMaxBracketDepth)
      .at(scanner_.peek().place);
}

const Operator* ExpressionParser::operator_at(Shape shape) {
  const Token& token = scanner_.peek();
  if (token.kind != Kind::word && token.kind != Kind::special) return nullptr;
  const Operator* op = registry_.find_operator(token.text);
  return op != nullptr && registry_.syntax(*op).shape == shape ? op : nullptr;
}

bool ExpressionParser::at_call_of_infix() {
  const Operator* op = operator_at(Shape::infix);
  return op != nullptr && op->also_prefix && scanner_.peek(1).is("(") && scanner_.has_comma_in_next_parentheses();
}

const Operator* ExpressionParser::infix_operator_at() {
  return at_call_of_infix() ? nullptr : operator_at(Shape::infix);
}

// Precedence climbing; all operators group to the left.
Result<ExpressionPtr> ExpressionParser::binary(int lowest_precedence) {
  A3D_TRY(deeper());
  ++depth_;
  A3D_ASSIGN(ExpressionPtr left, chain());
  A3D_TRY(check_height(*left));
  for (const Operator* op = infix_operator_at(); op != nullptr; op = infix_operator_at()) {
    const int precedence = precedence_of(op->name);
    if (precedence < lowest_precedence) break;
    const SourcePlace place = scanner_.take().place;
    if (at_argument_brackets()) return unexpected_in(*op, "an operand after '" + op->name + "'");
    A3D_ASSIGN(ExpressionPtr right, binary(precedence + 1));
    left =
        make(place, Application{op->name, {value_argument(std::move(left)), value_argument(std::move(right))}, false});
    A3D_TRY(check_height(*left));
  }
  --depth_;
  return left;
}

Result<ExpressionPtr> ExpressionParser::chain() {
  if (at("-") && !is_number(scanner_.peek(1))) return negation();
  const auto outer_suspicion = std::exchange(suspicion_, std::nullopt);
  A3D_ASSIGN(std::vector<ExpressionPtr> found, operands());
  if (found.size() > 1) return suspicion_ ? *suspicion_ : not_an_operator(found[1]);
  suspicion_ = outer_suspicion;
  return std::move(found.front());
}

// A minus before anything but a number: `-` with one operand. It binds looser than postfix operators.
Result<ExpressionPtr> ExpressionParser::negation() {
  A3D_TRY(deeper());
  ++depth_;
  const SourcePlace place = scanner_.take().place;
  A3D_ASSIGN(ExpressionPtr operand, chain());
  --depth_;
  ExpressionPtr negated = make(place, Application{"-", {value_argument(std::move(operand))}, false});
  A3D_TRY(check_height(*negated));
  return negated;
}

// Operands side by side, consumed by the postfix operators that follow them.
Result<std::vector<ExpressionPtr>> ExpressionParser::operands() {
  std::vector<ExpressionPtr> found;
  while (true) {
    if (const Operator* op = postfix_operator_at(found.size()); op != nullptr) {
      A3D_TRY(postfix_application(*op, found));
    } else if (at("{") && !found.empty()) {
      A3D_TRY(annotation(found.back()));
    } else if (found.empty() || starts_operand()) {
      suspect_operator(found.size());
      A3D_ASSIGN(ExpressionPtr operand, primary());
      found.push_back(std::move(operand));
    } else {
      return found;
    }
  }
}

// With too few operands before it, the word is the name of an operand.
const Operator* ExpressionParser::postfix_operator_at(std::size_t operand_count) {
  const Operator* op = operator_at(Shape::postfix);
  return op != nullptr && operand_count >= registry_.syntax(*op).operand_count ? op : nullptr;
}

bool ExpressionParser::starts_operand() {
  const Token& token = scanner_.peek();
  switch (token.kind) {
    case Kind::end:
      return false;
    case Kind::special:
      return token.text == "(" || token.text == "[";
    case Kind::word: {
      if (token.text == "fun" || token.text == "group" || token.text == "tuple") return true;
      return !is_reserved(token.text) && infix_operator_at() == nullptr;
    }
    default:
      return true;
  }
}

Result<ExpressionPtr> ExpressionParser::primary() {
  const Token& token = scanner_.peek();
  const SourcePlace place = token.place;
  switch (token.kind) {
    case Kind::integer:
    case Kind::real:
      return signed_number();
    case Kind::boolean:
      return make(place, Literal{NestedList(scanner_.take().text == "TRUE")});
    case Kind::string:
      return make(place, Literal{NestedList(scanner_.take().text)});
    case Kind::text:
      return make(place, Literal{NestedList::text(scanner_.take().text)});
    case Kind::file:
      return make(place, file_literal(algebra3d::file_atom(scanner_.take().text), place));
    case Kind::attribute: {
      const Token use = scanner_.take();
      return make(place, AttributeUse{use.parameter, use.text});
    }
    case Kind::parameter:
      return make(place, ParameterUse{scanner_.take().parameter});
    case Kind::constant: {
      A3D_ASSIGN(ExpressionNode constant, parameter_constant(parameters_, scanner_.take()));
      return make(place, std::move(constant));
    }
    case Kind::word:
      return word_primary();
    case Kind::name:
      return name_or_call(scanner_.take());
    default:
      break;
  }
  if (at("-") || at("+")) return signed_number();
  if (at("[")) return list();
  if (accept("(")) {
    A3D_ASSIGN(ExpressionPtr inner, expression());
    A3D_TRY(expect(")", "to close the bracket"));
    return inner;
  }
  const Operator* const op = token.kind == Kind::special ? registry_.find_operator(token.text) : nullptr;
  return op == nullptr ? unexpected("an operand") : unexpected_in(*op, "an operand");
}

Result<ExpressionPtr> ExpressionParser::word_primary() {
  const Token token = scanner_.peek();
  if (token.text == "fun") return function_literal();
  if (token.text == "tuple" || token.text == "group") {
    scanner_.take();
    return make(token.place, ParameterUse{1});
  }
  if (is_reserved(token.text)) return Error(ErrorCode::syntax_error, "{}", no_operand_text(token.text)).at(token.place);
  const Operator* op = registry_.find_operator(token.text);
  scanner_.take();
  if (op != nullptr && at("(")) {
    if (registry_.syntax(*op).shape == Shape::prefix) return prefix_application(*op, token.place);
    if (op->also_prefix) return call_of_operator(*op, token.place);
  }
  return name_or_call(token);
}

// `rect2region(r)` for `r rect2region`, `intersection(a, b)` for `a intersection b`.
Result<ExpressionPtr> ExpressionParser::call_of_operator(const Operator& op, const SourcePlace& place) {
  A3D_ASSIGN(const ExpressionPtr written, function_call(op.name, place));
  Application application{op.name, {}, true};
  for (const ExpressionPtr& operand : std::get<FunctionCall>(written->node).arguments)
    application.arguments.push_back(value_argument(operand));
  return make(place, std::move(application));
}

// The name, which is taken already, in operand position.
Result<ExpressionPtr> ExpressionParser::name_or_call(const Token& token) {
  if (at("(")) return function_call(token.text, token.place);
  const bool is_operand = !at("[") || scanner_.peek(1).is("const");
  if (is_operand) return make(token.place, NameUse{token.text});
  // `feeed[...]`: a bracket after a name is the argument list of an operator that there is not.
  if (suspicion_ && registry_.find_operator(token.text) != nullptr) return *suspicion_;
  return not_an_operator(make(token.place, NameUse{token.text}));
}

Result<ExpressionPtr> ExpressionParser::prefix_application(const Operator& op, SourcePlace place) {
  scanner_.take();
  Application application{op.name, {}, true};
  A3D_TRY(places(op, ")", application.arguments));
  return make(std::move(place), std::move(application));
}

Result<ExpressionPtr> ExpressionParser::function_call(std::string function, SourcePlace place) {
  scanner_.take();
  FunctionCall call{std::move(function), {}};
  while (!at(")")) {
    A3D_ASSIGN(ExpressionPtr argument, expression());
    call.arguments.push_back(std::move(argument));
    if (!accept(",")) break;
  }
  if (!accept(")")) {
    const std::string expected = "')' to close the arguments of '" + call.name + "'";
    const Operator* const op = registry_.find_operator(call.name);
    return op == nullptr ? unexpected(expected) : unexpected_in(*op, expected);
  }
  return make(std::move(place), std::move(call));
}

Status ExpressionParser::postfix_application(const Operator& op, std::vector<ExpressionPtr>& operands) {
  const SyntaxPattern& pattern = registry_.syntax(op);
  const Token word = scanner_.take();
  const SourcePlace& place = word.place;
  Application application{op.name, {}, false};
  const auto first = operands.end() - static_cast<std::ptrdiff_t>(pattern.operand_count);
  for (auto operand = first; operand != operands.end(); ++operand)
    application.arguments.push_back(value_argument(std::move(*operand)));
  operands.erase(first, operands.end());
  // `_ rduph[...]`: where nothing must stand in the brackets they may be left out.
  const bool may_leave_out = pattern.places.empty() && !at("[");
  if (pattern.has_brackets && !may_leave_out) {
    if (!accept("[")) return unexpected_in(op, "'[' after '" + op.name + "'");
    A3D_TRY(places(op, "]", application.arguments));
  } else if (!pattern.has_brackets) {
    A3D_TRY(check_no_arguments(op, word));
  }
  operands.push_back(make(place, std::move(application)));
  return check_height(*operands.back());
}

// `E {x}` renames, `E {5}`, `E {0.01, 2.5}` and `E {memory 64}` are hints that change no result.
Status ExpressionParser::annotation(ExpressionPtr& operand) {
  const SourcePlace place = scanner_.take().place;
  const Token first = scanner_.take();
  if (first.is_name() && !first.is("memory")) {
    Argument argument;
    argument.kind = SyntaxPattern::PlaceKind::name;
    argument.names = {first.text};
    argument.place = first.place;
    operand = make(place, Application{"rename", {value_argument(operand), std::move(argument)}, false});
    A3D_TRY(check_height(*operand));
  } else {
    const bool is_memory = first.kind == Kind::word;
    if (!is_memory && first.kind != Kind::integer && first.kind != Kind::real)
      return Error(ErrorCode::syntax_error, "expected a name or a number after '{{', found {}", first.shown())
          .at(first.place);
    if (is_memory || accept(",")) scanner_.take();
  }
  return expect("}", "to close the bracket");
}

}  // namespace queries
