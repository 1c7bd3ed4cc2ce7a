#include "algebra3d/repair/enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace algebra3d {
namespace {

constexpr std::size_t kLines = 96;

struct Point2 {
  double u, v;
};

double doubled_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

Point2 seen_along(std::size_t axis, const Vec3& p) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

struct Hit {
  double at;
  int sign;
};

/// Where the line along the axis crosses the triangle, and which way it looks there.
std::optional<Hit> cross_line(std::size_t axis, const Point2& line, const std::array<Vec3, 3>& triangle) {
  const Point2 a = seen_along(axis, triangle[0]), b = seen_along(axis, triangle[1]), c = seen_along(axis, triangle[2]);
  const double x = doubled_area(b, c, line), y = doubled_area(c, a, line), z = doubled_area(a, b, line);
  const bool is_forward = x > 0 && y > 0 && z > 0, is_backward = x < 0 && y < 0 && z < 0;
  if (!is_forward && !is_backward) return std::nullopt;
  const double sum = x + y + z;
  return Hit{x / sum * triangle[0][axis] + y / sum * triangle[1][axis] + z / sum * triangle[2][axis],
             is_forward ? 1 : -1};
}

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::uint32_t face) {
  const auto& [a, b, c] = mesh.triangle(FaceId(face));
  const std::vector<Vec3>& points = mesh.points().approx();
  return {points[a], points[b], points[c]};
}

Vec3 normal_of(const std::array<Vec3, 3>& triangle) {
  return cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

}  // namespace

Enclosure::Enclosure(const TriangleMesh& facets) {
  choose_lines(facets);
  const auto found = crossings(facets);
  std::vector<Line> good;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i].crossings = found[i];
    if (found[i].size() % 2 != 0) continue;
    for (std::size_t k = 0; k + 1 < found[i].size(); k += 2) total_ += found[i][k + 1].at - found[i][k].at;
    good.push_back(std::move(lines_[i]));
  }
  const bool is_telling = 4 * good.size() > lines_.size() && std::isfinite(total_);
  if (!is_telling) total_ = 0;
  lines_ = is_telling ? std::move(good) : std::vector<Line>();
}

void Enclosure::choose_lines(const TriangleMesh& facets) {
  double whole = 0;
  std::vector<double> shares;
  for (std::uint32_t f = 0; f < facets.face_count(); ++f) {
    shares.push_back(length(normal_of(corners_of(facets, f))));
    whole += shares.back();
  }
  if (!(whole > 0 && std::isfinite(whole))) return;
  // A few large sheets are not to have all lines.
  for (double& share : shares) share = share / whole + 1 / static_cast<double>(shares.size());
  double so_far = 0;
  std::size_t next = 0;
  for (std::uint32_t f = 0; f < facets.face_count() && next < kLines; ++f) {
    so_far += shares[f];
    for (; next < kLines && so_far > 2 * (static_cast<double>(next) + 0.5) / kLines; ++next) {
      // Somewhere within the facet, never the same place twice, and hardly ever above an edge of another one.
      const double turn = std::fmod(0.5 + static_cast<double>(next) * 0.6180339887498949, 1.0);
      const double first = 0.2 + 0.3 * turn, second = 0.15 + 0.3 * std::fmod(turn * 7.7390123, 1.0);
      const std::array<Vec3, 3> c = corners_of(facets, f);
      const Vec3 normal = normal_of(c), place = first * c[0] + second * c[1] + (1 - first - second) * c[2];
      std::size_t axis = 0;
      for (const std::size_t other : {1, 2})
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
      const Point2 line = seen_along(axis, place);
      lines_.push_back({axis, line.u, line.v, {}});
    }
  }
  std::ranges::sort(lines_, {}, [](const Line& line) { return std::tuple(line.axis, line.u, line.v); });
}

/// Ascending, of each line.
std::vector<std::vector<Enclosure::Crossing>> Enclosure::crossings(const TriangleMesh& mesh) const {
  std::vector<std::vector<Crossing>> result(lines_.size());
  std::array<std::size_t, 4> first_of_axis{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    first_of_axis[axis + 1] =
        static_cast<std::size_t>(std::ranges::upper_bound(lines_, axis, {}, &Line::axis) - lines_.begin());
  std::array<std::vector<double>, 3> us;  // close together, for most facets meet no line
  for (const Line& line : lines_) us[line.axis].push_back(line.u);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::array<Vec3, 3> c = corners_of(mesh, f);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const double low = std::min({c[0][u], c[1][u], c[2][u]}), high = std::max({c[0][u], c[1][u], c[2][u]});
      for (auto at = std::ranges::lower_bound(us[axis], low); at != us[axis].end() && *at <= high; ++at) {
        const std::size_t i = first_of_axis[axis] + static_cast<std::size_t>(at - us[axis].begin());
        const auto hit = cross_line(axis, {lines_[i].u, lines_[i].v}, c);
        if (!hit) continue;
        TriangleMesh::Triangle corners = mesh.triangle(FaceId(f));
        std::ranges::sort(corners);
        result[i].push_back({hit->at, hit->sign, corners});
      }
    }
  }
  const auto order = [](const Crossing& crossing) { return std::tuple(crossing.at, crossing.corners); };
  for (std::vector<Crossing>& list : result) {
    std::ranges::sort(list, {}, order);
    const auto is_same = [](const Crossing& a, const Crossing& b) { return a.corners == b.corners; };
    list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
  }
  return result;
}

Agreement Enclosure::compare(const TriangleMesh& solid) const {
  Agreement result;
  const auto found = crossings(solid);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (found[i].size() % 2 != 0) continue;
    struct Event {
      double at;
      int sign;
      bool is_of_solid;
    };
    std::vector<Event> events;
    for (const Crossing& c : lines_[i].crossings) events.push_back({c.at, c.sign, false});
    for (const Crossing& c : found[i]) events.push_back({c.at, c.sign, true});
    std::ranges::sort(events, {}, [](const Event& e) { return std::tuple(e.at, e.is_of_solid); });
    bool is_enclosed = false, is_held = false;
    int winding = 0;
    for (std::size_t k = 0; k + 1 < events.size(); ++k) {
      if (events[k].is_of_solid) {
        is_held = !is_held;
      } else {
        is_enclosed = !is_enclosed;
        winding += events[k].sign;
      }
      const double way = events[k + 1].at - events[k].at;
      if (is_enclosed) result.enclosed += way;
      if (is_enclosed && !is_held) result.lost += way;
      if (is_held) result.held += way;
      if (is_held && !is_enclosed && winding == 0) result.added += way;
    }
  }
  return result;
}

}  // namespace algebra3d
