#include "algebra3d/values/types/nested_relation.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/binary_io.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

// A flag and the length of an encoded value.
constexpr std::size_t kLeastValueBytes = 1;

std::strong_ordering compare_tuples(std::span<const Value> a, std::span<const Value> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const auto order = compare(a[i], b[i]); order != 0) return order;
  return std::strong_ordering::equal;
}

std::size_t hash_of_tuple(std::span<const Value> tuple) {
  std::size_t code = 0;
  for (const Value& value : tuple) code = combine_hashes(code, hash(value));
  return code;
}

/// All types of nested relations that this process has met, by their terms.
class KnownTypes {
 public:
  /// The type of that term, made by `make` if it is new.
  template <typename Make>
  const NestedRelationType& find(const TypeExpr& term, Make make) {
    const std::lock_guard lock(mutex_);
    auto& type = types_[term.text()];
    if (type == nullptr) type = make();
    return *type;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, const NestedRelationType*, std::less<>> types_;
};

// Never destroyed: values may live as long as the process.
KnownTypes& known_types() {
  static KnownTypes& types = *new KnownTypes();
  return types;
}

}  // namespace

NestedRelation::NestedRelation(std::size_t width, std::vector<Value> values) : content_(std::make_shared<Content>()) {
  assert(width > 0 && values.size() % width == 0);
  Content& content = *content_;
  content.width = width;
  content.size = values.size() / width;
  content.values = std::move(values);
  content.heap_bytes = object_bytes<Content>() + content.values.capacity() * sizeof(Value) +
                       content.size * sizeof(std::size_t);  // of the order
  for (const Value& value : content.values) content.heap_bytes += algebra3d::heap_bytes(value);
}

const std::vector<std::size_t>& NestedRelation::ascending() const {
  Content& content = *content_;
  std::call_once(content.is_sorted, [&] {
    content.ascending.resize(content.size);
    std::iota(content.ascending.begin(), content.ascending.end(), std::size_t{0});
    std::ranges::stable_sort(content.ascending,
                             [&](std::size_t a, std::size_t b) { return compare_tuples(tuple(a), tuple(b)) < 0; });
  });
  return content.ascending;
}

NestedRelationType::NestedRelationType(TypeExpr term, std::vector<Attribute> attributes, std::size_t depth)
    : DescribedType({.name = "arel",
                     .doc = "A relation as the value of an attribute.",
                     .notation = "((value*)*)",
                     .example = "()",
                     .kinds = {Kind::data},
                     .is_large = true}),
      term_(std::move(term)),
      attributes_(std::move(attributes)),
      depth_(depth) {}

Result<const NestedRelationType*> NestedRelationType::of(const TypeExpr& tuple) {
  std::vector<Attribute> attributes;
  std::size_t depth = 1;
  if (!tuple.is_tuple() || tuple.attributes().empty())
    return Error{ErrorCode::type_error, "arel: expected a tuple type with attributes, got {}", tuple.text()};
  for (const auto& [name, type] : tuple.attributes()) {
    const Type* known = nullptr;
    if (type.is_nested_relation()) {
      A3D_ASSIGN(const NestedRelationType* inner, of(type.element()));
      depth = std::max(depth, inner->depth() + 1);
      known = inner;
    } else {
      known = value_type(type);
    }
    if (known == nullptr) return Error{ErrorCode::type_error, "arel: an attribute cannot be of type {}", type.text()};
    attributes.push_back({name, known});
  }
  if (depth > kMaxDepth)
    return Error{ErrorCode::limit_exceeded, "arel: relations are nested more than {} deep", kMaxDepth};
  const TypeExpr term("arel", {tuple});
  return &known_types().find(term, [&] { return new NestedRelationType(term, std::move(attributes), depth); });
}

Result<Value> NestedRelationType::value_of(std::vector<Value> values) const {
  if (values.size() / attributes_.size() > kMaxTuples)
    return Error{ErrorCode::limit_exceeded, "arel: a nested relation has at most {} tuples", kMaxTuples};
  return Value::of(*this, NestedRelation(attributes_.size(), std::move(values)));
}

// The place of a value that cannot be read.
Error NestedRelationType::at(std::size_t value_index, Error error) const {
  return std::move(error).about(fmt::format("arel: tuple {}, attribute {}", value_index / attributes_.size() + 1,
                                            attributes_[value_index % attributes_.size()].name));
}

// Recursion, here and below, follows the nesting of the type, which is bounded.
Result<Value> NestedRelationType::from_nested(const NestedList& list, Context& context) const {
  constexpr std::size_t kTuplesBetweenChecks = 256;
  if (!list.is_list()) return expected("a list of tuples", list);
  std::vector<Value> values;
  values.reserve(list.elements().size() * attributes_.size());
  for (const NestedList& tuple : list.elements()) {
    const std::size_t number = values.size() / attributes_.size() + 1;
    if (number % kTuplesBetweenChecks == 0) A3D_TRY(context.check_cancelled());
    if (!tuple.is_list() || tuple.elements().size() != attributes_.size())
      return Error{ErrorCode::invalid_value, "arel: tuple {}: expected a list of {} values, got {}", number,
                   attributes_.size(), tuple.print_short()};
    for (std::size_t i = 0; i < attributes_.size(); ++i) {
      auto value = value_from_nested(*attributes_[i].type, tuple.elements()[i], context);
      if (!value) return at(values.size(), std::move(value).error());
      values.push_back(std::move(value).value());
    }
  }
  return value_of(std::move(values));
}

NestedList NestedRelationType::to_nested(const Value& value) const {
  const auto& relation = value.get<NestedRelation>();
  NestedList::List tuples;
  tuples.reserve(relation.size());
  for (std::size_t i = 0; i < relation.size(); ++i) {
    NestedList::List tuple;
    tuple.reserve(relation.width());
    for (const Value& attribute : relation.tuple(i)) tuple.push_back(attribute.to_nested());
    tuples.push_back(NestedList(std::move(tuple)));
  }
  return NestedList(std::move(tuples));
}

std::strong_ordering NestedRelationType::compare(const Value& a, const Value& b) const {
  const auto& first = a.get<NestedRelation>();
  const auto& second = b.get<NestedRelation>();
  if (first.size() != second.size()) return first.size() <=> second.size();
  for (std::size_t i = 0; i < first.size(); ++i)
    if (const auto order = compare_tuples(first.tuple(first.ascending()[i]), second.tuple(second.ascending()[i]));
        order != 0)
      return order;
  return std::strong_ordering::equal;
}

// The sum does not depend on the order of the tuples.
std::size_t NestedRelationType::hash(const Value& value) const {
  const auto& relation = value.get<NestedRelation>();
  std::size_t sum = relation.size();
  for (std::size_t i = 0; i < relation.size(); ++i) sum += hash_word(hash_of_tuple(relation.tuple(i)));
  return hash_word(sum);
}

std::size_t NestedRelationType::heap_bytes(const Value& value) const {
  return object_bytes<NestedRelation>() + value.get<NestedRelation>().heap_bytes();
}

GeometryHeader NestedRelationType::header(const Value& value) const {
  return {.box = {}, .size = static_cast<std::uint32_t>(value.get<NestedRelation>().size())};
}

void NestedRelationType::encode(const Value& value, std::string& bytes) const {
  const auto& relation = value.get<NestedRelation>();
  ByteWriter writer(bytes);
  writer.varint(relation.size());
  std::string body;
  for (std::size_t i = 0; i < relation.size(); ++i)
    for (const Value& attribute : relation.tuple(i)) {
      writer.u8(attribute.is_defined() ? 1 : 0);
      if (!attribute.is_defined()) continue;
      body.clear();
      attribute.type().encode(attribute, body);
      writer.text(body);
    }
}

Result<Value> NestedRelationType::decode(std::string_view bytes, bool trusted) const {
  ByteReader reader(bytes, name());
  const std::size_t value_count = reader.count(kLeastValueBytes * attributes_.size()) * attributes_.size();
  std::vector<Value> values;
  values.reserve(value_count);
  while (values.size() < value_count) {
    const Type& type = *attributes_[values.size() % attributes_.size()].type;
    const std::uint8_t flag = reader.u8();
    reader.require(flag <= 1, "0 or 1 for a value that is undefined or defined");
    const std::string_view body = flag == 1 ? reader.text() : std::string_view();
    A3D_TRY(reader.status());
    if (flag == 0) {
      values.emplace_back(type);
      continue;
    }
    auto value = type.decode(body, trusted);
    if (!value) return at(values.size(), std::move(value).error());
    values.push_back(std::move(value).value());
  }
  A3D_TRY(reader.finish());
  return value_of(std::move(values));
}

const NestedRelationType* as_nested_relation(const Type& type) {
  return dynamic_cast<const NestedRelationType*>(&type);
}

const Type* value_type(const TypeExpr& term) {
  static const auto plain_types = [] {
    std::map<std::string, const Type*, std::less<>> types;
    for (const Type* type : all_types()) types.emplace(type->name(), type);
    return types;
  }();
  if (term.is_nested_relation()) {
    const auto nested = NestedRelationType::of(term.element());
    return nested ? *nested : nullptr;
  }
  const auto found = term.arguments().empty() && !term.is_tuple() ? plain_types.find(term.name()) : plain_types.end();
  return found == plain_types.end() ? nullptr : found->second;
}

}  // namespace algebra3d
