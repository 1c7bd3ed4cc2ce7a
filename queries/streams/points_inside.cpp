// pointsInside: tuples whose point lies in a solid, many at a time.
#include <span>
#include <vector>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/spatial_relations/point_location.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/parallel_filter.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Placement;
using algebra3d::Point3d;
using algebra3d::PointRef;
using algebra3d::Volume3d;

/// The tuples whose point is in a solid. In batches where the stream before has them; else, and where it is pulled
/// tuple by tuple, blocks of tuples are located in parallel.
class TuplesInside final : public TupleStream {
 public:
  TuplesInside(TupleStreamPtr tuples, std::size_t attribute, const Value& solid, const Context& context)
      : tuples_(std::move(tuples)), attribute_(attribute), solid_(solid.get<Volume3d>()), context_(context) {
    constexpr std::size_t kLargestBlock = 16384;
    one_by_one_ = block_filter(
        tuples_, kLargestBlock,
        [this](std::span<const TuplePtr> block) -> Result<std::vector<bool>> { return are_inside(block); }, context);
  }

  Result<TuplePtr> next() override { return one_by_one_->next(); }
  bool has_batches() const override { return tuples_->has_batches(); }
  Result<const Batch*> next_batch(std::size_t most) override {
    while (true) {
      A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const Batch* const batch, tuples_->next_batch(most));
      if (batch == nullptr) return nullptr;
      select_inside(*batch);
      if (positions_.empty()) continue;
      batch_ = *batch;
      batch_.rows = {positions_.data(), positions_.size()};
      return &batch_;
    }
  }

 private:
  /// Forgets the points.
  void restart() {
    points_.clear();
    places_.clear();
  }
  /// An undefined point is in no solid.
  void add(const Value& value, std::size_t place) {
    if (!value.is_defined()) return;
    points_.push_back(value.get<Point3d>().position.ref());
    places_.push_back(static_cast<std::uint32_t>(place));
  }

  std::vector<bool> are_inside(std::span<const TuplePtr> tuples) {
    restart();
    for (std::size_t i = 0; i < tuples.size(); ++i) add(tuples[i]->attributes[attribute_], i);
    const std::vector<Placement> placements = place_in_solid(points_, solid_.geometry());
    std::vector<bool> result(tuples.size());
    for (std::size_t k = 0; k < places_.size(); ++k) result[places_[k]] = placements[k] != Placement::outside;
    return result;
  }

  void select_inside(const Batch& batch) {
    restart();
    const ValueColumn& column = *batch.columns[attribute_];
    column.visit([&]<typename Element>(const Element* values) {
      if constexpr (std::is_same_v<Element, Value>)
        batch.rows.for_each([&](std::size_t row) {
          if (column.is_defined(row)) add(values[row], row);
        });
    });
    const std::vector<Placement> placements = place_in_solid(points_, solid_.geometry());
    positions_.clear();
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (placements[k] != Placement::outside) positions_.push_back(places_[k]);
  }

  TupleStreamPtr tuples_;
  std::size_t attribute_;
  Volume3d solid_;
  const Context& context_;
  TupleStreamPtr one_by_one_;
  std::vector<PointRef> points_;
  std::vector<std::uint32_t> places_;  // of their tuples
  std::vector<std::uint32_t> positions_;
  Batch batch_;
};

Result<BoundOperator> map_points_inside(std::span<const ArgumentType> arguments) {
  const MappingCheck check("pointsInside", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t attribute, check.attribute(1, tuple));
  if (const TypeExpr& type = tuple.attributes()[attribute].type; !type.is("point3d"))
    return check.expected("an attribute of type point3d", type);
  A3D_TRY(check.type(2, "volume3d"));
  return BoundOperator{TypeExpr::stream(tuple),
                       [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         if (!given[2].value().is_defined())
                           return Datum{make_stream([]() -> Result<TuplePtr> { return TuplePtr(); })};
                         A3D_ASSIGN(const Value solid, given[2].value().loaded());
                         return Datum{std::make_shared<TuplesInside>(given[0].tuples(), attribute, solid, context)};
                       },
                       SelectsByAttributes{{attribute}}};
}

}  // namespace

void register_points_inside(algebra3d::OperatorGroup& group) {
  const std::string points =
      "[const rel(tuple([No: int, P: point3d])) value ((1 (0 0 0)) (2 (0.5 0.5 0.5)) (3 (2 0 0)) (4 undefined))] feed ";
  const std::string cube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";
  group.add({
      .name = "pointsInside",
      .syntax = "_ pointsInside[attribute, _]",
      .doc = "The tuples whose point lies in a solid, its boundary included, in their order.",
      .detail = "The same as `filter[.P inside v]`, but the points are located many at a time. Tuples "
                "with an undefined point are left out; no tuple is in an undefined solid.",
      .exactness = algebra3d::Exactness::exact,
      .cost = algebra3d::Cost::linear,
      .stream = stream_operator(map_points_inside),
      .signatures = {"(stream(tuple) NAME volume3d) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{points + "pointsInside[P, " + cube + "] project[No] consume", "((1) (2))"},
                         {points + "pointsInside[P, [const volume3d value undefined]] count", "0"}},
      .query_errors = {{"query " + points + "pointsInside[No, " + cube + "] count",
                        "pointsInside: expected an attribute of type point3d, got int"}},
  });
}

}  // namespace queries
