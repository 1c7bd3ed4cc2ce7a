#include "algebra3d/kernel/simplification/detail/edge_collapser.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "algebra3d/base/box3.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "base/scheduler.h"

namespace algebra3d {
namespace {

using Place = CollapseMesh::Place;
using Ring = CollapseMesh::Ring;

constexpr std::size_t kGrain = 1U << 13U;
/// Rounding errors of a quadric in the frame, by its weight.
constexpr double kNoise = 4e-15;
/// Shorter edges first where the cost is equal, as in a plane: otherwise a few vertices get all the faces there.
constexpr double kLengthWeight = 1e-9;
/// The cosine of the largest angle by which a collapse turns a face.
constexpr double kLeastCosine = 0.2;
/// The least square of twice the area of a face, by the fourth power of its longest edge.
constexpr double kLeastFlatness = 1e-12;
/// Features are held by planes through their edges, across the faces.
constexpr double kFeatureWeight = 4;
/// Buckets after which a collapse that was refused is tried again.
constexpr std::size_t kRetry = CostBuckets::kPerOctave / 4;

double squared(const Vec3& v) {
  return dot(v, v);
}

}  // namespace

EdgeCollapser::EdgeCollapser(const TriangleMesh& mesh, const CollapseConstraints& constraints, const Monitor& monitor)
    : mesh_(mesh),
      monitor_(monitor),
      faces_(mesh),
      positions_(mesh.vertex_count()),
      quadrics_(mesh.vertex_count()),
      sources_(mesh.vertex_count()),
      holds_(mesh.vertex_count(), Hold::none) {
  for (std::size_t v = 0; v < constraints.locked.size(); ++v)
    if (constraints.locked[v] != 0) faces_.lock(static_cast<std::uint32_t>(v));
  find_frame();
  find_quadrics();
  if (constraints.crease_degrees < 180) find_creases(constraints.crease_degrees);
  find_holds();
  add_feature_quadrics();
}

Vec3 EdgeCollapser::framed(const Vec3& p) const {
  return {(p.x - centre_.x) / unit_, (p.y - centre_.y) / unit_, (p.z - centre_.z) / unit_};
}

Vec3 EdgeCollapser::unframed(const Vec3& p) const {
  return centre_ + unit_ * p;
}

void EdgeCollapser::find_frame() {
  const std::vector<Vec3>& points = mesh_.points().approx();
  const Box3 box = Box3::around(points);
  centre_ = 0.5 * box.min + 0.5 * box.max;
  unit_ = length_unit(box);
  parallel_for(points.size(), kGrain, [&](std::size_t v) {
    positions_[v] = framed(points[v]);
    sources_[v] = static_cast<std::uint32_t>(v);
  });
}

/// The unit normal of a face; zero for a face without area.
Vec3 EdgeCollapser::face_normal(std::uint32_t f) const {
  const auto& [a, b, c] = faces_.corners(f);
  const Vec3 normal = cross(positions_[b] - positions_[a], positions_[c] - positions_[a]);
  const double twice_area = std::sqrt(squared(normal));
  return twice_area > 0 ? (1 / twice_area) * normal : Vec3{};
}

Quadric EdgeCollapser::face_quadric(std::uint32_t f) const {
  const Vec3 n = face_normal(f);
  Quadric quadric;
  if (squared(n) > 0) quadric.add_plane(n, -dot(n, positions_[faces_.corners(f)[0]]), 1);
  return quadric;
}

void EdgeCollapser::find_quadrics() {
  // Each vertex gathers from its faces, so that the sum does not depend on the division of the work.
  parallel_for(positions_.size(), kGrain, [&](std::size_t v) {
    if (monitor_.is_cancelled()) return;
    Quadric sum;
    if (faces_.place(static_cast<std::uint32_t>(v)) != Place::locked) {
      HalfedgeId h = mesh_.outgoing(VertexId(v));
      const HalfedgeId first = h;
      do {
        sum += face_quadric(TriangleMesh::face(h).index());
        h = mesh_.opposite(TriangleMesh::prev(h));
      } while (h.is_valid() && h != first);
    }
    quadrics_[v] = sum;
  });
}

void EdgeCollapser::find_creases(double crease_degrees) {
  const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  // Each face marks its own half-edges.
  parallel_for(faces_.face_slots(), kGrain, [&](std::size_t f) {
    if (monitor_.is_cancelled()) return;
    const Vec3 normal = face_normal(static_cast<std::uint32_t>(f));
    for (auto h = static_cast<std::uint32_t>(4 * f); h < 4 * f + 3; ++h) {
      if (faces_.opposite(h) == kNone) continue;
      const Vec3 other = face_normal(CollapseMesh::face(faces_.opposite(h)));
      const bool have_area = squared(normal) > 0 && squared(other) > 0;
      if (have_area && dot(normal, other) < least_cosine) faces_.set_crease(h);
    }
  });
}

/// A vertex in the middle of a feature has two edges of features.
void EdgeCollapser::find_holds() {
  std::vector<std::uint8_t> counts(positions_.size(), 0);
  const auto count = [&](std::uint32_t v) { counts[v] = static_cast<std::uint8_t>(std::min(counts[v] + 1, 3)); };
  for (std::uint32_t f = 0; f < faces_.face_slots() && !monitor_.is_cancelled(); ++f)
    for (std::uint32_t h = 4 * f; h < 4 * f + 3; ++h) {
      if (!is_feature(h) || faces_.opposite(h) < h) continue;
      count(faces_.origin(h));
      count(faces_.target(h));
    }
  for (std::size_t v = 0; v < counts.size(); ++v)
    if (counts[v] > 0) holds_[v] = counts[v] == 2 ? Hold::on_feature : Hold::fixed;
}

void EdgeCollapser::add_feature_quadrics() {
  for (std::uint32_t f = 0; f < faces_.face_slots() && !monitor_.is_cancelled(); ++f) {
    for (std::uint32_t h = 4 * f; h < 4 * f + 3; ++h) {
      if (!is_feature(h)) continue;
      const Vec3 &from = positions_[faces_.origin(h)], &to = positions_[faces_.target(h)];
      const Vec3 along = to - from;
      const Vec3 across = cross(along, cross(along, positions_[faces_.origin(CollapseMesh::prev(h))] - from));
      const double size = std::sqrt(squared(across));
      if (!(size > 0)) continue;
      const Vec3 n = (1 / size) * across;
      for (const std::uint32_t v : {faces_.origin(h), faces_.target(h)})
        quadrics_[v].add_plane(n, -dot(n, from), kFeatureWeight);
    }
  }
}

/// The places for the vertex that the edge becomes, the best one first; none if a feature must not be left.
EdgeCollapser::Candidates EdgeCollapser::candidates(std::uint32_t h) const {
  const std::uint32_t a = faces_.origin(h), b = faces_.target(h);
  const Quadric sum = quadrics_[a] + quadrics_[b];
  const Vec3 &from = positions_[a], &to = positions_[b];
  Candidates result;
  const auto add_end = [&](std::uint32_t v) {
    result.places[result.count++] = {positions_[v], sum.at(positions_[v]), sources_[v]};
  };
  // On a feature a vertex stays at the place of one: of two that are held differently, of the one that is held more.
  const Hold hold_a = holds_[a], hold_b = holds_[b];
  const bool are_both_held = hold_a != Hold::none && hold_b != Hold::none;
  if (are_both_held && (!is_feature(h) || (hold_a == Hold::fixed && hold_b == Hold::fixed))) return result;
  if (hold_a >= hold_b) add_end(a);
  if (hold_b >= hold_a) add_end(b);
  if (hold_a != hold_b) return result;
  if (result.places[1].cost < result.places[0].cost) std::swap(result.places[0], result.places[1]);
  if (are_both_held || result.places[0].cost <= kNoise * sum.trace()) return result;
  const Vec3 best = sum.minimum(0.5 * from + 0.5 * to);
  // Far off the edge it is no better than a guess.
  const double length = squared(to - from);
  if (!(squared(best - from) <= 4 * length && squared(best - to) <= 4 * length)) return result;
  const double cost = sum.at(best);
  if (!(cost < result.places[0].cost)) return result;
  result.places[2] = result.places[1];
  result.places[1] = result.places[0];
  result.places[0] = {best, cost, kNone};
  result.count = 3;
  return result;
}

double EdgeCollapser::penalty(std::uint32_t h) const {
  return kLengthWeight * squared(positions_[faces_.target(h)] - positions_[faces_.origin(h)]);
}

void EdgeCollapser::push(std::uint32_t h, std::size_t bucket) {
  if (bucket >= CostBuckets::kCount) return;
  faces_.set_queued(h);
  queue_.push(bucket, h);
}

Status EdgeCollapser::fill_queue() {
  constexpr std::uint16_t kNoBucket = 0xFFFF;
  LargeVector<std::array<std::uint16_t, 3>> buckets(faces_.face_slots());
  parallel_for(faces_.face_slots(), kGrain, [&](std::size_t f) {
    for (std::uint32_t i = 0; i < 3 && !monitor_.is_cancelled(); ++i) {
      const auto h = static_cast<std::uint32_t>(4 * f + i);
      buckets[f][i] = kNoBucket;
      if (faces_.opposite(h) < h) continue;
      if (faces_.place(faces_.origin(h)) == Place::locked || faces_.place(faces_.target(h)) == Place::locked) continue;
      const Candidates places = candidates(h);
      if (places.count == 0 || places.places[0].cost > largest_cost_) continue;
      buckets[f][i] = static_cast<std::uint16_t>(CostBuckets::bucket_of(places.places[0].cost + penalty(h)));
    }
  });
  A3D_TRY(monitor_.check());
  for (std::size_t f = 0; f < buckets.size() && !monitor_.is_cancelled(); ++f)
    for (std::uint32_t i = 0; i < 3; ++i)
      if (buckets[f][i] != kNoBucket) push(static_cast<std::uint32_t>(4 * f + i), buckets[f][i]);
  return monitor_.check();
}

/// Whether a face of the ring of `keep`, but for those at `other`, turns too far or loses its area if the vertex moves.
bool EdgeCollapser::flips(std::uint32_t keep, std::uint32_t other, const Ring& ring, const Vec3& position) const {
  const Vec3& before = positions_[keep];
  return std::ranges::any_of(ring.spokes, [&](const CollapseMesh::Spoke& spoke) {
    if (spoke.first == other || spoke.second == other) return false;
    const Vec3 &p = positions_[spoke.first], &q = positions_[spoke.second];
    const Vec3 base = q - p;
    const Vec3 old_normal = cross(base, before - p), side = position - p;
    const Vec3 normal = cross(base, side);
    const double size = squared(normal), turned = dot(normal, old_normal);
    if (turned < 0 || turned * turned < kLeastCosine * kLeastCosine * size * squared(old_normal)) return true;
    const double longest = std::max({squared(base), squared(side), squared(position - q)});
    return !(size > kLeastFlatness * longest * longest);
  });
}

void EdgeCollapser::requeue_wing(std::uint32_t left, std::uint32_t right, std::size_t bucket) {
  // The two edges are one now. Whichever half-edge stood for them in the queue may be gone.
  for (const std::uint32_t h : {left, right})
    if (h != kNone && faces_.is_queued(h)) return;
  const std::uint32_t h = left != kNone ? left : right;
  if (faces_.place(faces_.origin(h)) == Place::locked || faces_.place(faces_.target(h)) == Place::locked) return;
  push(h, bucket);
}

bool EdgeCollapser::try_collapse(std::uint32_t h, const Candidates& places, std::size_t bucket) {
  const std::uint32_t a = faces_.origin(h), b = faces_.target(h);
  if (!faces_.ring_of(a, ring_a_) || !faces_.ring_of(b, ring_b_)) return false;
  if (!faces_.meets_link_condition(h, ring_a_, ring_b_)) return false;
  for (std::size_t i = 0; i < places.count; ++i) {
    const Candidate& place = places.places[i];
    if (place.cost > largest_cost_ || CostBuckets::bucket_of(place.cost + penalty(h)) > bucket) continue;
    if (flips(a, b, ring_a_, place.position) || flips(b, a, ring_b_, place.position)) continue;
    const std::uint32_t o = faces_.opposite(h);
    const std::array<std::uint32_t, 2> near{faces_.opposite(CollapseMesh::prev(h)),
                                            faces_.opposite(CollapseMesh::next(h))};
    std::array<std::uint32_t, 2> far{kNone, kNone};
    if (o != kNone) far = {faces_.opposite(CollapseMesh::prev(o)), faces_.opposite(CollapseMesh::next(o))};
    faces_.collapse(h);
    positions_[a] = place.position;
    sources_[a] = place.source;
    quadrics_[a] += quadrics_[b];
    holds_[a] = std::max(holds_[a], holds_[b]);
    requeue_wing(near[0], near[1], bucket);
    if (o != kNone) requeue_wing(far[0], far[1], bucket);
    return true;
  }
  return false;
}

/// Collapses the edge, or puts it back: its cost has grown, or it cannot be collapsed now.
void EdgeCollapser::handle(std::uint32_t h, std::size_t bucket) {
  if (!faces_.is_queued(h)) return;
  faces_.clear_queued(h);
  const Candidates places = candidates(h);
  if (places.count == 0) return;
  const double cost = places.places[0].cost;
  if (cost > largest_cost_) return;
  const std::size_t now = CostBuckets::bucket_of(cost + penalty(h));
  if (now > bucket) return push(h, now);
  if (!try_collapse(h, places, bucket)) push(h, bucket + kRetry);
}

Status EdgeCollapser::run(const CollapseLimits& limits) {
  const double error = limits.error / unit_;
  largest_cost_ = error * error + 16 * kNoise;
  A3D_TRY(monitor_.check());
  A3D_TRY(fill_queue());
  const std::size_t before = faces_.face_count();
  Stage stage(monitor_, "simplifying", before > limits.triangles ? before - limits.triangles : 0);
  for (std::size_t bucket = 0; bucket < CostBuckets::kCount; ++bucket) {
    for (std::size_t i = 0; i < queue_[bucket].size(); ++i) {
      poll_interruption_at(i);
      if (faces_.face_count() <= limits.triangles) return {};
      if (!stage.begin_step()) return Monitor::interrupted();
      const std::vector<std::uint32_t>& entries = queue_[bucket];
      if (i + 8 < entries.size()) faces_.prefetch(entries[i + 8]);
      handle(entries[i], bucket);
    }
    queue_.release(bucket);
  }
  return {};
}

TriangleMesh EdgeCollapser::result() {
  const std::vector<std::uint32_t> numbers = images();
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    count += static_cast<std::size_t>(numbers[v] != kNone && faces_.representative(v) == v);
  std::vector<Vec3> points(count);
  for (std::uint32_t v = 0; v < numbers.size(); ++v) {
    poll_interruption_at(v);
    if (numbers[v] == kNone || faces_.representative(v) != v) continue;
    points[numbers[v]] = sources_[v] != kNone ? mesh_.points().approx()[sources_[v]] : unframed(positions_[v]);
  }
  std::vector<TriangleMesh::Triangle> triangles;
  triangles.reserve(faces_.face_count());
  for (std::uint32_t f = 0; f < faces_.face_slots(); ++f) {
    poll_interruption_at(f);
    if (!faces_.is_alive(f)) continue;
    const auto& [a, b, c] = faces_.corners(f);
    triangles.push_back({numbers[a], numbers[b], numbers[c]});
  }
  return {PointArray(std::move(points)), triangles};
}

std::vector<std::uint32_t> EdgeCollapser::images() {
  std::vector<std::uint32_t> numbers(faces_.vertex_count(), kNone);
  for (std::uint32_t f = 0; f < faces_.face_slots(); ++f)
    if (faces_.is_alive(f))
      for (const std::uint32_t v : faces_.corners(f)) numbers[v] = 0;
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    if (mesh_.is_isolated(VertexId(v))) numbers[v] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t& number : numbers)
    if (number != kNone) number = count++;
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    if (const std::uint32_t r = faces_.representative(v); r != v) numbers[v] = numbers[r];
  return numbers;
}

std::vector<std::uint32_t> EdgeCollapser::face_sources() const {
  std::vector<std::uint32_t> sources;
  sources.reserve(faces_.face_count());
  for (std::uint32_t f = 0; f < faces_.face_slots(); ++f)
    if (faces_.is_alive(f)) sources.push_back(f);
  return sources;
}

std::vector<std::uint32_t> EdgeCollapser::vertex_sources() {
  const std::vector<std::uint32_t> numbers = images();
  std::vector<std::uint32_t> sources;
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    if (numbers[v] != kNone && faces_.representative(v) == v) sources.push_back(sources_[v] != kNone ? sources_[v] : v);
  return sources;
}

}  // namespace algebra3d
