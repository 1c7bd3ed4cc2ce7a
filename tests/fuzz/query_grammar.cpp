#include "fuzz/query_grammar.h"

#include <algorithm>
#include <initializer_list>

#include <fmt/format.h>

#include "queries/language/checker.h"
#include "queries/language/example_queries.h"
#include "queries/language/parser.h"
#include "queries/streams/stream_operator.h"

namespace queries::fuzz {
namespace {

using algebra3d::Operator;
using algebra3d::Overload;
using algebra3d::SyntaxPattern;
using PlaceKind = SyntaxPattern::PlaceKind;
using Shape = SyntaxPattern::Shape;

constexpr int kDepth = 3;

const std::vector<std::string> kNumbers = {"0",    "1",     "-1",         "2",           "3",
                                           "7",    "100",   "1000",       "0.0",         "0.5",
                                           "-1.5", "1e300", "2147483647", "-2147483648", "9223372036854775807",
                                           "1e-9", ".5",    "5.",         "32767",       "4294967296",
                                           "0.1",  "+5"};
const std::vector<std::string> kIntegers = {
    "0", "1", "2", "3", "5", "-1", "10", "64", "2147483648", "9223372036854775807", "-9223372036854775808"};
const std::vector<std::string> kReals = {"0.0", "0.5", "1.0", "-1.5", "1e300", "0.1", "1e-300", "3.0"};
const std::vector<std::string> kStrings = {"\"a\"", "\"\"", "\"b\\\"c\"", "\"abc\"", "\"é\""};
const std::vector<std::string> kTexts = {"'a'", "''", "'some text'", "'it\\'s'", "'cube.stl'", "<text>a 'b'</text--->"};
const std::vector<std::string> kFiles = {"'all.txt'", "'one.txt'", "'function.txt'", "'new.txt'",
                                         "saved",     "'.'",       "'w.db'"};
const std::vector<std::string> kNewNames = {"A", "B", "K", "V", "Elem", "A_old", "TID", "Id", "Name"};
const std::vector<std::string> kLanguageWords = {"fun",
                                                 "const",
                                                 "value",
                                                 "type",
                                                 "typeOf",
                                                 "TRUE",
                                                 "FALSE",
                                                 "undefined",
                                                 "tuple",
                                                 "group",
                                                 "attr",
                                                 "rel",
                                                 "stream",
                                                 "map",
                                                 "asc",
                                                 "desc",
                                                 "query",
                                                 "let",
                                                 "if",
                                                 "then",
                                                 "else",
                                                 "endif",
                                                 ".",
                                                 "..",
                                                 ".K",
                                                 "..K",
                                                 "$1",
                                                 "$2.K",
                                                 "tuple1",
                                                 "tuple2",
                                                 "(",
                                                 ")",
                                                 "[",
                                                 "]",
                                                 "{",
                                                 "}",
                                                 "{{",
                                                 "}}",
                                                 "|",
                                                 ",",
                                                 ":",
                                                 ":=",
                                                 "=",
                                                 "::",
                                                 "memory",
                                                 "<file>cube.stl</file--->",
                                                 "_! comment !_"};
const std::vector<std::string> kInquiries = {
    "databases", "objects", "types", "type constructors", "operators", "algebras", "algebra Standard", "counters"};

/// The types of objects, without values.
class KnownObjects final : public ObjectSource {
 public:
  explicit KnownObjects(std::map<std::string, TypeExpr> types) : types_(std::move(types)) {}
  void add(const std::string& name, const TypeExpr& type) { types_.insert_or_assign(name, type); }

  Result<std::optional<TypeExpr>> type_of(const std::string& name) override {
    const auto found = types_.find(name);
    return found == types_.end() ? std::nullopt : std::optional(found->second);
  }
  Result<Datum> value_of(const std::string& name) override { return Error{ErrorCode::not_evaluable, "{}", name}; }
  Result<std::optional<TypeExpr>> named_type(const std::string& name) override {
    if (name != "pair") return std::optional<TypeExpr>();
    return std::optional(TypeExpr::tuple({{"K", "int"}, {"V", "int"}}));
  }
  std::vector<std::string> names() override { return {}; }

 private:
  std::map<std::string, TypeExpr> types_;
};

// Operators of one form can be exchanged without harm to the syntax.
std::string form_of(const SyntaxPattern& pattern) {
  std::string form = fmt::format("{}{}", static_cast<int>(pattern.shape), pattern.operand_count);
  for (const auto& place : pattern.places) form += fmt::format("{}{}", place.before, static_cast<int>(place.kind));
  return form;
}

// What decides, more or less, which operators fit.
std::string kind_of(const TypeExpr& type) {
  if (type.is_tuple_stream()) return "stream(tuple)";
  return type.is_stream() ? "stream" : type.name();
}

// Aggregates are written like other operators over streams.
bool is_called_with_values(const Overload& overload) {
  return overload.kind() != algebra3d::OperatorKind::aggregate;
}

bool gives(const Overload& overload, const TypeExpr& type) {
  return is_called_with_values(overload) && overload.result_type() == type;
}

bool is_known(const TypeExpr& type) {
  return !type.name().empty();
}

const std::vector<TypeExpr::Attribute>& attributes_of(const TypeExpr& type) {
  static const std::vector<TypeExpr::Attribute> none;
  if (type.is_tuple()) return type.attributes();
  return type.is_tuple_stream() || type.is_relation() ? type.element().attributes() : none;
}

// In the syntax of texts, where tuples have brackets.
std::string written(const TypeExpr& type) {
  if (type.is_tuple()) {
    std::string text;
    for (const auto& attribute : type.attributes())
      text += (text.empty() ? "" : ", ") + attribute.name + ": " + written(attribute.type);
    return "tuple([" + text + "])";
  }
  std::string text;
  for (const TypeExpr& argument : type.arguments()) text += (text.empty() ? "" : ", ") + written(argument);
  return text.empty() ? type.name() : type.name() + "(" + text + ")";
}

}  // namespace

QueryGrammar::QueryGrammar(const algebra3d::Registry& registry, std::map<std::string, TypeExpr> objects)
    : registry_(registry), objects_(std::move(objects)), operators_(registry.operators()), words_(kLanguageWords) {
  for (const auto& [name, type] : objects_) names_.push_back(name);
  for (const Operator* op : operators_) {
    const SyntaxPattern& pattern = registry.syntax(*op);
    if (pattern.shape == Shape::postfix) postfix_.push_back(op);
    alike_[form_of(pattern)].push_back(op->name);
    words_.push_back(op->name);
    for (const Overload& overload : op->overloads) {
      if (!is_called_with_values(overload)) continue;
      auto& givers = giving_[overload.result_type().text()];
      if (givers.empty() || givers.back() != op) givers.push_back(op);
    }
  }
  for (const auto& [name, type] : objects_)
    if (type.is_relation() || type.arguments().size() > 1) collections_.push_back(name);
  for (const algebra3d::Type* each : registry.types()) words_.emplace_back(each->name());
  for (const std::vector<std::string>* list :
       std::initializer_list<const std::vector<std::string>*>{&names_, &kNumbers, &kStrings, &kTexts, &kNewNames})
    words_.insert(words_.end(), list->begin(), list->end());
}

std::string QueryGrammar::word(Dice& dice) {
  return dice.of(words_);
}

const std::vector<std::string>& QueryGrammar::written_like(const std::string& op) const {
  static const std::vector<std::string> none;
  const Operator* found = registry_.find_operator(op);
  return found == nullptr ? none : alike_.at(form_of(registry_.syntax(*found)));
}

TypeExpr QueryGrammar::type_of(const std::string& text, const Scope& known) const {
  KnownObjects objects(objects_);
  for (const auto& [name, type] : known) objects.add(name, type);
  const auto expression = parse_expression(text, registry_);
  if (!expression) return {};
  algebra3d::Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  const auto node = Checker(registry_, objects, context).check(**expression);
  return node ? (*node)->type() : TypeExpr();
}

// --- values ---

TypeExpr QueryGrammar::simple_type(Dice& dice) {
  return dice.of(registry_.types())->name();
}

std::string QueryGrammar::name(Dice& dice) {
  return dice.one_in(3) ? dice.of(names_) : dice.of(kNewNames);
}

std::string QueryGrammar::literal(Dice& dice, const TypeExpr& type) {
  const std::string text = written(type);
  if (dice.one_in(12)) return "[const " + text + " value undefined]";
  if (type.is("int")) return dice.of(kIntegers);
  if (type.is("real")) return dice.of(kReals);
  if (type.is("bool")) return dice.one_in(2) ? "TRUE" : "FALSE";
  if (type.is("string")) return dice.of(kStrings);
  if (type.is("text")) return dice.of(kTexts);
  const algebra3d::Type* found = registry_.find_type(type.name());
  return "[const " + text + " value " + (found == nullptr ? "()" : std::string(found->example())) + "]";
}

std::string QueryGrammar::value(Dice& dice, const TypeExpr& type, const Scope& scope, int depth) {
  std::vector<std::string> fitting;
  for (const auto& [text, scoped_type] : scope)
    if (scoped_type == type) fitting.push_back(text);
  if (!fitting.empty() && !dice.one_in(3)) return dice.of(fitting);
  if (depth <= 0 || dice.one_in(4)) {
    for (const auto& [object, object_type] : objects_)
      if (object_type == type && dice.one_in(object == "U" ? 20 : 2)) return object;
    return literal(dice, type);
  }
  if (dice.one_in(8))
    if (Typed found = chain(dice, scope, depth - 1); found.type == type) return "(" + found.text + ")";
  const auto found = giving_.find(type.text());
  if (found == giving_.end()) return literal(dice, type);
  const Operator& op = *dice.of(found->second);
  std::vector<const Overload*> fitting_overloads;
  for (const Overload& overload : op.overloads)
    if (gives(overload, type)) fitting_overloads.push_back(&overload);
  const Overload* overload = dice.of(fitting_overloads);
  return value_call(dice, op, *overload, scope, depth - 1);
}

std::string QueryGrammar::any_value(Dice& dice, const Scope& scope, int depth) {
  if (!scope.empty() && dice.one_in(2)) return value(dice, dice.of(scope).type, scope, depth);
  if (dice.one_in(2)) return value(dice, dice.one_in(2) ? "bool" : "int", scope, depth);
  return value(dice, simple_type(dice), scope, depth);
}

std::string QueryGrammar::value_call(Dice& dice, const Operator& op, const Overload& overload, const Scope& scope,
                                     int depth) {
  std::vector<std::string> arguments;
  for (const auto& parameter : overload.parameters)
    arguments.push_back(value(dice, TypeExpr(parameter.type->name()), scope, depth));
  const SyntaxPattern& pattern = registry_.syntax(op);
  const auto first = arguments.begin() + static_cast<std::ptrdiff_t>(std::min(pattern.operand_count, arguments.size()));
  const std::string inner = fmt::format("{}", fmt::join(first, arguments.end(), ", "));
  if (pattern.shape == Shape::prefix) return op.name + "(" + inner + ")";
  if (pattern.shape == Shape::infix && arguments.size() == 1) return "(" + op.name + " " + arguments.front() + ")";
  if (pattern.shape == Shape::infix) return "(" + fmt::format("{}", fmt::join(arguments, " " + op.name + " ")) + ")";
  const std::string operands = fmt::format("{}", fmt::join(arguments.begin(), first, " "));
  return "(" + operands + " " + op.name + (pattern.has_brackets ? "[" + inner + "]" : "") + ")";
}

// --- types ---

std::string QueryGrammar::type(Dice& dice, int depth) {
  switch (dice.below(depth <= 0 ? 2 : 8)) {
    case 2:
      return "rel(tuple([A: " + type(dice, depth - 1) + ", B: " + type(dice, 0) + "]))";
    case 3:
      return "(rel (tuple ((A " + type(dice, 0) + ") (B int))))";
    case 4:
      return dice.one_in(2) ? "rel(pair)" : "pair";
    case 5:
      return "typeOf(" + value(dice, simple_type(dice), {}, depth - 1) + ")";
    case 6:
      return "stream(" + type(dice, depth - 1) + ")";
    case 7:
      return "map(" + type(dice, depth - 1) + ", int)";
    default:
      return written(simple_type(dice));
  }
}

// --- operators one after the other ---

QueryGrammar::Typed QueryGrammar::beginning(Dice& dice, const Scope& scope, int depth) {
  if (!scope.empty() && dice.one_in(3)) {
    const Typed& found = dice.of(scope);
    return found;
  }
  if (dice.one_in(8)) {
    const std::string prefix = dice.one_in(2) ? "intstream(1, 5)" : any_value(dice, scope, depth);
    return {prefix, type_of(prefix, {})};
  }
  const std::string& object = dice.of(dice.one_in(4) ? names_ : collections_);
  const TypeExpr& type = objects_.at(object);
  if (type.is_relation() && !dice.one_in(3)) return {object + " feed", TypeExpr::stream(type.element())};
  return {object, type};
}

// Attributes of implicit parameters are left out.
QueryGrammar::Scope QueryGrammar::plain_names(const Scope& scope) {
  Scope names;
  for (const Typed& each : scope)
    if (each.text.find_first_of(".(") == std::string::npos && each.text != "group") names.push_back(each);
  return names;
}

// The operands are known to the checker by names, so that the work does not grow with the chain.
std::vector<QueryGrammar::Typed> QueryGrammar::applied(Dice& dice, const Typed& operand, const Scope& scope,
                                                       int depth) {
  auto& fitting = fitting_[kind_of(operand.type)];
  const Operator* op = !fitting.empty() && dice.one_in(2) ? dice.of(fitting) : dice.of(postfix_);
  const SyntaxPattern& pattern = registry_.syntax(*op);
  // Operators of two operands are choosy about the second.
  for (std::size_t tries = pattern.operand_count > 1 ? 4 : 1; tries > 0; --tries) {
    Scope known = plain_names(scope);
    known.push_back({"operand0", operand.type});
    std::string text = operand.text;
    std::string known_text = "operand0";
    std::vector<TypeExpr> types = {operand.type};
    for (std::size_t i = 1; i < pattern.operand_count; ++i) {
      const Typed other = further_operand(dice, operand, scope, depth);
      known.push_back({"operand" + std::to_string(i), other.type});
      types.push_back(other.type);
      text += " " + other.text;
      known_text += " operand" + std::to_string(i);
    }
    std::string rest = " " + op->name;
    if (pattern.has_brackets) rest += "[" + places(dice, pattern, types, scope, depth) + "]";
    TypeExpr type = type_of(known_text + rest, known);
    if (!is_known(type)) continue;
    if (std::ranges::find(fitting, op) == fitting.end()) fitting.push_back(op);
    return {{text + rest, std::move(type)}};
  }
  return {};
}

// The first operand again, under other names or not, or a relation, or an expression made of one.
QueryGrammar::Typed QueryGrammar::further_operand(Dice& dice, const Typed& first, const Scope& scope, int depth) {
  if (dice.one_in(4) && first.type.is_tuple_stream()) {
    const std::string text = first.text + " {x}";
    return {text, type_of("operand0 {x}", {{"operand0", first.type}})};
  }
  if (dice.one_in(8)) return first;
  if (dice.one_in(6))
    if (Typed found = chain(dice, scope, depth - 2); is_known(found.type)) return found;
  const std::string& relation = dice.of(collections_);
  const TypeExpr& type = objects_.at(relation);
  if (!type.is_relation() || dice.one_in(2)) return {relation, type};
  if (dice.one_in(2)) return {relation + " feed", TypeExpr::stream(type.element())};
  return {relation + " feed {y}", type_of(relation + " feed {y}", {})};
}

QueryGrammar::Typed QueryGrammar::chain(Dice& dice, const Scope& scope, int depth) {
  Typed found = beginning(dice, scope, depth);
  if (depth < 0 || !is_known(found.type)) return found;
  for (std::size_t tries = 3 + dice.below(20); tries > 0; --tries)
    if (auto next = applied(dice, found, scope, depth); !next.empty()) {
      // What ends a stream ends the chain, more or less.
      const bool goes_on = next.front().type.is_stream() || next.front().type.is_relation();
      if (goes_on || tries == 1 || dice.one_in(5)) found = std::move(next.front());
    }
  return found;
}

std::string QueryGrammar::attribute(Dice& dice, const std::vector<TypeExpr>& operands, std::size_t number) {
  const auto& attributes = attributes_of(operands[std::min(number, operands.size() - 1)]);
  return attributes.empty() || dice.one_in(15) ? dice.of(kNewNames) : dice.of(attributes).name;
}

std::string QueryGrammar::bracket_value(Dice& dice, const std::vector<TypeExpr>& operands, const Scope& scope,
                                        int depth) {
  const auto& attributes = attributes_of(operands.back());
  if (!attributes.empty() && dice.one_in(3)) return value(dice, dice.of(attributes).type, scope, depth);
  if (dice.one_in(4)) return any_value(dice, scope, depth);
  if (dice.one_in(15)) return "three()";
  return dice.one_in(2) ? dice.of(kIntegers) : value(dice, dice.one_in(2) ? "rect3" : "int", scope, depth);
}

std::string QueryGrammar::function(Dice& dice, const Place& place, const std::vector<TypeExpr>& operands,
                                   const Scope& scope, int depth) {
  Scope inner;
  std::string head;
  const bool is_explicit = place.parameters.empty() || dice.one_in(6);
  std::vector<std::string> pseudo = place.parameters;
  if (is_explicit && pseudo.empty()) pseudo = {"", ""};
  for (std::size_t i = 0; i < pseudo.size(); ++i) {
    const auto& attributes = attributes_of(operands.front());
    TypeExpr type = attributes.empty() ? TypeExpr("int") : dice.of(attributes).type;
    if (!pseudo[i].empty())
      if (auto found = pseudo_type(pseudo[i], operands); found) type = *found;
    const std::string parameter = dice.one_in(40) ? "tuple1" : std::string(1, static_cast<char>('a' + i));
    const std::string dots(i + 1, '.');
    head += (i == 0 ? "" : ", ") + parameter + ": " + (dice.one_in(10) ? "ANY" : written(type));
    inner.push_back({is_explicit ? parameter : type.is_relation() && i == 0 ? "group" : dots, type});
    for (const auto& each : type.is_tuple() ? attributes_of(type) : std::vector<TypeExpr::Attribute>())
      inner.push_back({is_explicit ? "attr(" + parameter + ", " + each.name + ")" : dots + each.name, each.type});
  }
  if (is_explicit)
    for (const Typed& outer : scope)
      if (!outer.text.starts_with('.')) inner.push_back(outer);
  std::string body;
  if (dice.one_in(4)) body = chain(dice, inner, depth - 2).text;
  if (body.empty() && place.parameters.size() == 1 && !dice.one_in(3)) body = value(dice, "bool", inner, depth - 1);
  if (body.empty()) body = dice.one_in(3) ? value(dice, "bool", inner, depth - 1) : any_value(dice, inner, depth - 1);
  return is_explicit ? "fun(" + head + ") " + body : body;
}

std::string QueryGrammar::place(Dice& dice, const Place& place, std::size_t number,
                                const std::vector<TypeExpr>& operands, const Scope& scope, int depth) {
  std::string text;
  const std::size_t count = dice.one_in(3) ? 2 : 1;
  switch (place.kind) {
    case PlaceKind::value:
      return bracket_value(dice, operands, scope, depth - 1);
    case PlaceKind::attribute:
      return attribute(dice, operands, number);
    case PlaceKind::name:
      return dice.of(kNewNames);
    case PlaceKind::function:
      return function(dice, place, operands, scope, depth);
    case PlaceKind::attributes:
    case PlaceKind::keys:
      for (std::size_t i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ", ") + attribute(dice, operands, 0);
        if (place.kind == PlaceKind::keys && dice.one_in(2)) text += dice.one_in(2) ? " asc" : " desc";
      }
      return text;
    case PlaceKind::functions:
      for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("{}{}: {}", i == 0 ? "" : ", ",
                            dice.one_in(2) ? attribute(dice, operands, 0) : "N" + std::to_string(dice.below(9)),
                            function(dice, place, operands, scope, depth));
      return text;
    case PlaceKind::renames:
      return dice.of(kNewNames) + ": " + attribute(dice, operands, 0);
  }
  return text;
}

std::string QueryGrammar::places(Dice& dice, const SyntaxPattern& pattern, const std::vector<TypeExpr>& operands,
                                 const Scope& scope, int depth) {
  std::string text;
  for (std::size_t i = 0; i < pattern.places.size(); ++i) {
    if (i > 0) text += std::string(1, pattern.places[i].before) + " ";
    text += place(dice, pattern.places[i], i, operands, scope, depth);
  }
  if (!pattern.is_open_ended) return text;
  // Further values: one for each attribute, as those need that make a tuple, or a few.
  const auto& attributes = attributes_of(operands.front());
  if (!attributes.empty() && pattern.places.size() == 1 && dice.one_in(2)) {
    text.clear();
    for (const auto& each : attributes) text += (text.empty() ? "" : ", ") + value(dice, each.type, scope, depth - 2);
    return text;
  }
  for (std::size_t more = dice.below(3); more > 0; --more) text += ", " + bracket_value(dice, operands, scope, 0);
  return text;
}

std::string QueryGrammar::query(Dice& dice) {
  if (dice.one_in(4)) return any_value(dice, {}, kDepth);
  const Typed found = chain(dice, {}, kDepth);
  if (!found.type.is_stream()) return found.text;
  return found.text + (dice.one_in(4) ? " count" : found.type.is_tuple_stream() ? " consume" : " collect_vector");
}

// --- commands ---

std::string QueryGrammar::example(Dice& dice) {
  const Operator& op = *dice.of(operators_);
  const auto failing = failing_queries(registry_, op);
  if (!failing.empty() && dice.one_in(4)) return dice.of(failing).query;
  const auto examples = example_queries(registry_, op);
  return examples.empty() ? query(dice) : dice.of(examples).query;
}

std::string QueryGrammar::nested(const std::string& expression) const {
  const auto parsed = parse_expression(expression, registry_);
  return parsed ? to_nested(**parsed).print() : "(+ 1 2)";
}

std::string QueryGrammar::command(Dice& dice) {
  switch (dice.below(12)) {
    case 0:
    case 1:
      return "query " + example(dice);
    case 2:
    case 3:
      return object_command(dice);
    case 4:
      return other_command(dice);
    case 5:
      return dice.one_in(2) ? "(query " + nested(query(dice)) + ")" : "explain " + query(dice);
    default:
      return "query " + query(dice);
  }
}

std::string QueryGrammar::object_command(Dice& dice) {
  const std::string object = dice.of(names_);
  switch (dice.below(12)) {
    case 0:
      return "let_ " + name(dice) + " = " + query(dice);
    case 1:
      return "derive " + name(dice) + " = " + query(dice);
    case 2:
    case 3:
      return "update " + object + " := " + value(dice, objects_.at(object), {}, kDepth);
    case 4:
      return (dice.one_in(2) ? "delete " : "kill ") + object;
    case 5:
      return "changename " + object + " to " + name(dice);
    case 6:
      return "create " + name(dice) + " : " + type(dice, 2);
    case 7:
      return dice.one_in(3) ? "delete type pair" : "type " + name(dice) + " = " + type(dice, 2);
    case 8:
      return "let " + name(dice) + " = fun(a: int, b: " + type(dice, 1) + ") " +
             value(dice, simple_type(dice), {{"a", "int"}}, 2);
    case 9:
      return "query inc(" + value(dice, "int", {}, 2) + ")";
    default:
      return "let " + name(dice) + " = " + query(dice);
  }
}

std::string QueryGrammar::other_command(Dice& dice) {
  switch (dice.below(14)) {
    case 0:
      return dice.one_in(2) ? "close database" : "open database w";
    case 1:
      return "save database to " + dice.of(kFiles);
    case 2:
      return "restore database w from " + dice.of(kFiles);
    case 3:
      return "save " + dice.of(names_) + " to " + dice.of(kFiles);
    case 4:
      return "restore " + name(dice) + " from " + dice.of(kFiles);
    case 5:
      return "list " + dice.of(kInquiries);
    case 6:
      return "if " + value(dice, "bool", {}, 2) + " then " + command(dice) + " else " + command(dice) + " endif";
    case 7:
      return "{ " + command(dice) + " | " + command(dice) + " }";
    case 8:
      return "{{ " + command(dice) + " | " + command(dice) + " }}";
    case 9:
      return "set \"memory\" = " + dice.of(kIntegers);
    case 10:
      return "while n < " + std::to_string(dice.below(12)) + " do { update n := n + 1 | " + command(dice) +
             " } endwhile";
    default:
      return dice.of(std::vector<std::string>{"begin transaction", "begin transaction", "commit transaction",
                                              "abort transaction", "abort transaction", "check database"});
  }
}

}  // namespace queries::fuzz
