#include "algebra3d/kernel/distance/detail/piece_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algebra3d/kernel/distance/covering_bound.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d::distances {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 between(const Vec3& a, const Vec3& b, double share) {
  const Vec3 halves = 0.5 * b - 0.5 * a;  // differences may be out of range
  return a + share * halves + share * halves;
}

double length_between(const Vec3& a, const Vec3& b) {
  return 2 * length(0.5 * b - 0.5 * a) * (1 + 0x1p-50);
}

}  // namespace

double PieceSearch::largest_coordinate(const Box3& box) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return largest;
}

/// Samples must be better by more than roundings to replace others, so that vertices are preferred.
bool PieceSearch::is_better(double distance) const {
  return best_.is_none() || distance > lower_ * (1 + 0x1p-44) + tolerance_ / 4;
}

void PieceSearch::take_sample(SampleId id, double rounding) {
  const double lower = set_[id].lower - rounding;
  if (!is_better(lower)) return;
  best_ = id;
  lower_ = std::max(lower_, lower);
}

/// If it may be better, first makes bounds exact that are farther apart than is good enough: the rounded lower bound is
/// poor where a set is near in comparison with its triangles.
void PieceSearch::take_sharpened(SampleId id, double rounding) {
  const double upper = set_[id].upper;
  if (!is_better(upper - rounding)) return;
  if (upper - set_[id].lower > upper * (kRelative / 16) + tolerance_ / 16) set_.make_exact(id);
  take_sample(id, rounding);
}

/// Measures the vertices that are taken. What one task finds does not serve another: results do not depend on threads.
template <typename IsTaken>
Status PieceSearch::measure(IsTaken is_taken, const Monitor& monitor) {
  constexpr std::size_t kTask = 256;
  const std::size_t count = from_.vertex_count();
  const Stage stage(monitor, "measuring distances", count);
  const auto for_each = [&](std::size_t begin, std::size_t end, auto visit) {
    for (std::size_t i = begin; i < end; ++i)
      if (is_taken(i) && !from_.is_isolated(VertexId(i)) && !visit(SampleId(i))) return;
  };
  parallel_for((count + kTask - 1) / kTask, 1, [&](std::size_t task) {
    Stage own(stage);
    std::array<FaceId, 4> near{FaceId(0), {}, {}, {}};  // those before: vertices are mostly near each other
    std::size_t measured = 0;
    for_each(task * kTask, std::min((task + 1) * kTask, count), [&](SampleId id) {
      if (!own.begin_step()) return false;
      set_.set(id, set_.measured(from_.points().point(id.index()), near, lower_));
      near[measured++ % near.size()] = set_[id].nearest;
      return true;
    });
  });
  A3D_TRY(monitor.check());
  SampleId largest;
  for_each(0, count, [&](SampleId id) {
    take_sample(id, 0);
    if (largest.is_none() || set_[id].upper > set_[largest].upper) largest = id;
    return true;
  });
  if (!largest.is_none()) take_sharpened(largest, 0);
  return {};
}

/// The step between indices of which at most kFirstSamples are taken.
std::size_t PieceSearch::first_step(std::size_t count) {
  return count / kFirstSamples + 1;
}

Status PieceSearch::measure_some(const Monitor& monitor) {
  set_.resize(from_.vertex_count());
  const std::size_t vertex_step = first_step(from_.vertex_count()), face_step = first_step(from_.face_count());
  A3D_TRY(measure([&](std::size_t i) { return i % vertex_step == 0; }, monitor));
  const std::vector<Vec3>& points = from_.points().approx();
  FaceId near(0);
  for (std::size_t f = 0; f < from_.face_count(); f += face_step) {
    A3D_TRY(monitor.check());
    const auto [a, b, c] = from_.triangle(FaceId(f));
    near = set_[new_sample(between(between(points[a], points[b], 0.5), points[c], 1.0 / 3), near)].nearest;
  }
  work_ = 0;
  // So that vertices that are as far replace these samples.
  lower_ = std::max(0.0, lower_ * (1 - kRelative / 16) - tolerance_ / 2);
  return {};
}

Status PieceSearch::measure_vertices(double at_least, const Monitor& monitor) {
  lower_ = std::max(lower_, at_least);
  const std::size_t step = first_step(from_.vertex_count());
  return measure([step](std::size_t i) { return i % step != 0; }, monitor);
}

/// Bounds faces that are not bounded yet, or whose bounds are to be lowered; `max_work` as of FaceBounds.
template <typename Vector>
void PieceSearch::bound(std::span<const std::uint32_t> faces, std::size_t max_work, const Monitor& monitor) {
  constexpr std::size_t kTask = 16;
  const Stage stage(monitor, "bounding distances", faces.size());
  parallel_for((faces.size() + kTask - 1) / kTask, 1, [&](std::size_t task) {
    Stage own(stage);
    FaceBounds<Vector> bounds(from_, to_, *facets_, box_, enough(), monitor);
    for (std::size_t i = task * kTask; i < std::min((task + 1) * kTask, faces.size()) && own.begin_step(); ++i) {
      const auto [a, b, c] = from_.triangle(FaceId(faces[i]));
      const FaceBound found =
          bounds.of(FaceId(faces[i]), {set_[SampleId(a)].nearest, set_[SampleId(b)].nearest, set_[SampleId(c)].nearest},
                    max_work);
      if (found.upper < face_bounds_[faces[i]].upper) face_bounds_[faces[i]] = found;
    }
  });
}

std::vector<std::uint32_t> PieceSearch::unsettled_faces() const {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < face_bounds_.size(); ++f)
    if (!is_settled(face_bounds_[f].upper)) faces.push_back(f);
  return faces;
}

Status PieceSearch::begin_bounds(double at_least, const Monitor& monitor) {
  lower_ = std::max(lower_, at_least);
  face_bounds_.assign(from_.face_count(), {kInfinity, {}, {}});
  facets_.emplace(*to_.mesh, half_scale_for(box_));
  bound<Vec3>(unsettled_faces(), 0, monitor);
  A3D_TRY(monitor.check());
  left_ = unsettled_faces();
  return {};
}

Status PieceSearch::bound_round(double at_least, const Monitor& monitor) {
  constexpr std::size_t kWorkOfFirstBound = 1 << 13, kUnlimited = static_cast<std::size_t>(-1), kGrowth = 8;
  lower_ = std::max(lower_, at_least);
  const auto drop_settled = [&] {
    std::erase_if(left_, [&](std::uint32_t face) { return is_settled(face_bounds_[face].upper); });
  };
  drop_settled();
  const std::size_t count = std::min(round_size_, left_.size());
  round_size_ *= kGrowth;
  move_farthest_to_front(left_, count);
  const std::span<std::uint32_t> round(left_.data(), count);
  std::ranges::sort(round);  // those of a task are mostly near each other
  bound<Vec3>(round, do_nearly_coincide() ? kWorkOfFirstBound : kUnlimited, monitor);
  A3D_TRY(monitor.check());
  probe(round);
  left_.erase(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(count));
  drop_settled();
  return {};
}

/// The work is limited by the number of all faces: it is spent on those that are not settled, which mostly are few.
Status PieceSearch::bound_near_faces(double at_least, const Monitor& monitor) {
  constexpr std::size_t kLeastWork = 512;
  lower_ = std::max(lower_, at_least);
  if (!do_nearly_coincide()) return {};
  std::vector<std::uint32_t> faces = unsettled_faces();
  bound<WideVec3>(faces, std::max(kLeastWork, near_work() / std::max<std::size_t>(1, faces.size())), monitor);
  A3D_TRY(monitor.check());
  probe(faces);
  faces = unsettled_faces();
  return faces.empty() ? Status() : cover(faces, monitor);
}

/// Lowers the bounds of faces to that of a covering, if few pieces do for it.
Status PieceSearch::cover(std::span<const std::uint32_t> faces, const Monitor& monitor) {
  PointArray points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const std::uint32_t face : faces) {
    const auto first = static_cast<std::uint32_t>(points.size());
    triangles.push_back({first, first + 1, first + 2});
    for (const PointRef& corner : from_.corners(FaceId(face))) points.push_back(corner);
  }
  const TriangleMesh part(std::move(points), triangles);
  // A covering is no closer than twice what is enough to it; a piece may be compared with many faces.
  A3D_ASSIGN(const std::optional<double> bound, covering_bound(part, to_, enough() / 2, near_work() / 1024, monitor));
  if (!bound) return {};
  for (const std::uint32_t face : faces) face_bounds_[face].upper = std::min(face_bounds_[face].upper, *bound);
  return {};
}

void PieceSearch::move_farthest_to_front(std::vector<std::uint32_t>& faces, std::size_t count) const {
  std::ranges::partial_sort(faces, faces.begin() + static_cast<std::ptrdiff_t>(count), [&](auto a, auto b) {
    return std::pair(-face_bounds_[a].upper, a) < std::pair(-face_bounds_[b].upper, b);
  });
}

void PieceSearch::probe(std::span<const std::uint32_t> bounded) {
  std::vector<std::uint32_t> faces(bounded.begin(), bounded.end());
  const std::size_t count = std::min(faces.size(), kProbedFaces);
  move_farthest_to_front(faces, count);
  for (std::size_t i = 0; i < count && !is_settled(face_bounds_[faces[i]].upper); ++i)
    new_sample(face_bounds_[faces[i]].where, face_bounds_[faces[i]].near);
}

std::size_t PieceSearch::near_work() const {
  return kWorkOfNear + kWorkOfNearFace * (from_.face_count() + to_.hierarchy->face_count());
}

bool PieceSearch::may_go_on(std::size_t piece_count) const {
  return piece_count < kMaxPieces && (work_ < near_work() || !do_nearly_coincide());
}

Status PieceSearch::refine(double at_least, const Monitor& monitor) {
  lower_ = std::max(lower_, at_least);
  for (std::size_t f = 0; f < from_.face_count(); ++f) {
    if (is_settled(face_bounds_[f].upper)) continue;
    const auto [a, b, c] = from_.triangle(FaceId(f));
    push({{SampleId(a), SampleId(b), SampleId(c)}, face_bounds_[f].upper, 0});
  }
  const FaceBounds<Vec3> bounds(from_, to_, *facets_, box_, enough(), monitor);
  std::size_t count = 0;
  while (!pieces_.empty() && !is_settled(pieces_.top().upper) && may_go_on(++count)) {
    if (count % 256 == 0) A3D_TRY(monitor.check());
    const Piece piece = pieces_.top();
    pieces_.pop();
    work_ += kWorkOfDivision;
    divide(piece, bounds);
  }
  // Pieces that were left out have bounds up to this one.
  upper_ = lower_ * (1 + kRelative) + tolerance_;
  is_bounded_ = pieces_.empty() || is_settled(pieces_.top().upper);
  if (!is_bounded_) upper_ = pieces_.top().upper;
  return {};
}

void PieceSearch::bound_by(FaceId face, const Corners& corners, double& least, FaceId& of_least) const {
  double largest = 0;
  for (const SampleId corner : corners) largest = std::max(largest, set_.bounds(corner, face).upper);
  if (largest >= least) return;
  least = largest;
  of_least = face;
}

/// Adds a piece whose bound is that of its parent, unless it need not be divided.
void PieceSearch::push(Piece piece) {
  double upper = kInfinity;
  FaceId face;
  for (const SampleId corner : piece.corners) bound_by(set_[corner].nearest, piece.corners, upper, face);
  piece.upper = std::min(piece.upper, upper + rounding_);
  if (!is_settled(piece.upper)) pieces_.push(piece);
}

/// How much farther a point is from the second face than from the first one.
double PieceSearch::nearness(const Vec3& point, FaceId first, FaceId second) const {
  return set_.bounds(point, second).upper - set_.bounds(point, first).upper;
}

/// The share of a segment, from its end that is nearer to the first face, up to the point that is about equally far
/// from both faces.
double PieceSearch::share_near(const Vec3& near_first, const Vec3& near_second, FaceId first, FaceId second) const {
  double low = 0, high = 1;
  for (int step = 0; step < 52; ++step) {
    const double middle = (low + high) / 2;
    (nearness(between(near_first, near_second, middle), first, second) > 0 ? low : high) = middle;
  }
  return high;
}

SampleId PieceSearch::new_sample(const Vec3& point, FaceId near) {
  const SampleId id = set_.add(set_.measured(ExactPoint(point), std::span(&near, 1)));
  work_ += set_[id].work;
  take_sharpened(id, rounding_);
  return id;
}

/// Divides a piece where it is equally far from two faces. False if no corners are clearly nearer to different ones, or
/// if only the tip at a corner would be cut off: that can go on for ever.
bool PieceSearch::divide_between(const Piece& piece, FaceId first, FaceId second, Division& division) {
  constexpr double kTip = 1.0 / 16;
  std::array<double, 3> nearer{};
  for (std::size_t i = 0; i < 3; ++i) {
    nearer[i] = nearness(position(piece.corners[i]), first, second);
    if (std::abs(nearer[i]) < tolerance_ / 4) nearer[i] = 0;
  }
  std::array<std::optional<Vec3>, 3> cuts;  // of the edges from each corner to the next one
  std::array<int, 3> cuts_near{};           // each corner
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t from = i, to = (i + 1) % 3;
    if (nearer[from] < nearer[to]) std::swap(from, to);
    if (!(nearer[from] > 0 && nearer[to] < 0)) continue;
    const Vec3 begin = position(piece.corners[from]), end = position(piece.corners[to]);
    const double share = share_near(begin, end, first, second);
    cuts[i] = between(begin, end, share);
    if (share < kTip) ++cuts_near[from];
    if (share > 1 - kTip) ++cuts_near[to];
  }
  if (cuts == decltype(cuts){} || std::ranges::max(cuts_near) == 2) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (nearer[i] >= 0) division.first.push_back(piece.corners[i]);
    if (nearer[i] <= 0) division.second.push_back(piece.corners[i]);
    if (!cuts[i]) continue;
    const SampleId cut = new_sample(*cuts[i], first);
    division.first.push_back(cut);
    division.second.push_back(cut);
  }
  return true;
}

void PieceSearch::halve(const Piece& piece, Division& division) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double own = length_between(position(piece.corners[i]), position(piece.corners[(i + 1) % 3]));
    if (own > length) longest = i;
    length = std::max(length, own);
  }
  const SampleId a = piece.corners[longest], b = piece.corners[(longest + 1) % 3], c = piece.corners[(longest + 2) % 3];
  const SampleId middle = new_sample(between(position(a), position(b), 0.5), set_[a].nearest);
  division.first = {a, middle, c};
  division.second = {middle, b, c};
}

void PieceSearch::push_polygon(const std::vector<SampleId>& polygon, const Piece& parent) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    push({{polygon[0], polygon[i], polygon[i + 1]}, parent.upper, parent.depth + 1});
}

void PieceSearch::divide(const Piece& piece, const FaceBounds<Vec3>& bounds) {
  // The face with the best bound; the one of the centroid may be better than those of the corners.
  double upper = kInfinity;
  FaceId best;
  for (const SampleId corner : piece.corners) bound_by(set_[corner].nearest, piece.corners, upper, best);
  const Vec3 middle = between(position(piece.corners[0]), position(piece.corners[1]), 0.5);
  const SampleId centre =
      new_sample(between(middle, position(piece.corners[2]), 1.0 / 3), set_[piece.corners[0]].nearest);
  bound_by(set_[centre].nearest, piece.corners, upper, best);
  if (is_settled(std::min(upper + rounding_, piece.upper))) return;
  if (bounds.is_over_facet({position(piece.corners[0]), position(piece.corners[1]), position(piece.corners[2])},
                           set_[centre].nearest))
    return;

  // The corner that is farthest from it, unlike from its own nearest face.
  SampleId farthest = piece.corners[0];
  for (const SampleId corner : piece.corners)
    if (set_.bounds(corner, best).upper > set_.bounds(farthest, best).upper) farthest = corner;
  Division division;
  // Then twice in the middle, so that pieces shrink whatever the faces are.
  const bool is_divided = piece.depth % 4 < 2 && divide_between(piece, best, set_[farthest].nearest, division);
  if (!is_divided) halve(piece, division);
  const Piece parent{piece.corners, std::min(upper + rounding_, piece.upper), piece.depth};
  push_polygon(division.first, parent);
  push_polygon(division.second, parent);
}

}  // namespace algebra3d::distances
