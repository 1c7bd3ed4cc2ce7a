// union_aggr, intersection_aggr: one solid or set of points of many.
#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/constructions/solid_sets.h"
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
  static constexpr bool kKeepsValues = true;

  void step(const Volume3d& solid) { list_.step(solid); }
  void combine(UnionOfSolids&& later) { list_.combine(std::move(later.list_)); }
  Result<Volume3d> finish(Context& context) { return united(context, list_.solids()); }

 private:
  SolidList list_;
};

class IntersectionOfSolids {
 public:
  static constexpr bool kKeepsValues = true;

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
  static constexpr bool kKeepsValues = true;

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

/// The overload, made to report how many undefined values it left out.
Overload counting_undefined(Overload overload) {
  overload.counts_undefined = true;
  return overload;
}

std::string cube_from(int x) {
  return "(createCube (makePoint3D " + std::to_string(x) + " 0 0) (makePoint3D " + std::to_string(x + 2) + " 2 2))";
}

}  // namespace

void register_set_aggregates(Registry& registry) {
  registry.add({
      .name = "union_aggr",
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
  registry.add({
      .name = "intersection_aggr",
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
}

}  // namespace algebra3d
