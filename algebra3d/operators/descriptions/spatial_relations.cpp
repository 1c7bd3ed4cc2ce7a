// intersects, disjoint, touches, inside, contains, covers, coveredBy, overlaps, relation, commonPoint: of boxes,
// points, surfaces and solids in space, and of points, rectangles and regions in the plane. What `inside` and
// `contains` mean for others.
#include "algebra3d/values/spatial_relations/relation.h"

#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/descriptions/detail/sample_values.h"
#include "algebra3d/operators/descriptions/detail/spatial_sets.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/time.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// True if they have no point in common because one is empty or their boxes are apart.
bool are_apart(const GeometryHeader& a, const GeometryHeader& b) {
  return a.box.is_empty() || b.box.is_empty() || !a.box.intersects(b.box);
}

// ---- predicates

enum class Predicate : std::uint8_t { intersects, disjoint, touches, inside, contains, overlaps };

constexpr bool is_symmetric(Predicate predicate) {
  return predicate != Predicate::inside && predicate != Predicate::contains;
}

/// The answer for sets that are apart.
bool answer_apart(Predicate predicate, const GeometryHeader& a, const GeometryHeader& b) {
  switch (predicate) {
    case Predicate::disjoint:
      return true;
    case Predicate::inside:
      return a.box.is_empty();
    case Predicate::contains:
      return b.box.is_empty();
    default:
      return false;
  }
}

Result<bool> negated(Result<bool> result) {
  if (result.ok()) return !*result;
  return result;
}

Result<bool> answer(Predicate predicate, const SpatialSet& a, const SpatialSet& b, const Monitor& monitor) {
  switch (predicate) {
    case Predicate::intersects:
      return do_meet(a, b, monitor);
    case Predicate::disjoint:
      return negated(do_meet(a, b, monitor));
    case Predicate::touches:
      return do_touch(a, b, monitor);
    case Predicate::inside:
      return is_inside(a, b, monitor);
    case Predicate::contains:
      return is_inside(b, a, monitor);
    default:
      return do_overlap(a, b, monitor);
  }
}

template <Predicate kPredicate, typename A, typename B>
Result<bool> holds(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  if (are_apart(a.header(), b.header())) return answer_apart(kPredicate, a.header(), b.header());
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) {
    return answer(kPredicate, first, second, context.monitor());
  });
}

// ---- relation and commonPoint

/// The name of a relation: the first that holds.
std::string name_of(const SpatialRelation& relation) {
  if (!relation.do_meet) return "disjoint";
  if (!relation.do_interiors_meet) return "touches";
  if (relation.is_first_inside && relation.is_second_inside) return "equal";
  if (relation.is_first_inside) return "inside";
  return relation.is_second_inside ? "contains" : "overlaps";
}

using RelationRow = std::tuple<std::string, std::int64_t, std::int64_t>;

template <typename A, typename B>
Result<RelationRow> relation_row(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  if (are_apart(a.header(), b.header())) return RelationRow("disjoint", -1, -1);
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) -> Result<RelationRow> {
    A3D_ASSIGN(const SpatialRelation relation, relation_of(first, second, context.monitor()));
    return RelationRow(name_of(relation), relation.shared_dimension, relation.shared_boundary_dimension);
  });
}

using WitnessRow = std::tuple<Point3d, std::optional<std::int64_t>, std::optional<std::int64_t>>;

/// The number of a triangle, as by faces.
std::optional<std::int64_t> number_of(FaceId face) {
  if (!face.is_valid()) return std::nullopt;
  return std::int64_t{face.index()};
}

template <typename A, typename B>
Result<std::optional<WitnessRow>> common_point_row(Context& context, const OnDemand<A>& a, const OnDemand<B>& b) {
  using Row = std::optional<WitnessRow>;
  if (are_apart(a.header(), b.header())) return Row();
  return ask_loaded(context, a, b, [&](const SpatialSet& first, const SpatialSet& second) -> Result<Row> {
    A3D_ASSIGN(const auto witness, witness_of_meeting(first, second, context.monitor()));
    if (!witness) return Row();
    return Row(WitnessRow(Point3d{witness->point}, number_of(witness->first_face), number_of(witness->second_face)));
  });
}

// ---- overloads for all pairs of kinds

template <Predicate kPredicate>
struct PredicateMaker {
  template <typename A, typename B>
  static Overload make() {
    Overload made = overload<&holds<kPredicate, A, B>>("a", "b");
    made.is_symmetric = std::is_same_v<A, B> && is_symmetric(kPredicate);
    return made;
  }
};

struct RelationMaker {
  template <typename A, typename B>
  static Overload make() {
    return table<&relation_row<A, B>>({"Relation", "SharedDimension", "BoundaryDimension"}, "a", "b");
  }
};

struct CommonPointMaker {
  template <typename A, typename B>
  static Overload make() {
    return table<&common_point_row<A, B>>({"Point", "FirstTriangle", "SecondTriangle"}, "a", "b");
  }
};

/// The overloads of a predicate, after `others`, which messages then name.
template <Predicate kPredicate>
std::vector<Overload> predicate_overloads(std::vector<Overload> others = {}) {
  const std::vector<Overload> overloads = all_pairs<PredicateMaker<kPredicate>>();
  others.insert(others.end(), overloads.begin(), overloads.end());
  return others;
}

bool instant_inside(const Instant& instant, const TimeInterval& interval) {
  return interval.contains(instant);
}
bool string_contains(const std::string& whole, const std::string& part) {
  return whole.find(part) != std::string::npos;
}
bool text_contains(const Text& whole, const Text& part) {
  return whole.content.find(part.content) != std::string::npos;
}

// ---- descriptions

const std::string kUndefinedRect3 = "(rect3 undefined)";
const std::string kUnitBox = "(rectangle3 0 1 0 1 0 1)";
const std::string kShiftedBox = "(rectangle3 1 2 0 1 0 1)";
const std::string kNextCube = "(createCube (makePoint3D 2 0 0) (makePoint3D 3 2 2))";
const std::string kCrossingCube = "(createCube (makePoint3D 1 1 1) (makePoint3D 3 3 3))";
const std::string kFloor = "(surface3d (((0 0 0) (2 0 0) (2 2 0))))";
const std::string kCornerOfCube = "(makePoint3D 2 2 2)";

constexpr const char* kMeaningOfSets =
    "All sets are closed; solids are solids, not their surfaces. The interior of a point is the point; that of a flat "
    "box is that within its plane or line; that of a surface is the surface without its boundary edges. The empty set "
    "is inside every set and meets none. Decided exactly, also for coordinates that are not doubles.";

void register_meeting(OperatorGroup& group) {
  group.add({
      .name = "intersects",
      .syntax = "_ intersects _",
      .doc = "True if the sets have a point in common; touching counts.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::meet,
      .sources = {"guigue2003", "lauterbach2009"},
      .overloads = predicate_overloads<Predicate::intersects>(),
      .examples = {{{kUnitBox, kShiftedBox}, "TRUE"},
                   {{kUnitBox, "(rectangle3 2 3 0 1 0 1)"}, "FALSE"},
                   {{kCubeOfTwo, kInnerCube}, "TRUE"},
                   {{kCornerOfCube, kCubeOfTwo}, "TRUE"},
                   {{kUnitRegion, "(rectangle2 1 2 1 2)"}, "TRUE"},
                   {{kUnitBox, kUndefinedRect3}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "intersects: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "disjoint",
      .syntax = "_ disjoint _",
      .doc = "True if the sets have no point in common.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .overloads = predicate_overloads<Predicate::disjoint>(),
      .examples = {{{kCubeOfTwo, kNextCube}, "FALSE"},
                   {{kInnerCube, kNextCube}, "TRUE"},
                   {{kCornerOfCube, "(volume3d ())"}, "TRUE"},
                   {{kUnitBox, kUndefinedRect3}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "disjoint: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "touches",
      .syntax = "_ touches _",
      .doc = "True if the sets meet but their interiors do not.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::meet,
      .overloads = predicate_overloads<Predicate::touches>(),
      .examples = {{{kCubeOfTwo, kNextCube}, "TRUE"},
                   {{kCubeOfTwo, kCrossingCube}, "FALSE"},
                   {{kCornerOfCube, kCubeOfTwo}, "TRUE"},
                   {{kFloor, kCubeOfTwo}, "TRUE"},
                   {{kCornerOfCube, kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "touches: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "overlaps",
      .host_name = "overlaps_with",
      .syntax = "_ overlaps _",
      .doc = "True if the interiors of the sets meet and neither is inside the other.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::meet,
      .overloads = predicate_overloads<Predicate::overlaps>(),
      .examples = {{{kCubeOfTwo, kCrossingCube}, "TRUE"},
                   {{kCubeOfTwo, kNextCube}, "FALSE"},
                   {{kCubeOfTwo, kInnerCube}, "FALSE"},
                   {{kCubeOfTwo, kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "overlaps: expected (rect3 rect3)"}},
  });
}

void register_inclusion(OperatorGroup& group) {
  group.add({
      .name = "inside",
      .syntax = "_ inside _",
      .doc = "True if every point of the first set lies in the second, or the instant in the interval.",
      .detail = std::string("The boundaries may meet. ") + kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::first_is_inside,
      .overloads = predicate_overloads<Predicate::inside>({overload<&instant_inside>("instant", "interval")}),
      .examples = {{{kUnitBox, "(rectangle3 0 2 0 2 0 2)"}, "TRUE"},
                   {{kUnitBox, kShiftedBox}, "FALSE"},
                   {{kInnerCube, kCubeOfTwo}, "TRUE"},
                   {{kFloor, kCubeOfTwo}, "TRUE"},
                   {{"(makePoint 2 0)", kUnitRegion}, "FALSE"},
                   {{"(theInstant 2012)", R"((interval ("2011-01-01" "2012-01-01" TRUE FALSE)))"}, "FALSE"},
                   {{kUnitBox, kUndefinedRect3}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "inside: expected (rect3 rect3), (rect3 point3d)"}},
  });
  group.add({
      .name = "contains",
      .syntax = "_ contains _",
      .doc = "True if the first set contains every point of the second, or the first string or text contains the "
             "second.",
      .detail = std::string("The boundaries may meet. ") + kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::first_encloses,
      .overloads = predicate_overloads<Predicate::contains>(
          {overload<&string_contains>("whole", "part"), overload<&text_contains>("whole", "part")}),
      .examples = {{{"(rectangle3 0 2 0 2 0 2)", kUnitBox}, "TRUE"},
                   {{kCubeOfTwo, kCornerOfCube}, "TRUE"},
                   {{R"("gearbox")", R"("box")"}, "TRUE"},
                   {{"'gearbox.stl'", R"("cog")"}, "FALSE"},
                   {{kUnitBox, kUndefinedRect3}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "contains: expected (rect3 rect3), (rect3 point3d)"}},
  });
  group.add({
      .name = "coveredBy",
      .syntax = "_ coveredBy _",
      .doc = "True if every point of the first set lies in the second; the same as `inside`.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::first_is_inside,
      .overloads = predicate_overloads<Predicate::inside>(),
      .examples = {{{kInnerCube, kCubeOfTwo}, "TRUE"},
                   {{kCubeOfTwo, kInnerCube}, "FALSE"},
                   {{kInnerCube, kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "coveredBy: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "covers",
      .syntax = "_ covers _",
      .doc = "True if the first set contains every point of the second; the same as `contains`.",
      .detail = kMeaningOfSets,
      .exactness = Exactness::exact,
      .boxes = BoxCondition::first_encloses,
      .overloads = predicate_overloads<Predicate::contains>(),
      .examples = {{{kCubeOfTwo, kInnerCube}, "TRUE"},
                   {{kInnerCube, kCubeOfTwo}, "FALSE"},
                   {{kInnerCube, kUndefinedSolid}, "undefined"}},
      .errors = {{{kUnitBox, "1"}, "covers: expected (rect3 rect3)"}},
  });
}

void register_details(OperatorGroup& group) {
  group.add({
      .name = "relation",
      .host_name = "spatial_relation",
      .syntax = "relation(_, _)",
      .doc = "How two sets lie to each other, in one row (Relation: string, SharedDimension: int, BoundaryDimension: "
             "int).",
      .detail = std::string("Relation is the first that holds of: disjoint; touches; equal, inside and contains, of "
                            "sets whose interiors meet; overlaps. SharedDimension is that of the intersection of the "
                            "sets: -1 if nothing, 0 for points, 1 for lines, 2 for faces, 3 for space; "
                            "BoundaryDimension that of the intersection of their boundaries. So two solids that touch "
                            "in a face have 2 and 2, those that touch in an edge 1 and 1. ") +
                kMeaningOfSets,
      .exactness = Exactness::exact,
      .overloads = all_pairs<RelationMaker>(),
      .examples = {{{kCubeOfTwo, kNextCube}, R"((("touches" 2 2)))"},
                   {{kCubeOfTwo, kCrossingCube}, R"((("overlaps" 3 1)))"},
                   {{kInnerCube, kCubeOfTwo}, R"((("inside" 3 -1)))"},
                   {{kInnerCube, kNextCube}, R"((("disjoint" -1 -1)))"},
                   {{kInnerCube, kUndefinedSolid}, "()"}},
      .errors = {{{kUnitBox, "1"}, "relation: expected (rect3 rect3)"}},
  });
  group.add({
      .name = "commonPoint",
      .syntax = "commonPoint(_, _)",
      .doc = "A point that two sets have in common, in one row (Point: point3d, FirstTriangle: int, SecondTriangle: "
             "int); no row if they are disjoint.",
      .detail =
          "If triangles of two surfaces or solids meet in the point, their numbers are given, from 0 as by faces. If "
          "the point is inside a solid, or one of the sets has no triangles, they are undefined. The same values "
          "give the same point.",
      .exactness = Exactness::exact,
      .overloads = pairs_in_space<CommonPointMaker>(),
      .examples = {{{kCornerOfCube, kCubeOfTwo}, "(((2.0 2.0 2.0) undefined undefined))"},
                   {{kInnerCube, kCubeOfTwo}, "(((0.5 0.5 0.5) undefined undefined))"},
                   {{kInnerCube, kNextCube}, "()"},
                   {{kInnerCube, kUndefinedSolid}, "()"}},
      .errors = {{{kUnitBox, "1"}, "commonPoint: expected (rect3 rect3)"}},
  });
}

}  // namespace

void register_spatial_relations(OperatorGroup& group) {
  register_meeting(group);
  register_inclusion(group);
  register_details(group);
}

}  // namespace algebra3d
