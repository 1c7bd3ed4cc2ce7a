// collect_set, collect_multiset, collect_vector: all values of a stream as one value.
#include "queries/streams/collection.h"

#include <algorithm>

#include "algebra3d/values/types/described_type.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/detail/kept_elements.h"

namespace queries {
namespace {

using algebra3d::NestedList;

class CollectionType final : public algebra3d::DescribedType {
 public:
  CollectionType()
      : DescribedType({.name = "collection",
                       .doc = "A set, multiset or vector of values of one type.",
                       .notation = "(element*)",
                       .example = "()",
                       .kinds = {}}) {}

  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    return expected("a stream that is collected; a collection has no constants", list);
  }
  NestedList to_nested(const Value& value) const override {
    NestedList::List list;
    for (const Value& element : value.get<Collection>().elements) list.push_back(element.to_nested());
    return NestedList(std::move(list));
  }
  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto is_less = [](const Value& x, const Value& y) { return algebra3d::compare(x, y) < 0; };
    const auto& first = a.get<Collection>().elements;
    const auto& second = b.get<Collection>().elements;
    if (std::ranges::lexicographical_compare(first, second, is_less)) return std::strong_ordering::less;
    if (std::ranges::lexicographical_compare(second, first, is_less)) return std::strong_ordering::greater;
    return std::strong_ordering::equal;
  }
  std::size_t hash(const Value& value) const override {
    std::size_t code = 0;
    for (const Value& element : value.get<Collection>().elements)
      code = algebra3d::combine_hashes(code, algebra3d::hash(element));
    return code;
  }
  std::size_t heap_bytes(const Value& value) const override {
    std::size_t result = algebra3d::object_bytes<Collection>();
    for (const Value& element : value.get<Collection>().elements)
      result += sizeof(Value) + algebra3d::heap_bytes(element);
    return result;
  }
  void encode(const Value& /*value*/, std::string& /*bytes*/) const override {}
  Result<Value> decode(std::string_view /*bytes*/, bool /*trusted*/) const override {
    return corrupt("collections are not stored");
  }
};

bool is_before(const Value& a, const Value& b) {
  return compare(a, b) < 0;
}
bool is_equal(const Value& a, const Value& b) {
  return compare(a, b) == 0;
}

enum class CollectionKind : std::uint8_t { set, multiset, vector };

// A collection is a value, which stands in memory as long as the statement needs it; while it is made it is bounded.
Result<Value> collected(ValueStream& values, CollectionKind kind, const std::string& op, const Context& context) {
  KeptElements<ValueStream> kept(op, context);
  A3D_TRY(for_each_element(values, context, [&](const std::optional<Value>& value) -> Status {
    A3D_ASSIGN(Value loaded, value->loaded());
    return kept.add(std::move(loaded));
  }));
  Collection collection;
  for (auto& element : kept.elements()) collection.elements.push_back(*std::move(element));
  if (kind != CollectionKind::vector) std::ranges::stable_sort(collection.elements, is_before);
  if (kind == CollectionKind::set) {
    const auto rest = std::unique(collection.elements.begin(), collection.elements.end(), is_equal);
    collection.elements.erase(rest, collection.elements.end());
  }
  return Value::of(std::move(collection));
}

struct CollectionTexts {
  CollectionKind kind;
  const char* type;
  const char* doc;
  const char* example;  ///< result for (3 1 3)
};

constexpr CollectionTexts kCollections[] = {
    {CollectionKind::set, "set", "The set of the values of a stream, ascending.", "(1 3)"},
    {CollectionKind::multiset, "multiset", "The multiset of the values of a stream, ascending.", "(1 3 3)"},
    {CollectionKind::vector, "vector", "The vector of the values of a stream, in their order.", "(3 1 3)"}};

TypeMapping map_collect(const CollectionTexts& texts) {
  return [texts](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(std::string("collect_") + texts.type, arguments);
    const TypeExpr& type = check[0].type;
    if (!type.is_stream() || !is_value_type(type.element()))
      return check.expected("a stream of values (see projecttransformstream)", type);
    return BoundOperator{TypeExpr(texts.type, {type.element()}),
                         [texts](std::vector<Datum> given, Context& context) -> Result<Datum> {
                           const std::string op = std::string("collect_") + texts.type;
                           A3D_ASSIGN(Value value, collected(*given[0].values(), texts.kind, op, context));
                           return Datum{std::move(value)};
                         }};
  };
}

}  // namespace

bool is_collection(const TypeExpr& type) {
  return type.arguments().size() == 1 && (type.is("set") || type.is("multiset") || type.is("vector"));
}

ValueStreamPtr elements_of(const Value& collection) {
  return make_value_stream([collection, position = std::size_t{0}]() mutable -> Result<std::optional<Value>> {
    const auto& elements = collection.get<Collection>().elements;
    return position == elements.size() ? std::optional<Value>() : std::optional(elements[position++]);
  });
}

void register_collections(algebra3d::OperatorGroup& group) {
  for (const CollectionTexts& texts : kCollections) {
    const std::string name = std::string("collect_") + texts.type;
    group.add({
        .name = name,
        .syntax = "_ " + name,
        .doc = texts.doc,
        .detail = "It can be shown, counted and fed into a stream, but not stored. Undefined values are elements; "
                  "they come first and are equal.",
        .stream = stream_operator(map_collect(texts)),
        .signatures = {std::string("(stream(DATA)) -> ") + texts.type + "(DATA)"},
        .handles_undefined = true,
        .query_examples = {{"[const rel(tuple([A: int])) value ((3) (1) (3))] feed projecttransformstream[A] " + name,
                            texts.example},
                           {"[const int value undefined] feed " + name, "(undefined)"},
                           {"intstream(1, 0) " + name, "()"},
                           {"intstream(1, 4) " + name + " count", "4"},
                           {"intstream(1, 4) " + name + " feed transformstream sum[Elem]", "10"}},
        .query_errors = {{"query intstream(1, 3) transformstream " + name,
                          name + ": expected a stream of values (see projecttransformstream), got (stream (tuple"}},
    });
  }
}

}  // namespace queries

const algebra3d::Type& algebra3d::TypeOf<queries::Collection>::type() {
  static const queries::CollectionType the_type;
  return the_type;
}
