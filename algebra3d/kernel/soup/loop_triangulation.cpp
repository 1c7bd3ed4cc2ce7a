#include "algebra3d/kernel/soup/loop_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace algebra3d {
namespace {

/// The cost of a triangulation: the bend first, then the area.
struct Cost {
  double bend = 0, area = 0;

  friend auto operator<=>(const Cost&, const Cost&) = default;
  friend Cost operator+(const Cost& a, const Cost& b) { return {std::max(a.bend, b.bend), a.area + b.area}; }
};
/// Degenerate triangles are taken only where nothing else is left.
constexpr double kWorseThanAnyBend = 4e6;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The bend between two triangles with these normals, in steps so coarse that rounding does not decide.
double bend(const Vec3& normal, const Vec3& other) {
  const double lengths = length(normal) * length(other);
  if (!(lengths > 0)) return 0;
  const double cosine = std::clamp(dot(normal, other) / lengths, -1.0, 1.0);
  return std::round((1 - cosine) * 1e6);
}

/// The best triangulation of each part of a loop between two of its corners, by dynamic programming.
class LoopTriangulation {
 public:
  LoopTriangulation(const Loop& loop, LoopMeasure measure) : loop_(loop), measure_(measure), n_(loop.corners.size()) {
    cost_.assign(n_ * n_, {kInfinite, kInfinite});
    apex_.assign(n_ * n_, 0);
  }

  std::vector<TriangleMesh::Triangle> run() {
    for (std::size_t i = 0; i + 1 < n_; ++i) cost_[at(i, i + 1)] = {};
    for (std::size_t width = 2; width < n_; ++width)
      for (std::size_t first = 0; first + width < n_; ++first) choose_apex(first, first + width);
    std::vector<TriangleMesh::Triangle> result;
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, n_ - 1}};
    while (!parts.empty()) {
      const auto [first, last] = parts.back();
      parts.pop_back();
      if (last - first < 2) continue;
      const std::size_t apex = apex_[at(first, last)];
      result.push_back(
          {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(apex), static_cast<std::uint32_t>(last)});
      parts.emplace_back(first, apex);
      parts.emplace_back(apex, last);
    }
    return result;
  }

 private:
  std::size_t at(std::size_t first, std::size_t last) const { return first * n_ + last; }
  Vec3 normal(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3& p = loop_.corners[a];
    return cross(loop_.corners[b] - p, loop_.corners[c] - p);
  }
  /// The normal of the triangle beyond the line from one corner to another: the one chosen for the part between them,
  /// or the one outside of the loop.
  Vec3 normal_beyond(std::size_t first, std::size_t last) const {
    if (last - first > 1) return normal(first, apex_[at(first, last)], last);
    return outer_normal(first);
  }
  /// The normal of the triangle outside of the loop, at the edge from a corner on; zero if there is none.
  Vec3 outer_normal(std::size_t corner) const {
    const Vec3 &from = loop_.corners[corner], &to = loop_.corners[(corner + 1) % n_];
    // It runs along its edge against the loop.
    return cross(from - to, loop_.beyond[corner] - to);
  }

  /// True if three corners with that normal lie on one line, as far as rounding shows it.
  bool is_flat(const Vec3& normal, std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3 one = loop_.corners[b] - loop_.corners[a], other = loop_.corners[c] - loop_.corners[a];
    return dot(normal, normal) <= 1e-24 * dot(one, one) * dot(other, other);
  }

  void choose_apex(std::size_t first, std::size_t last) {
    Cost& best = cost_[at(first, last)];
    for (std::size_t apex = first + 1; apex < last; ++apex) {
      const Vec3 own = normal(first, apex, last);
      Cost cost{0, length(own) / 2};
      if (measure_ == LoopMeasure::bend) {
        cost.bend = std::max(bend(own, normal_beyond(first, apex)), bend(own, normal_beyond(apex, last)));
        if (first == 0 && last + 1 == n_) cost.bend = std::max(cost.bend, bend(own, outer_normal(last)));
      }
      if (is_flat(own, first, apex, last)) cost.bend = kWorseThanAnyBend;
      cost = cost + cost_[at(first, apex)] + cost_[at(apex, last)];
      if (!(cost < best)) continue;
      best = cost;
      apex_[at(first, last)] = apex;
    }
  }

  const Loop& loop_;
  LoopMeasure measure_;
  std::size_t n_;
  std::vector<Cost> cost_;
  std::vector<std::size_t> apex_;
};

/// The two corners with the shortest line between them, in terms of the length of the loop between them either way.
std::pair<std::size_t, std::size_t> best_cut(const Loop& loop) {
  const std::size_t n = loop.corners.size();
  std::vector<double> along(2 * n + 1, 0);
  for (std::size_t i = 0; i < 2 * n; ++i)
    along[i + 1] = along[i] + length(loop.corners[(i + 1) % n] - loop.corners[i % n]);
  double best = kInfinite;
  std::pair<std::size_t, std::size_t> cut{0, n / 2};
  // Neither part may be a small rest; so the cuts of a loop are few. Of a large loop some corners are looked at.
  constexpr std::size_t kMostTried = 256;
  const std::size_t smallest = n / 4, stride = (n + kMostTried - 1) / kMostTried;
  for (std::size_t i = 0; i < n; i += stride)
    for (std::size_t j = i + smallest; j < n && j + smallest <= i + n; j += stride) {
      const double shorter_way = std::min(along[j] - along[i], along[n] - (along[j] - along[i]));
      const double ratio = length(loop.corners[j] - loop.corners[i]) / shorter_way;
      if (!(ratio < best)) continue;
      best = ratio;
      cut = {i, j};
    }
  return cut;
}

/// The loop scaled to a size of about 1, so that no product of lengths is infinite. The factor is a power of two, which
/// decides nothing.
Loop scaled(Loop loop) {
  double size = 0;
  for (const auto* points : {&loop.corners, &loop.beyond})
    for (const Vec3& p : *points) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (size == 0) return loop;
  const int exponent = -std::ilogb(size);
  for (auto* points : {&loop.corners, &loop.beyond})
    for (Vec3& p : *points) p = {std::scalbn(p.x, exponent), std::scalbn(p.y, exponent), std::scalbn(p.z, exponent)};
  return loop;
}

/// A part of a loop, or all of it.
struct LoopPart {
  Loop loop;
  std::vector<std::uint32_t> numbers;  // of its corners in the whole loop
};

/// The part from one corner of a loop to another, closed by a straight line.
LoopPart part_between(const LoopPart& whole, std::size_t first, std::size_t last) {
  const std::size_t n = whole.numbers.size();
  LoopPart part;
  for (std::size_t i = first; i <= last; ++i) {
    part.loop.corners.push_back(whole.loop.corners[i % n]);
    // The corner beyond the line is not known.
    part.loop.beyond.push_back(i < last ? whole.loop.beyond[i % n] : whole.loop.corners[i % n]);
    part.numbers.push_back(whole.numbers[i % n]);
  }
  return part;
}

std::array<LoopPart, 2> halves(const LoopPart& part) {
  const auto [from, to] = best_cut(part.loop);
  return {part_between(part, from, to), part_between(part, to, from + part.numbers.size())};
}

}  // namespace

std::vector<TriangleMesh::Triangle> triangulate_loop(const Loop& loop, LoopMeasure measure) {
  std::vector<TriangleMesh::Triangle> result;
  std::vector<LoopPart> parts{{scaled(loop), {}}};
  parts[0].numbers.resize(loop.corners.size());
  std::iota(parts[0].numbers.begin(), parts[0].numbers.end(), 0U);
  while (!parts.empty()) {
    const LoopPart part = std::move(parts.back());
    parts.pop_back();
    const bool is_whole = part.numbers.size() == loop.corners.size();
    if (part.numbers.size() > (is_whole ? kMaxOptimal : kPartSize)) {
      for (LoopPart& half : halves(part)) parts.push_back(std::move(half));
      continue;
    }
    for (const auto& [a, b, c] : LoopTriangulation(part.loop, measure).run())
      result.push_back({part.numbers[a], part.numbers[b], part.numbers[c]});
  }
  return result;
}

}  // namespace algebra3d
