#include "algebra3d/repair/loop_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace algebra3d {
namespace {

/// What a triangulation costs: less is better, the bend first.
struct Cost {
  double bend = 0, area = 0;

  friend auto operator<=>(const Cost&, const Cost&) = default;
  friend Cost operator+(const Cost& a, const Cost& b) { return {std::max(a.bend, b.bend), a.area + b.area}; }
};
/// So that triangles without area are chosen where nothing else is left.
constexpr double kWorseThanAnyBend = 4e6;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Angle by which the surface bends from one triangle to the next, in steps so coarse that rounding does not decide.
double bend(const Vec3& normal, const Vec3& other) {
  const double lengths = length(normal) * length(other);
  if (!(lengths > 0)) return 0;
  const double cosine = std::clamp(dot(normal, other) / lengths, -1.0, 1.0);
  return std::round((1 - cosine) * 1e6);
}

/// The best triangulation of each part of the loop between two of its corners.
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
  /// Of what is beyond the part's edge from one corner to another, as seen from within: the triangle outside of the
  /// loop, or the one chosen for that part.
  Vec3 normal_beyond(std::size_t first, std::size_t last) const {
    if (last - first > 1) return normal(first, apex_[at(first, last)], last);
    return outer_normal(first);
  }
  /// Of the triangle outside of the loop at the edge from a corner on; zero if there is none.
  Vec3 outer_normal(std::size_t corner) const {
    const Vec3 &from = loop_.corners[corner], &to = loop_.corners[(corner + 1) % n_];
    // It runs along its edge against the loop.
    return cross(from - to, loop_.beyond[corner] - to);
  }

  /// True if the corners lie on one line, as far as rounding can tell; `normal` is theirs.
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

/// Two corners that are near to each other, for what the loop between them measures both ways.
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

/// The loop at a size of about 1, so that no product of lengths is infinite: by a power of two, which decides nothing.
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

}  // namespace

std::vector<TriangleMesh::Triangle> triangulate_loop(const Loop& loop, LoopMeasure measure) {
  struct Part {
    Loop loop;
    std::vector<std::uint32_t> numbers;  // of its corners in the whole loop
  };
  std::vector<TriangleMesh::Triangle> result;
  std::vector<Part> parts{{scaled(loop), {}}};
  for (std::uint32_t i = 0; i < loop.corners.size(); ++i) parts[0].numbers.push_back(i);
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    const std::size_t n = part.numbers.size();
    if (n <= (n == loop.corners.size() ? kMaxOptimal : kPartSize)) {
      for (TriangleMesh::Triangle triangle : LoopTriangulation(part.loop, measure).run()) {
        for (std::uint32_t& corner : triangle) corner = part.numbers[corner];
        result.push_back(triangle);
      }
      continue;
    }
    const auto [from, to] = best_cut(part.loop);
    for (const auto& [first, last] : {std::pair(from, to), std::pair(to, from + n)}) {
      Part& piece = parts.emplace_back();
      for (std::size_t i = first; i <= last; ++i) {
        piece.loop.corners.push_back(part.loop.corners[i % n]);
        // Beyond the cut nothing is known.
        piece.loop.beyond.push_back(i < last ? part.loop.beyond[i % n] : part.loop.corners[i % n]);
        piece.numbers.push_back(part.numbers[i % n]);
      }
    }
  }
  return result;
}

}  // namespace algebra3d
