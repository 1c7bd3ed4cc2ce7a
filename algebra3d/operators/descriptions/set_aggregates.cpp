// union_aggr, intersection_aggr, extent: one solid, set of points or box of many.
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/constructions/solid_sets.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// All solids, to be divided at one another at once: united one after the other, each would be divided again and again.
class SolidList {
 public:
  void step(const Volume3d& solid) { solids_.push_back(solid); }
  void combine(SolidList&& later) {
    solids_.insert(solids_.end(), std::make_move_iterator(later.solids_.begin()),
                   std::make_move_iterator(later.solids_.end()));
  }
  const std::vector<Volume3d>& solids() const { return solids_; }

 private:
  std::vector<Volume3d> solids_;
};

class UnionOfSolids {
 public:
  static constexpr bool kKeepsValues = true, kHasParts = true;

  void step(const Volume3d& solid) { list_.step(solid); }
  void combine(UnionOfSolids&& later) { list_.combine(std::move(later.list_)); }
  Result<Volume3d> finish(Context& context) { return united(context, list_.solids()); }

 private:
  SolidList list_;
};

class IntersectionOfSolids {
 public:
  static constexpr bool kKeepsValues = true, kHasParts = true;

  void step(const Volume3d& solid) { list_.step(solid); }
  void combine(IntersectionOfSolids&& later) { list_.combine(std::move(later.list_)); }
  Result<Maybe<Volume3d>> finish(Context& context) {
    if (list_.solids().empty()) return Maybe<Volume3d>(Undefined{"there is no defined value"});
    A3D_ASSIGN(Volume3d common, intersected(context, list_.solids()));
    return Maybe<Volume3d>(std::move(common));
  }

 private:
  SolidList list_;
};

class UnionOfPoints {
 public:
  static constexpr bool kKeepsValues = true, kHasParts = true;

  void step(const Points3d& set) { points_.insert(points_.end(), set.points().begin(), set.points().end()); }
  void combine(UnionOfPoints&& later) {
    points_.insert(points_.end(), std::make_move_iterator(later.points_.begin()),
                   std::make_move_iterator(later.points_.end()));
  }
  Points3d finish() { return Points3d(std::move(points_)); }

 private:
  std::vector<ExactPoint> points_;
};

class IntersectionOfPoints {
 public:
  static constexpr bool kHasParts = true;

  Status step(const Points3d& set, Context& context) {
    A3D_TRY(context.check_cancelled());
    if (!common_) return common_ = set, Status();
    std::vector<ExactPoint> points;
    std::ranges::set_intersection(common_->points(), set.points(), std::back_inserter(points));
    common_ = Points3d(std::move(points));
    return {};
  }
  Status combine(IntersectionOfPoints&& later, Context& context) {
    return later.common_ ? step(*later.common_, context) : Status();
  }
  Maybe<Points3d> finish() {
    if (!common_) return Undefined{"there is no defined value"};
    return *std::move(common_);
  }

 private:
  std::optional<Points3d> common_;
};

/// The box around the boxes of values of any spatial type.
class Extent final : public AggregateState {
 public:
  Status step(const Value& value, Context& /*context*/) override {
    extend(value.header().box);
    return {};
  }
  Status combine(AggregateState& later, Context& /*context*/) override {
    extend(static_cast<Extent&>(later).box_);
    return {};
  }
  Status step_part(const Value& part, Context& /*context*/) override {
    extend(part.get<Box3>());
    return {};
  }
  Result<Outcome> finish(Context& /*context*/) override {
    if (box_.is_empty()) return Outcome(Undefined{"there is no defined value with a point"});
    return Outcome(Value::of(box_));
  }

 private:
  void extend(const Box3& box) {
    if (!box.is_empty()) box_.extend(box);
  }

  Box3 box_;
};

Overload extent(const Type& type) {
  Overload overload;
  overload.parameters = {{"values", &type, true}};
  overload.result = &TypeOf<Box3>::type();
  overload.part = overload.result;
  overload.start = [] { return std::make_unique<Extent>(); };
  return overload;
}

/// The overload, made to report how many undefined values it left out.
Overload counting_undefined(Overload overload) {
  overload.counts_undefined = true;
  return overload;
}

std::string cube_from(int x) {
  return "(createCube (makePoint3D " + std::to_string(x) + " 0 0) (makePoint3D " + std::to_string(x + 2) + " 2 2))";
}

}  // namespace

void register_set_aggregates(OperatorGroup& group) {
  group.add({
      .name = "union_aggr",
      .host_name = "union_agg",
      .doc = "The union of the defined solids or sets of points; empty if there are none.",
      .detail = "All solids are united at once, not one after the other. Undefined values are left out, with a note.",
      .exactness = Exactness::exact,
      .cost = Cost::arrangement,
      .overloads = {counting_undefined(aggregate<UnionOfSolids>("solids")),
                    counting_undefined(aggregate<UnionOfPoints>("sets"))},
      .examples = {{{cube_from(0), cube_from(1), cube_from(2), cube_from(3)}, "20.0", "(volume _)"},
                   {{cube_from(0), cube_from(1), cube_from(2), cube_from(3)}, "12", "(size _)"},
                   {{"(points3d ((0 0 1)))", "(points3d undefined)", "(points3d ((0 0 0) (0 0 1)))"},
                    "((0.0 0.0 0.0) (0.0 0.0 1.0))"},
                   {{"(volume3d)"}, "()"}},
      .errors = {{{"1"}, "union_aggr: expected values of type volume3d or points3d, got int"}},
  });
  group.add({
      .name = "intersection_aggr",
      .host_name = "intersection_agg",
      .doc = "The intersection of the defined solids or sets of points; undefined if there are none.",
      .detail = "Undefined values are left out, with a note.",
      .exactness = Exactness::exact,
      .cost = Cost::arrangement,
      .overloads = {counting_undefined(aggregate<IntersectionOfSolids>("solids")),
                    counting_undefined(aggregate<IntersectionOfPoints>("sets"))},
      .examples = {{{cube_from(0), cube_from(1)}, "4.0", "(volume _)"},
                   {{cube_from(0), cube_from(1), cube_from(2), cube_from(3)}, "0", "(size _)"},
                   {{"(points3d ((0 0 1)))", "(points3d undefined)", "(points3d ((0 0 0) (0 0 1)))"},
                    "((0.0 0.0 1.0))"},
                   {{"(volume3d)"}, "undefined"}},
      .errors = {{{"1"}, "intersection_aggr: expected values of type volume3d or points3d, got int"}},
  });
  group.add({
      .name = "extent",
      .doc = "The smallest box of doubles around all defined values; undefined if they have no point.",
      .detail = "Rounded outward if coordinates are not doubles. Undefined and empty values are left out.",
      .exactness = Exactness::outward,
      .cost = Cost::linear,
      .overloads = {extent(TypeOf<Point3d>::type()), extent(TypeOf<Points3d>::type()),
                    extent(TypeOf<Surface3d>::type()), extent(TypeOf<Volume3d>::type()), extent(TypeOf<Mesh3d>::type()),
                    extent(TypeOf<Box3>::type())},
      .examples = {{{cube_from(0), "(volume3d ())", cube_from(5)}, "(0.0 7.0 0.0 2.0 0.0 2.0)"},
                   {{"(point3d (1 2 3))", "(point3d undefined)", "(point3d (0 4 3))"}, "(0.0 1.0 2.0 4.0 3.0 3.0)"},
                   {{"(volume3d)"}, "undefined"}},
      .errors = {{{"1"}, "extent: expected values of type point3d, points3d, surface3d, volume3d, mesh3d or rect3"}},
  });
}

}  // namespace algebra3d
