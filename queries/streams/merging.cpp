// concat, mergesec, mergediff, mergeunion: two streams of one type become one.
#include <algorithm>
#include <optional>

#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/detail/sorting.h"

namespace queries {
namespace {

/// The type that the elements of two streams become; of tuples with the names of the first.
struct CommonElement {
  TypeExpr type;
  std::vector<Conversion> first, second;  // of each attribute, or of the value
};

/// The types of the attributes, or that of the value.
std::vector<TypeExpr> types_within(const TypeExpr& element) {
  if (!element.is_tuple()) return {element};
  std::vector<TypeExpr> types;
  for (const auto& attribute : element.attributes()) types.push_back(attribute.type);
  return types;
}

// Strings beside texts become texts.
std::optional<CommonElement> common_element(const TypeExpr& first, const TypeExpr& second) {
  std::vector<TypeExpr> left = types_within(first);
  const std::vector<TypeExpr> right = types_within(second);
  if (first.is_tuple() != second.is_tuple() || left.size() != right.size()) return std::nullopt;
  CommonElement common;
  std::vector<TypeExpr::Attribute> attributes;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!are_comparable(left[i], right[i])) return std::nullopt;
    const TypeExpr type = left[i] == right[i] ? left[i] : TypeExpr("text");
    common.first.push_back(*conversion_to(type, left[i]));
    common.second.push_back(*conversion_to(type, right[i]));
    if (first.is_tuple()) attributes.push_back({first.attributes()[i].name, type});
    left[i] = type;
  }
  common.type = first.is_tuple() ? TypeExpr::tuple(std::move(attributes)) : left.front();
  return common;
}

Result<CommonElement> common_element(const MappingCheck& check) {
  A3D_ASSIGN(const TypeExpr first, check.any_stream(0));
  A3D_ASSIGN(const TypeExpr second, check.any_stream(1));
  if (auto common = common_element(first, second)) return *std::move(common);
  return check.error("expected two streams with elements of the same types, got " + first.text() + " and " +
                     second.text());
}

Result<TuplePtr> element_as(const std::vector<Conversion>& conversions, const TuplePtr& from) {
  Tuple tuple;
  tuple.attributes.reserve(from->attributes.size());
  for (std::size_t i = 0; i < conversions.size(); ++i) {
    A3D_ASSIGN(Value value, loaded_as(from->attributes[i], conversions[i]));
    tuple.attributes.push_back(std::move(value));
  }
  return std::make_shared<const Tuple>(std::move(tuple));
}

Result<std::optional<Value>> element_as(const std::vector<Conversion>& conversions, const std::optional<Value>& from) {
  A3D_ASSIGN(Value value, loaded_as(*from, conversions.front()));
  return std::optional(std::move(value));
}

template <typename Stream>
std::shared_ptr<Stream> stream_as(const std::vector<Conversion>& conversions, const std::shared_ptr<Stream>& stream) {
  if (std::ranges::all_of(conversions, [](Conversion conversion) { return conversion == nullptr; })) return stream;
  return make_stream_of<Stream>([conversions, stream]() -> Result<ElementOf<Stream>> {
    A3D_ASSIGN(ElementOf<Stream> element, stream->next());
    if (!element) return element;
    return element_as(conversions, element);
  });
}

// A mapping in which `merge(first, second, context)` gives the stream for two of the same kind.
template <typename Merge>
TypeMapping merging(const char* op, Merge merge) {
  return [op, merge](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check(op, arguments);
    A3D_ASSIGN(const CommonElement common, common_element(check));
    return BoundOperator{
        TypeExpr::stream(common.type), [merge, common](std::vector<Datum> given, Context& context) -> Result<Datum> {
          return visit_stream(given[0], [&]<typename Stream>(const std::shared_ptr<Stream>& first) {
            const auto& second = std::get<std::shared_ptr<Stream>>(given[1].content);
            return Result<Datum>(
                Datum{merge(stream_as(common.first, first), stream_as(common.second, second), context)});
          });
        }};
  };
}

struct Concatenation {
  template <typename Stream>
  std::shared_ptr<Stream> operator()(const std::shared_ptr<Stream>& first, const std::shared_ptr<Stream>& second,
                                     const Context&) const {
    return one_after_the_other(first, second);
  }
};

/// One of the streams, proved to be sorted and free of duplicates.
template <typename Stream>
class AscendingStream {
 public:
  AscendingStream(std::shared_ptr<Stream> stream, std::string unsorted)
      : stream_(std::move(stream)), unsorted_(std::move(unsorted)) {}

  Status advance() {
    std::vector<Value> last = std::move(keys_);
    keys_.clear();
    const bool has_last = static_cast<bool>(current_);
    A3D_ASSIGN(current_, stream_->next());
    if (!current_) return {};
    A3D_ASSIGN(keys_, loaded_values(current_));
    if (has_last && compare_keys(last, keys_) >= 0) return Error{ErrorCode::wrong_usage, unsorted_};
    return {};
  }
  const ElementOf<Stream>& current() const { return current_; }
  const std::vector<Value>& keys() const { return keys_; }

 private:
  std::shared_ptr<Stream> stream_;
  std::string unsorted_;
  ElementOf<Stream> current_;
  std::vector<Value> keys_;
};

/// Which elements a set operation keeps.
struct MergeRule {
  const char* name;
  bool keeps_first;   ///< what only the first stream has
  bool keeps_both;    ///< what both have
  bool keeps_second;  ///< what only the second has
};

std::string unsorted(const MergeRule& rule, const char* which) {
  return fmt::format("{}: the {} stream is not sorted and free of duplicates; write `sort rdup`", rule.name, which);
}

template <typename Stream>
class Merge {
 public:
  Merge(const std::shared_ptr<Stream>& first, const std::shared_ptr<Stream>& second, MergeRule rule,
        const Context& context)
      : first_(first, unsorted(rule, "first")),
        second_(second, unsorted(rule, "second")),
        rule_(rule),
        context_(context) {}

  Result<ElementOf<Stream>> next() {
    if (!has_begun_) {
      has_begun_ = true;
      A3D_TRY(first_.advance());
      A3D_TRY(second_.advance());
    }
    while (first_.current() || second_.current()) {
      if (++steps_ % 1024 == 0) A3D_TRY(context_.check_cancelled());
      const auto order = !second_.current()  ? std::strong_ordering::less
                         : !first_.current() ? std::strong_ordering::greater
                                             : compare_keys(first_.keys(), second_.keys());
      const ElementOf<Stream> element = order <= 0 ? first_.current() : second_.current();
      if (order <= 0) A3D_TRY(first_.advance());
      if (order >= 0) A3D_TRY(second_.advance());
      if (order < 0 ? rule_.keeps_first : order > 0 ? rule_.keeps_second : rule_.keeps_both) return element;
    }
    return ElementOf<Stream>();
  }

 private:
  AscendingStream<Stream> first_;
  AscendingStream<Stream> second_;
  MergeRule rule_;
  const Context& context_;
  bool has_begun_ = false;
  std::uint32_t steps_ = 0;
};

TypeMapping map_merge(MergeRule rule) {
  return merging(rule.name, [rule]<typename Stream>(const std::shared_ptr<Stream>& first,
                                                    const std::shared_ptr<Stream>& second, const Context& context) {
    return make_stream_of<Stream>(
        [merge = Merge<Stream>(first, second, rule, context)]() mutable { return merge.next(); });
  });
}

struct MergeTexts {
  MergeRule rule;
  const char* doc;
  const char* example;  ///< result for (1 2 3) and (2 3 4)
};

constexpr MergeTexts kMerges[] = {
    {{"mergesec", false, true, false}, "The intersection of two sorted streams without duplicates.", "((2) (3))"},
    {{"mergediff", true, false, false},
     "The elements of the first of two sorted streams without duplicates that are not in the second.",
     "((1))"},
    {{"mergeunion", true, true, true}, "The union of two sorted streams without duplicates.", "((1) (2) (3) (4))"}};

}  // namespace

void register_merging(algebra3d::OperatorGroup& group) {
  const std::string ints = "intstream(1, 3) transformstream intstream(2, 4) transformstream ";
  group.add({
      .name = "concat",
      .syntax = "_ _ concat",
      .doc = "The elements of the first stream, then those of the second.",
      .detail = "Both have elements of the same types, except that strings with texts become texts; the attributes "
                "have the names of the first.",
      .stream = stream_operator(merging("concat", Concatenation())),
      .signatures = {"(stream(tuple) stream(tuple)) -> stream(tuple)", "(stream(DATA) stream(DATA)) -> stream(DATA)"},
      .handles_undefined = true,
      .query_examples = {{"intstream(1, 2) transformstream [const int value undefined] feed namedtransformstream[B] "
                          "concat consume",
                          "((1) (2) (undefined))"},
                         {"intstream(1, 2) intstream(1, 3) concat count", "5"}},
      .query_errors = {{"query intstream(1, 2) \"a\" feed concat count",
                        "concat: expected two streams with elements of the same types, got int and string"},
                       {"query 5 intstream(1, 2) concat count", "concat: expected a stream, got int"}},
  });
  for (const MergeTexts& texts : kMerges) {
    const std::string name = texts.rule.name;
    group.add({
        .name = name,
        .syntax = "_ _ " + name,
        .doc = texts.doc,
        .detail = "Both must be sorted ascending by all attributes, as by `sort rdup`; else it is an error. "
                  "Undefined equals undefined. The attributes have the names of the first.",
        .stream = stream_operator(map_merge(texts.rule)),
        .signatures = {"(stream(tuple) stream(tuple)) -> stream(tuple)", "(stream(DATA) stream(DATA)) -> stream(DATA)"},
        .handles_undefined = true,
        .query_examples = {{ints + name + " consume", texts.example}},
        .query_errors = {{"query intstream(1, 2) transformstream sortby[Elem desc] intstream(1, 2) transformstream " +
                              name + " count",
                          name + ": the first stream is not sorted and free of duplicates; write `sort rdup`"},
                         {"query intstream(1, 2) \"a\" feed " + name + " count",
                          name + ": expected two streams with elements of the same types, got int and string"}},
    });
  }
}

}  // namespace queries
