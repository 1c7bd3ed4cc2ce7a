#include "algebra3d/repair/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace algebra3d {
namespace {

/// Where the foot of a point on a line lies, as a share of the way between two points of the line.
double share_of_way(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 way = to - from;
  return dot(point - from, way) / dot(way, way);
}

/// Without steps that are taken back at once.
std::vector<std::uint32_t> without_spikes(const std::vector<std::uint32_t>& chain) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t vertex : chain) {
    if (result.size() >= 2 && result[result.size() - 2] == vertex)
      result.pop_back();
    else
      result.push_back(vertex);
  }
  return result;
}

}  // namespace

std::uint32_t EdgeChains::add(std::uint32_t from, std::uint32_t to) {
  chains_.push_back({from, to});
  detours_.push_back(0);
  return static_cast<std::uint32_t>(chains_.size() - 1);
}

double EdgeChains::distance(ChainLink link, std::uint32_t vertex) const {
  constexpr double kNotBeside = std::numeric_limits<double>::infinity();
  const auto [from, to] = ends(link);
  if (vertex == from || vertex == to) return kNotBeside;
  const Vec3 way = points_[to] - points_[from];
  const Vec3 there = points_[vertex] - points_[from], rest = points_[to] - points_[vertex];
  // So that a link is led through further vertices only so often.
  if (!(dot(there, there) < dot(way, way) && dot(rest, rest) < dot(way, way))) return kNotBeside;
  const Vec3 across = there - share_of_way(points_[from], points_[to], points_[vertex]) * way;
  return std::hypot(across.x, across.y, across.z);
}

std::vector<std::uint32_t> EdgeChains::apply() {
  const auto place = [](const Wish& wish) { return std::tuple(wish.link.edge, wish.link.index, wish.vertex); };
  std::ranges::sort(wishes_, {}, place);
  wishes_.erase(
      std::unique(wishes_.begin(), wishes_.end(), [&](const Wish& a, const Wish& b) { return place(a) == place(b); }),
      wishes_.end());
  std::vector<std::uint32_t> changed;
  for (std::size_t begin = 0, end = 0; begin < wishes_.size(); begin = end) {
    while (end < wishes_.size() && wishes_[end].link.edge == wishes_[begin].link.edge) ++end;
    changed.push_back(wishes_[begin].link.edge);
    refine(changed.back(), std::span(wishes_).subspan(begin, end - begin));
  }
  wishes_.clear();
  return changed;
}

/// The wishes ascend by their link.
void EdgeChains::refine(std::uint32_t edge, std::span<const Wish> wishes) {
  const std::vector<std::uint32_t>& chain = chains_[edge];
  std::vector<std::uint32_t> refined;
  double detour = 0;
  auto wish = wishes.begin();
  for (std::uint32_t index = 0; index + 1 < chain.size(); ++index) {
    refined.push_back(chain[index]);
    std::vector<std::pair<double, std::uint32_t>> inner;
    for (; wish != wishes.end() && wish->link.index == index; ++wish) {
      detour = std::max(detour, distance(wish->link, wish->vertex));
      inner.emplace_back(share_of_way(points_[chain[index]], points_[chain[index + 1]], points_[wish->vertex]),
                         wish->vertex);
    }
    std::ranges::sort(inner);
    for (const auto& [share, vertex] : inner) refined.push_back(vertex);
  }
  refined.push_back(chain.back());
  chains_[edge] = without_spikes(refined);
  detours_[edge] += detour;
}

double EdgeChains::largest_detour() const {
  return detours_.empty() ? 0 : std::ranges::max(detours_);
}

}  // namespace algebra3d
