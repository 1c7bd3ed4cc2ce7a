#include "algebra3d/kernel/rounding/detail/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace algebra3d {
namespace {

/// Where the foot of a point on a line lies: 0 at the first of two points of the line, 1 at the second.
double parameter_of_foot(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 way = to - from;
  return dot(point - from, way) / dot(way, way);
}

/// The chain without links that are taken back at once.
std::vector<PointId> without_spikes(const std::vector<PointId>& chain) {
  std::vector<PointId> result;
  for (const PointId point : chain) {
    if (result.size() >= 2 && result[result.size() - 2] == point)
      result.pop_back();
    else
      result.push_back(point);
  }
  return result;
}

}  // namespace

ChainId EdgeChains::add(PointId from, PointId to) {
  detours_.push_back(0);
  return chains_.push_back({from, to});
}

double EdgeChains::distance(ChainLink link, PointId point) const {
  constexpr double kNotBeside = std::numeric_limits<double>::infinity();
  const auto [from, to] = ends(link);
  if (point == from || point == to) return kNotBeside;
  const Vec3 way = points_[to] - points_[from];
  const Vec3 there = points_[point] - points_[from], rest = points_[to] - points_[point];
  // So that a link is routed through further points only so often.
  if (!(dot(there, there) < dot(way, way) && dot(rest, rest) < dot(way, way))) return kNotBeside;
  const Vec3 across = there - parameter_of_foot(points_[from], points_[to], points_[point]) * way;
  return std::hypot(across.x, across.y, across.z);
}

/// By link; each once.
void EdgeChains::sort_insertions() {
  const auto key = [](const Insertion& i) { return std::tuple(i.link.chain, i.link.index, i.point); };
  std::ranges::sort(insertions_, {}, key);
  const auto is_same = [&](const Insertion& a, const Insertion& b) { return key(a) == key(b); };
  insertions_.erase(std::unique(insertions_.begin(), insertions_.end(), is_same), insertions_.end());
}

std::vector<ChainId> EdgeChains::apply() {
  sort_insertions();
  std::vector<ChainId> changed;
  for (std::size_t begin = 0, end = 0; begin < insertions_.size(); begin = end) {
    while (end < insertions_.size() && insertions_[end].link.chain == insertions_[begin].link.chain) ++end;
    changed.push_back(insertions_[begin].link.chain);
    refine(changed.back(), std::span(insertions_).subspan(begin, end - begin));
  }
  insertions_.clear();
  return changed;
}

/// Applies the insertions into one chain, which ascend by link.
void EdgeChains::refine(ChainId id, std::span<const Insertion> insertions) {
  const std::vector<PointId>& chain = chains_[id];
  std::vector<PointId> refined;
  double detour = 0;
  auto next = insertions.begin();
  for (std::uint32_t index = 0; index + 1 < chain.size(); ++index) {
    refined.push_back(chain[index]);
    std::vector<std::pair<double, PointId>> inner;
    for (; next != insertions.end() && next->link.index == index; ++next) {
      detour = std::max(detour, distance(next->link, next->point));
      inner.emplace_back(parameter_of_foot(points_[chain[index]], points_[chain[index + 1]], points_[next->point]),
                         next->point);
    }
    std::ranges::sort(inner);
    for (const auto& [parameter, point] : inner) refined.push_back(point);
  }
  refined.push_back(chain.back());
  chains_[id] = without_spikes(refined);
  detours_[id] += detour;
}

double EdgeChains::largest_detour() const {
  return detours_.empty() ? 0 : std::ranges::max(detours_.values());
}

}  // namespace algebra3d
