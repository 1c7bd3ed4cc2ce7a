// itSpatialJoin: pairs of tuples whose boxes meet.
#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "queries/streams/relation.h"
#include "queries/streams/spatial_attribute.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

/// The boxes of an attribute, with the positions of their tuples.
std::vector<Entry> entries_of(const std::vector<TuplePtr>& tuples, std::size_t attribute) {
  std::vector<Entry> entries;
  entries.reserve(tuples.size());
  for (std::size_t position = 0; position < tuples.size(); ++position) {
    const Box3 box = window_of(tuples[position]->attributes[attribute]);
    if (!box.is_empty()) entries.push_back({box, position});
  }
  return entries;
}

// The tree is built on the first stream; the second one passes by, each tuple asking for its partners.
class SpatialJoin {
 public:
  SpatialJoin(std::vector<TuplePtr> first, std::size_t first_key, TupleStreamPtr second, std::size_t second_key)
      : first_(std::move(first)),
        tree_(Tree::bulk_load(entries_of(first_, first_key))),
        second_(std::move(second)),
        second_key_(second_key) {}

  Result<TuplePtr> next(const Context& context) {
    while (position_ == partners_.size()) {
      if (++steps_ % 256 == 0) RETURN_IF_ERROR(context.check_cancelled());
      ASSIGN_OR_RETURN(current_, second_->next());
      if (current_ == nullptr) return TuplePtr();
      partners_ = ids_in_window(tree_, window_of(current_->attributes[second_key_]));
      position_ = 0;
    }
    return concatenated(*first_[partners_[position_++]], *current_);
  }

 private:
  std::vector<TuplePtr> first_;
  Tree tree_;
  TupleStreamPtr second_;
  std::size_t second_key_;
  TuplePtr current_;
  std::vector<std::uint64_t> partners_;
  std::size_t position_ = 0;
  std::uint32_t steps_ = 0;
};

TypeMapping map_spatial_join(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<Plan> {
    const MappingCheck check("itSpatialJoin", arguments);
    ASSIGN_OR_RETURN(const TypeExpr left, check.stream(0));
    ASSIGN_OR_RETURN(const TypeExpr right, check.stream(1));
    RETURN_IF_ERROR(check.argument_count(4, 7));
    for (std::size_t place = 4; place < check.count(); ++place) RETURN_IF_ERROR(check.type(place, "int"));
    ASSIGN_OR_RETURN(const std::size_t left_key, spatial_attribute(registry, check, 2, left));
    ASSIGN_OR_RETURN(const std::size_t right_key, spatial_attribute(registry, check, 3, right));
    ASSIGN_OR_RETURN(const TypeExpr joined, check.concatenated(left, right));
    return Plan{TypeExpr::stream(joined), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                  ASSIGN_OR_RETURN(auto first, materialise(*given[0].tuples(), context));
                  auto join = std::make_shared<SpatialJoin>(std::move(first), left_key, given[1].tuples(), right_key);
                  return Datum{make_stream([join, &context]() { return join->next(context); })};
                }};
  };
}

constexpr std::string_view kTwoBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))] feed ";

}  // namespace

void register_spatial_join(algebra3d::Registry& registry) {
  const std::string boxes(kTwoBoxes);
  registry.add({
      .name = "itSpatialJoin",
      .syntax = "_ _ itSpatialJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams whose boxes meet, in the order of the second stream.",
      .detail = "The first stream is held in memory with an R-tree over it. Touching counts. Up to three ints (node "
                "sizes and "
                "memory) are accepted and not needed.",
      .stream = stream_operator(map_spatial_join(registry)),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{boxes + "{a} " + boxes + "{b} itSpatialJoin[B_a, B_b] project[No_a, No_b] consume",
                    "((1 1) (2 2))"}},
      .errors = {{"query " + boxes + boxes + "itSpatialJoin[B, B] count",
                  "itSpatialJoin: the attribute 'No' would stand twice"},
                 {"query " + boxes + "{a} " + boxes + "{b} itSpatialJoin[No_a, B_b] count",
                  "itSpatialJoin: expected an attribute of kind SPATIAL3D, got int"}},
  });
}

}  // namespace queries
