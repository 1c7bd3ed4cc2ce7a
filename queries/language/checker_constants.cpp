// The part of the checker that makes constants and resolves types.
#include <algorithm>

#include "algebra3d/values/types/nested_relation.h"
#include "algebra3d/values/types/utf8.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/list_pieces.h"
#include "queries/streams/relation.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;

/// Positions from a list inwards, to an element.
using Path = std::vector<std::size_t>;

// The place of an element in the text of a constant; that of the whole constant if the text is not known.
SourcePlace place_of_element(const TypedLiteral& literal, const Path& path, const SourcePlace& whole) {
  if (literal.written == nullptr) return whole;
  const std::string_view text = *literal.written;
  std::string_view element = text;
  const std::size_t first = element.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos) element.remove_prefix(first);
  for (const std::size_t position : path) {
    ListPieces pieces(element, "");
    if (!pieces.enter()) break;
    std::optional<std::string_view> next;
    for (std::size_t i = 0; i <= position; ++i) {
      const auto piece = pieces.next();
      if (!piece || !*piece) return whole;
      next = *piece;
    }
    element = *next;
  }
  const auto offset = static_cast<std::size_t>(element.data() - text.data());
  return algebra3d::place_behind(text.substr(0, offset), literal.list_place);
}

bool is_numeric_atom(const NestedList& atom) {
  const bool is_fraction = atom.is_symbol() && atom.as_symbol().find('/') != std::string::npos;
  return atom.is_int() || atom.is_real() || is_fraction;
}

// The first atom among numbers that is not a number; empty if there is none. Recursion follows the nesting, which the
// parser of lists bounds. NOLINTNEXTLINE(misc-no-recursion)
Path odd_one_out(const NestedList& list) {
  if (!list.is_list()) return {};
  const auto& elements = list.elements();
  const auto odd =
      std::ranges::find_if(elements, [](const NestedList& e) { return !e.is_list() && !is_numeric_atom(e); });
  if (odd != elements.end() && std::ranges::any_of(elements, is_numeric_atom))
    return {static_cast<std::size_t>(odd - elements.begin())};
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (Path below = odd_one_out(elements[i]); !below.empty()) {
      below.insert(below.begin(), i);
      return below;
    }
  return {};
}

// Where in a list that is not a value of the type the first wrong element stands, as far as that can be found: an atom
// that is not a number among numbers, or else an element that is not a value alone either.
Path wrong_element(const algebra3d::Type& type, const NestedList& list, const Context& surroundings) {
  if (Path odd = odd_one_out(list); !odd.empty()) return odd;
  if (!list.is_list() || list.elements().size() < 2) return {};
  algebra3d::Diagnostics unheard;
  Context context = surroundings.with(unheard);
  const auto is_list_alone = [&](const NestedList& element) {
    return element.is_list() && value_from_nested(type, NestedList::list(element), context).ok();
  };
  const auto& elements = list.elements();
  if (std::ranges::none_of(elements, is_list_alone)) return {};
  const auto wrong = std::ranges::find_if_not(elements, is_list_alone);
  return wrong == elements.end() ? Path() : Path{static_cast<std::size_t>(wrong - elements.begin())};
}

}  // namespace

Result<TypedPtr> Checker::constant(const TypeExpr& type, const TypedLiteral& literal, const SourcePlace& place) {
  const NestedList& list = literal.list;
  if (type.is_relation()) {
    A3D_ASSIGN(Datum relation, relation_constant(type, literal, place));
    return make_constant(type, std::move(relation), place);
  }
  const algebra3d::Type* value_type = registry_.value_type(type);
  if (value_type == nullptr)
    return Error(ErrorCode::type_error, "a constant cannot be of type {}", type.text()).at(place);
  auto value = algebra3d::value_from_nested(*value_type, list, context_);
  if (!value)
    return std::move(value).error().at(place_of_element(literal, wrong_element(*value_type, list, context_), place));
  return make_constant(type, Datum{std::move(value).value()}, place);
}

Result<Datum> Checker::relation_constant(const TypeExpr& type, const TypedLiteral& literal, const SourcePlace& place) {
  const NestedList& list = literal.list;
  const auto& attributes = type.element().attributes();
  if (!list.is_list())
    return Error(ErrorCode::invalid_value, "rel: expected a list of tuples, got {}", list.print_short())
        .at(place_of_element(literal, {}, place));
  std::vector<TuplePtr> tuples;
  for (const NestedList& row : list.elements()) {
    if (!row.is_list() || row.elements().size() != attributes.size())
      return Error(ErrorCode::invalid_value, "rel: tuple {}: expected a list of {} values, got {}", tuples.size() + 1,
                   attributes.size(), row.print_short())
          .at(place_of_element(literal, {tuples.size()}, place));
    Tuple tuple;
    for (std::size_t index = 0; index < attributes.size(); ++index) {
      const algebra3d::Type* attribute_type = registry_.value_type(attributes[index].type);
      auto value = algebra3d::value_from_nested(*attribute_type, row.elements()[index], context_);
      if (!value) {
        Error error = std::move(value).error().about(
            fmt::format("rel: tuple {}, attribute {}", tuples.size() + 1, attributes[index].name));
        Path path = wrong_element(*attribute_type, row.elements()[index], context_);
        path.insert(path.begin(), {tuples.size(), index});
        return std::move(error).at(place_of_element(literal, path, place));
      }
      tuple.attributes.push_back(std::move(value).value());
    }
    tuples.push_back(std::make_shared<const Tuple>(std::move(tuple)));
  }
  return Datum{
      std::shared_ptr<Relation>(std::make_shared<MemoryRelation>(type.element(), TupleBuffer(std::move(tuples))))};
}

Result<TypeExpr> Checker::resolve(const TypeSyntax& syntax) {
  if (syntax.type_of != nullptr) {
    A3D_ASSIGN(const TypedPtr node, check(*syntax.type_of));
    return node->type();
  }
  if (!syntax.attributes.empty()) {
    std::vector<TypeExpr::Attribute> attributes;
    for (const auto& [name, attribute] : syntax.attributes) {
      for (const TypeExpr::Attribute& earlier : attributes)
        if (earlier.name == name)
          return Error(ErrorCode::type_error, "tuple: duplicate attribute name '{}'; rename one of them", name)
              .at(syntax.place);
      A3D_ASSIGN(TypeExpr type, resolve(attribute));
      if (registry_.value_type(type) == nullptr)
        return Error(ErrorCode::type_error, "tuple: attribute '{}': expected a type of kind DATA, got {}{}", name,
                     type.text(), type.is_relation() ? "; a relation in a tuple is an arel" : "")
            .at(syntax.place);
      attributes.push_back({name, std::move(type)});
    }
    return TypeExpr::tuple(std::move(attributes));
  }
  std::vector<TypeExpr> arguments;
  for (const TypeSyntax& argument : syntax.arguments) {
    A3D_ASSIGN(TypeExpr type, resolve(argument));
    arguments.push_back(std::move(type));
  }
  TypeExpr type(syntax.name, std::move(arguments));
  if (type.arguments().empty() && registry_.find_type(type.name()) == nullptr) {
    A3D_ASSIGN(const auto named, objects_.named_type(type.name()));
    if (named) return *named;
    // SECONDO's name for ints of 64 bits.
    if (type.is("longint")) return TypeExpr("int");
  }
  A3D_TRY(check_type_name(type, syntax.place));
  return type;
}

Status Checker::check_type_name(const TypeExpr& type, const SourcePlace& place) {
  if (type.is_relation() || type.is_stream() || type.is_function()) return {};
  if (registry_.value_type(type) != nullptr) return {};
  if (type.is_nested_relation()) {
    const auto nested = algebra3d::NestedRelationType::of(type.element());
    return nested ? Status() : Status(Error(nested.error()).at(place));
  }
  std::vector<std::string> names = {"rel", "arel", "tuple", "stream", "map"};
  for (const algebra3d::Type* known : registry_.types()) names.emplace_back(known->name());
  const std::string suggestion = algebra3d::nearest_name(type.name(), names);
  return Error(ErrorCode::unknown_name, "unknown type '{}'{}", type.text(),
               suggestion.empty() || suggestion == type.name() ? "" : ", did you mean '" + suggestion + "'?")
      .at(place);
}

}  // namespace queries
