// pointsInside: tuples whose point lies in a solid, many at a time.
#include <algorithm>
#include <utility>
#include <vector>

#include "algebra3d/registry/operator.h"
#include "algebra3d/spatial_relations/point_location.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

using algebra3d::Placement;
using algebra3d::Point3d;
using algebra3d::PointRef;
using algebra3d::Volume3d;

/// The tuples of a stream whose point is in the solid. They are read in blocks, whose points are located in parallel;
/// the first blocks are small, so that the first tuples come soon.
class TuplesInside {
 public:
  TuplesInside(TupleStreamPtr stream, std::size_t attribute, Volume3d solid, const Context& context)
      : stream_(std::move(stream)), attribute_(attribute), solid_(std::move(solid)), context_(&context) {}

  Result<TuplePtr> operator()() {
    while (next_ == found_.size()) {
      ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_at_end, read_block());
      if (is_at_end) return TuplePtr();
    }
    return std::move(found_[next_++]);
  }

 private:
  static constexpr std::size_t kFirstBlock = 64, kLargestBlock = 65536;

  /// True if there was no tuple left.
  Result<bool> read_block() {
    ALGEBRA3D_RETURN_IF_ERROR(context_->check_cancelled());
    found_.clear();
    next_ = 0;
    points_.clear();
    std::size_t read = 0;
    for (; read < block_; ++read) {
      ALGEBRA3D_ASSIGN_OR_RETURN(TuplePtr tuple, stream_->next());
      if (tuple == nullptr) break;
      ALGEBRA3D_RETURN_IF_ERROR(add(std::move(tuple)));
    }
    block_ = std::min(4 * block_, kLargestBlock);
    keep_inside();
    return read == 0;
  }

  Status add(TuplePtr tuple) {
    const Value& value = tuple->attributes[attribute_];
    if (!value.is_defined()) return {};
    points_.push_back(value.get<Point3d>().position.ref());
    found_.push_back(std::move(tuple));
    return {};
  }

  void keep_inside() {
    const std::vector<Placement> places = place_in_solid(points_, solid_.geometry());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (places[i] != Placement::outside) found_[kept++] = std::move(found_[i]);
    found_.resize(kept);
  }

  TupleStreamPtr stream_;
  std::size_t attribute_;
  Volume3d solid_;
  const Context* context_;
  std::size_t block_ = kFirstBlock;
  std::vector<TuplePtr> found_;
  std::size_t next_ = 0;
  std::vector<PointRef> points_;  // those of found_, while a block is read
};

Result<BoundOperator> map_points_inside(std::span<const ArgumentType> arguments) {
  const MappingCheck check("pointsInside", arguments);
  ALGEBRA3D_ASSIGN_OR_RETURN(const TypeExpr tuple, check.stream(0));
  ALGEBRA3D_ASSIGN_OR_RETURN(const std::size_t attribute, check.attribute(1, tuple));
  if (const TypeExpr& type = tuple.attributes()[attribute].type; !type.is("point3d"))
    return check.expected("an attribute of type point3d", type);
  ALGEBRA3D_RETURN_IF_ERROR(check.type(2, "volume3d"));
  return BoundOperator{
      TypeExpr::stream(tuple), [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
        if (!given[2].value().is_defined()) return Datum{make_stream([]() -> Result<TuplePtr> { return TuplePtr(); })};
        ALGEBRA3D_ASSIGN_OR_RETURN(const Value solid, given[2].value().loaded());
        return Datum{make_stream(TuplesInside(given[0].tuples(), attribute, solid.get<Volume3d>(), context))};
      }};
}

}  // namespace

void register_points_inside(algebra3d::Registry& registry) {
  const std::string points =
      "[const rel(tuple([No: int, P: point3d])) value ((1 (0 0 0)) (2 (0.5 0.5 0.5)) (3 (2 0 0)) (4 undefined))] feed ";
  const std::string cube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";
  registry.add({
      .name = "pointsInside",
      .syntax = "_ pointsInside[attribute, _]",
      .doc = "The tuples whose point lies in a solid, its boundary included, in their order.",
      .detail = "The same as `filter[.P inside v]`, but the points are located many at a time and in parallel. Tuples "
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
