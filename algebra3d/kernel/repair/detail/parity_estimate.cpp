#include "algebra3d/kernel/repair/detail/parity_estimate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "algebra3d/kernel/halfedge/circulators.h"

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

struct LineHit {
  double at;
  int sign;
};

/// Where a line along the axis crosses the triangle, and with which orientation.
std::optional<LineHit> cross_line(std::size_t axis, const Point2& line, const std::array<Vec3, 3>& triangle) {
  const Point2 a = seen_along(axis, triangle[0]), b = seen_along(axis, triangle[1]), c = seen_along(axis, triangle[2]);
  const double x = doubled_area(b, c, line), y = doubled_area(c, a, line), z = doubled_area(a, b, line);
  const bool is_forward = x > 0 && y > 0 && z > 0, is_backward = x < 0 && y < 0 && z < 0;
  if (!is_forward && !is_backward) return std::nullopt;
  const double sum = x + y + z;
  return LineHit{x / sum * triangle[0][axis] + y / sum * triangle[1][axis] + z / sum * triangle[2][axis],
                 is_forward ? 1 : -1};
}

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, FaceId face) {
  const auto& [a, b, c] = mesh.triangle(face);
  const std::vector<Vec3>& points = mesh.points().approx();
  return {points[a], points[b], points[c]};
}

Vec3 normal_of(const std::array<Vec3, 3>& triangle) {
  return cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

std::size_t largest_axis(const Vec3& v) {
  std::size_t axis = 0;
  for (const std::size_t other : {1, 2})
    if (std::abs(v[other]) > std::abs(v[axis])) axis = other;
  return axis;
}

std::vector<FaceId> counted_faces(const TriangleMesh& mesh, const IdVector<FaceId, bool>& left_out) {
  std::vector<FaceId> result;
  for (const FaceId face : faces(mesh))
    if (left_out.empty() || !left_out[face]) result.push_back(face);
  return result;
}

/// Per face: its share of the lines, half by area, half by number; all sum up to 2. Empty if there is no area.
std::vector<double> shares_of_faces(const TriangleMesh& mesh, std::span<const FaceId> counted) {
  double whole = 0;
  std::vector<double> shares;
  for (const FaceId face : counted) {
    shares.push_back(length(normal_of(corners_of(mesh, face))));
    whole += shares.back();
  }
  if (!(whole > 0 && std::isfinite(whole))) return {};
  // A few large open patches are not to have all lines.
  for (double& share : shares) share = share / whole + 1 / static_cast<double>(shares.size());
  return shares;
}

}  // namespace

ParityEstimate::ParityEstimate(const TriangleMesh& mesh, const IdVector<FaceId, bool>& left_out) {
  const std::vector<FaceId> counted = counted_faces(mesh, left_out);
  choose_lines(mesh, counted);
  CrossingLists found = crossings(mesh, counted);
  const std::size_t line_count = lines_.size();
  std::vector<Line> good;
  for (std::size_t i = 0; i < line_count; ++i) {
    if (found[i].size() % 2 != 0) continue;
    for (std::size_t k = 0; k + 1 < found[i].size(); k += 2) total_ += found[i][k + 1].at - found[i][k].at;
    lines_[i].crossings = std::move(found[i]);
    good.push_back(std::move(lines_[i]));
  }
  const bool is_telling = 4 * good.size() > line_count && std::isfinite(total_);
  if (!is_telling) total_ = 0;
  lines_ = is_telling ? std::move(good) : std::vector<Line>();
}

/// A line through some point within the face, never the same one twice, and hardly ever over an edge of another face.
ParityEstimate::Line ParityEstimate::line_through(const TriangleMesh& mesh, FaceId face, std::size_t number) {
  const double turn = std::fmod(0.5 + static_cast<double>(number) * 0.6180339887498949, 1.0);
  const double first = 0.2 + 0.3 * turn, second = 0.15 + 0.3 * std::fmod(turn * 7.7390123, 1.0);
  const std::array<Vec3, 3> c = corners_of(mesh, face);
  const Vec3 point = first * c[0] + second * c[1] + (1 - first - second) * c[2];
  const std::size_t axis = largest_axis(normal_of(c));
  const Point2 line = seen_along(axis, point);
  return {axis, line.u, line.v, {}};
}

void ParityEstimate::choose_lines(const TriangleMesh& mesh, std::span<const FaceId> counted) {
  const std::vector<double> shares = shares_of_faces(mesh, counted);
  double so_far = 0;
  for (std::size_t f = 0; f < shares.size() && lines_.size() < kLines; ++f) {
    so_far += shares[f];
    const auto is_due = [&] { return so_far > 2 * (static_cast<double>(lines_.size()) + 0.5) / kLines; };
    while (lines_.size() < kLines && is_due()) lines_.push_back(line_through(mesh, counted[f], lines_.size()));
  }
  std::ranges::sort(lines_, {}, [](const Line& line) { return std::tuple(line.axis, line.u, line.v); });
}

/// Adds the crossings of one face to those of the lines; `us` are the lines' coordinates, for each axis.
void ParityEstimate::cross_with(const TriangleMesh& mesh, FaceId face, const std::array<std::vector<double>, 3>& us,
                                CrossingLists& result) const {
  const std::array<Vec3, 3> c = corners_of(mesh, face);
  std::size_t first_of_axis = 0;
  for (std::size_t axis = 0; axis < 3; first_of_axis += us[axis++].size()) {
    const std::size_t u = (axis + 1) % 3;
    const double low = std::min({c[0][u], c[1][u], c[2][u]}), high = std::max({c[0][u], c[1][u], c[2][u]});
    for (auto at = std::ranges::lower_bound(us[axis], low); at != us[axis].end() && *at <= high; ++at) {
      const std::size_t i = first_of_axis + static_cast<std::size_t>(at - us[axis].begin());
      const auto hit = cross_line(axis, {lines_[i].u, lines_[i].v}, c);
      if (!hit) continue;
      TriangleMesh::Triangle corners = mesh.triangle(face);
      std::ranges::sort(corners);
      result[i].push_back({hit->at, hit->sign, corners});
    }
  }
}

ParityEstimate::CrossingLists ParityEstimate::crossings(const TriangleMesh& mesh,
                                                        std::span<const FaceId> counted) const {
  CrossingLists result(lines_.size());
  std::array<std::vector<double>, 3> us;  // close together, for most faces meet no line
  for (const Line& line : lines_) us[line.axis].push_back(line.u);
  for (const FaceId face : counted) cross_with(mesh, face, us, result);
  const auto order = [](const Crossing& crossing) { return std::tuple(crossing.at, crossing.corners); };
  const auto is_same = [](const Crossing& a, const Crossing& b) { return a.corners == b.corners; };
  for (std::vector<Crossing>& list : result) {
    std::ranges::sort(list, {}, order);
    list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
  }
  return result;
}

/// Adds up what both enclose along one line.
void ParityEstimate::compare_along(const std::vector<Crossing>& given, const std::vector<Crossing>& solid,
                                   Agreement& result) {
  struct Event {
    double at;
    int sign;
    bool is_of_solid;
  };
  std::vector<Event> events;
  events.reserve(given.size() + solid.size());
  for (const Crossing& c : given) events.push_back({c.at, c.sign, false});
  for (const Crossing& c : solid) events.push_back({c.at, c.sign, true});
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
    if (is_enclosed && !is_held) result.missing += way;
    if (is_held) result.held += way;
    if (is_held && !is_enclosed && winding == 0) result.added += way;
  }
}

Agreement ParityEstimate::compare(const TriangleMesh& solid) const {
  Agreement result;
  const CrossingLists found = crossings(solid, counted_faces(solid, {}));
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (found[i].size() % 2 == 0) compare_along(lines_[i].crossings, found[i], result);
  return result;
}

}  // namespace algebra3d
