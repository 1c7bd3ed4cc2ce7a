// itSpatialJoin: pairs of tuples whose boxes meet.
#include "algebra3d/registry/operator.h"
#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/spatial_attribute.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Box3;
using Tree = SpatialIndex::Tree;
using Entry = rtree::Entry<std::uint64_t>;

/// Tuples with an R-tree over the boxes of one attribute: the table of a BlockJoin.
class BoxTable {
 public:
  /// Attribute numbers: `key` of the tuples in the tree, `probe` of those that look them up.
  BoxTable(std::size_t key, std::size_t probe, const Context& context)
      : key_(key), probe_(probe), account_(context.memory) {}

  Result<bool> add(const TuplePtr& tuple) {
    const Box3 box = window_of(tuple->attributes[key_]);
    if (box.is_empty()) return true;
    // An entry stands once in the list and once, or nearly so, in the tree.
    if (!account_.take(heap_bytes(*tuple) + sizeof(TuplePtr) + 3 * sizeof(Entry)) && !tuples_.empty()) return false;
    entries_.push_back({box, tuples_.size()});
    tuples_.push_back(tuple);
    return true;
  }
  void finish() { tree_ = Tree::bulk_load(std::exchange(entries_, {})); }
  Status find(const Tuple& probe, std::vector<TuplePtr>& found) const {
    for (const std::uint64_t position : ids_in_window(tree_, window_of(probe.attributes[probe_])))
      found.push_back(tuples_[position]);
    return {};
  }
  void clear() {
    tuples_.clear();
    tree_ = Tree();
    account_.clear();
  }

 private:
  std::size_t key_;
  std::size_t probe_;
  algebra3d::MemoryAccount account_;
  std::vector<TuplePtr> tuples_;
  std::vector<Entry> entries_;
  Tree tree_;
};

TypeMapping map_spatial_join(const algebra3d::Registry& registry) {
  return [&registry](std::span<const ArgumentType> arguments) -> Result<BoundOperator> {
    const MappingCheck check("itSpatialJoin", arguments);
    ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr left, check.stream(0));
    ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr right, check.stream(1));
    ALGEBRA3D_RETURN_IF_ERROR(check.argument_count(4, 7));
    for (std::size_t place = 4; place < check.count(); ++place) ALGEBRA3D_RETURN_IF_ERROR(check.type(place, "int"));
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t left_key, spatial_attribute(registry, check, 2, left));
    ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t right_key, spatial_attribute(registry, check, 3, right));
    ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr joined, check.concatenated(left, right));
    return BoundOperator{TypeExpr::stream(joined), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                           const auto combine = [](const Tuple& build, const Tuple& probe) {
                             return concatenated(build, probe);
                           };
                           return Datum{block_join(given[0].tuples(), given[1].tuples(),
                                                   BoxTable(left_key, right_key, context), combine, context)};
                         }};
  };
}

constexpr std::string_view kJoinedBoxes =
    "[const rel(tuple([No: int, B: rect3])) value ((1 (0 1 0 1 0 1)) (2 (5 6 0 1 0 1)) (3 undefined))] feed ";

}  // namespace

void register_spatial_join(algebra3d::Registry& registry) {
  const std::string boxes(kJoinedBoxes);
  registry.add({
      .name = "itSpatialJoin",
      .syntax = "_ _ itSpatialJoin[attribute, attribute ...]",
      .doc = "The pairs of tuples of both streams whose boxes meet, in the order of the second stream.",
      .detail =
          "The first stream is held in memory with an R-tree over it, part by part if it does not fit into the "
          "memory of `set \"memory\"`. Touching counts. Up to three ints (node sizes and memory) are accepted and "
          "not needed.",
      .cost = algebra3d::Cost::sorting,
      .stream = stream_operator(map_spatial_join(registry)),
      .signatures = {"(stream(tuple) stream(tuple) NAME NAME) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{boxes + "{a} " + boxes + "{b} itSpatialJoin[B_a, B_b] project[No_a, No_b] consume",
                          "((1 1) (2 2))"}},
      .query_errors = {{"query " + boxes + boxes + "itSpatialJoin[B, B] count",
                        "itSpatialJoin: duplicate attribute name 'No'"},
                       {"query " + boxes + "{a} " + boxes + "{b} itSpatialJoin[No_a, B_b] count",
                        "itSpatialJoin: expected an attribute of kind SPATIAL2D or SPATIAL3D, got int"}},
  });
}

}  // namespace queries
