#include "algebra3d/repair/facet_orientation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace algebra3d {
namespace {

constexpr std::uint32_t kNoPart = 0xFFFFFFFF;

double length(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);
}

double area(const FacetList& facets, std::size_t f) {
  return length(cross(facets.corner(f, 1) - facets.corner(f, 0), facets.corner(f, 2) - facets.corner(f, 0))) / 2;
}

/// A facet at an edge: runs along it from the smaller to the larger vertex, or back.
struct EdgeUse {
  std::uint32_t low, high, facet;
  bool is_forward;
};

class Orientation {
 public:
  explicit Orientation(FacetList& facets);

  void run(RepairReport& report);

 private:
  std::span<const EdgeUse> edge(std::size_t number) const {
    return std::span(uses_).subspan(edges_[number], edges_[number + 1] - edges_[number]);
  }
  void find_neighbours();
  void find_parts();
  void balance_parts();
  int sign(const EdgeUse& use) const { return use.is_forward != is_turned_[use.facet] ? 1 : -1; }

  FacetList& facets_;
  std::vector<EdgeUse> uses_;         // edge by edge
  std::vector<std::uint32_t> edges_;  // first use of each, and the end
  /// Per facet: those across edges of two facets, and whether they agree with it.
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> neighbours_;
  std::vector<std::uint32_t> part_of_;
  std::uint32_t part_count_ = 0;
  std::vector<bool> is_turned_;
};

Orientation::Orientation(FacetList& facets)
    : facets_(facets),
      neighbours_(facets.triangles.size()),
      part_of_(facets.triangles.size(), kNoPart),
      is_turned_(facets.triangles.size()) {
  for (std::uint32_t f = 0; f < facets.triangles.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = facets.triangles[f][i], to = facets.triangles[f][(i + 1) % 3];
      uses_.push_back({std::min(from, to), std::max(from, to), f, from < to});
    }
  std::ranges::sort(uses_, {}, [](const EdgeUse& use) { return std::tuple(use.low, use.high, use.facet); });
  for (std::uint32_t i = 0; i < uses_.size(); ++i)
    if (i == 0 || std::pair(uses_[i].low, uses_[i].high) != std::pair(uses_[i - 1].low, uses_[i - 1].high))
      edges_.push_back(i);
  edges_.push_back(static_cast<std::uint32_t>(uses_.size()));
}

void Orientation::find_neighbours() {
  for (std::size_t number = 0; number + 1 < edges_.size(); ++number) {
    const auto uses = edge(number);
    if (uses.size() != 2) continue;
    const bool agree = uses[0].is_forward != uses[1].is_forward;
    neighbours_[uses[0].facet].emplace_back(uses[1].facet, agree);
    neighbours_[uses[1].facet].emplace_back(uses[0].facet, agree);
  }
}

void Orientation::find_parts() {
  std::vector<std::uint32_t> part;
  for (std::uint32_t start = 0; start < facets_.triangles.size(); ++start) {
    if (part_of_[start] != kNoPart) continue;
    part.assign(1, start);
    part_of_[start] = part_count_;
    double turned_area = 0, other_area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      (is_turned_[part[i]] ? turned_area : other_area) += area(facets_, part[i]);
      for (const auto& [neighbour, agrees] : neighbours_[part[i]]) {
        if (part_of_[neighbour] != kNoPart) continue;
        part_of_[neighbour] = part_count_;
        is_turned_[neighbour] = is_turned_[part[i]] == agrees;
        part.push_back(neighbour);
      }
    }
    if (turned_area > other_area)
      for (const std::uint32_t facet : part) is_turned_[facet] = !is_turned_[facet];
    ++part_count_;
  }
}

/// Of edges with more than two facets, what runs one way and not the other counts by its length.
void Orientation::balance_parts() {
  struct Seam {
    double length;
    int balance = 0;
    std::vector<std::pair<std::uint32_t, int>> parts;  // ascending, with what each adds to the balance
  };
  std::vector<Seam> seams;
  std::vector<std::vector<std::uint32_t>> seams_of_part(part_count_);
  for (std::size_t number = 0; number + 1 < edges_.size(); ++number) {
    const auto uses = edge(number);
    if (uses.size() < 3) continue;
    Seam seam{length(facets_.points[uses[0].high] - facets_.points[uses[0].low]), 0, {}};
    for (const EdgeUse& use : uses) {
      seam.balance += sign(use);
      const std::uint32_t part = part_of_[use.facet];
      const auto known = std::ranges::find(seam.parts, part, &std::pair<std::uint32_t, int>::first);
      if (known != seam.parts.end())
        known->second += sign(use);
      else
        seam.parts.emplace_back(part, sign(use));
    }
    for (const auto& [part, share] : seam.parts)
      if (share != 0) seams_of_part[part].push_back(static_cast<std::uint32_t>(seams.size()));
    seams.push_back(std::move(seam));
  }
  std::vector<bool> turns(part_count_);
  constexpr int kMaxPasses = 20;
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMaxPasses; ++pass) {
    has_changed = false;
    for (std::uint32_t part = 0; part < part_count_; ++part) {
      double gain = 0;
      const auto share_of = [&](const Seam& seam) {
        return std::ranges::find(seam.parts, part, &std::pair<std::uint32_t, int>::first)->second;
      };
      for (const std::uint32_t s : seams_of_part[part])
        gain += seams[s].length * (std::abs(seams[s].balance) - std::abs(seams[s].balance - 2 * share_of(seams[s])));
      if (!(gain > 0)) continue;
      turns[part] = !turns[part];
      has_changed = true;
      for (const std::uint32_t s : seams_of_part[part]) {
        int& share = std::ranges::find(seams[s].parts, part, &std::pair<std::uint32_t, int>::first)->second;
        seams[s].balance -= 2 * share;
        share = -share;
      }
    }
  }
  for (std::size_t f = 0; f < is_turned_.size(); ++f)
    if (turns[part_of_[f]]) is_turned_[f] = !is_turned_[f];
}

void Orientation::run(RepairReport& report) {
  find_neighbours();
  find_parts();
  balance_parts();
  for (std::size_t f = 0; f < is_turned_.size(); ++f) {
    if (!is_turned_[f]) continue;
    std::swap(facets_.triangles[f][1], facets_.triangles[f][2]);
    report.add(RepairStep::turned_facets, facets_.middle(f));
  }
}

}  // namespace

void orient_facets(FacetList& facets, RepairReport& report) {
  Orientation(facets).run(report);
}

}  // namespace algebra3d
