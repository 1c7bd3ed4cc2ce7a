#include "algebra3d/arrangement/overlay.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "algebra3d/arrangement/bucket_sort.h"
#include "algebra3d/halfedge/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {
namespace {

/// A segment or a touched vertex in one plane.
struct Element {
  std::uint32_t plane;
  std::uint32_t segment;  ///< kNone for a vertex
  std::uint32_t from, to;
  std::uint32_t facet;  ///< that holds it; kNone if there are several
  bool is_boundary;     ///< of a facet

  std::uint64_t line() const { return std::uint64_t{plane} << 32U | segment; }
  auto place() const { return std::pair(line(), from); }

  bool is_vertex() const { return segment == kNone; }
};

/// Requires that the vertex lies on the segment's line.
void cut_if_inside(Skeleton& skeleton, std::uint32_t number, std::uint32_t vertex) {
  const Segment& segment = skeleton.segments()[number];
  if (vertex == segment.from || vertex == segment.to) return;
  const VertexPool& vertices = skeleton.vertices();
  const auto from_start = compare(vertices[segment.from], vertices[vertex]);
  if (from_start == compare(vertices[vertex], vertices[segment.to])) skeleton.cut(number, vertex);
}

class PlaneOverlay {
 public:
  PlaneOverlay(Skeleton& skeleton, std::span<const Element> elements)
      : skeleton_(skeleton),
        elements_(elements),
        plane_(elements.front().plane),
        projection_(skeleton.facets().planes()[plane_].projection) {}

  void run();

 private:
  /// More elements than this are paired by a tree of their boxes.
  static constexpr std::size_t kFewElements = 24;

  Box3 box_of(const Element& element) const;
  void relate(const Element& a, const Element& b);
  void relate_vertex(const Element& vertex, const Element& segment);
  void cross(const Element& a, const Element& b);
  void cut_if_inside(const Element& element, std::uint32_t vertex) {
    arrangement::cut_if_inside(skeleton_, element.segment, vertex);
  }
  std::uint32_t plane_across(const Element& element) const;
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    if (a == b || b == c || a == c) return 0;
    return orient2d(projection_, vertices()[a], vertices()[b], vertices()[c]);
  }
  const VertexPool& vertices() const { return skeleton_.vertices(); }

  Skeleton& skeleton_;
  std::span<const Element> elements_;
  std::uint32_t plane_;
  Projection projection_;
};

Box3 PlaneOverlay::box_of(const Element& element) const {
  Box3 box = algebra3d::box_of(vertices()[element.from]);
  box.extend(algebra3d::box_of(vertices()[element.to]));
  return box;
}

void PlaneOverlay::run() {
  if (elements_.size() < 2) return;
  std::vector<rtree::Entry<std::uint32_t>> boxes;
  for (std::uint32_t e = 0; e < elements_.size(); ++e) boxes.push_back({box_of(elements_[e]), e});
  if (elements_.size() <= kFewElements) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (boxes[i].box.intersects(boxes[j].box)) relate(elements_[i], elements_[j]);
    return;
  }
  const auto tree = rtree::RTree<std::uint32_t>::bulk_load(boxes);
  auto pairs = tree.self_join();
  while (const auto pair = pairs.next()) relate(elements_[pair->first], elements_[pair->second]);
}

void PlaneOverlay::relate(const Element& a, const Element& b) {
  if (a.segment == b.segment) return;  // also two vertices
  if (a.facet == b.facet && a.facet != kNone && (a.is_boundary || b.is_boundary)) return;
  if (a.is_vertex()) return relate_vertex(a, b);
  if (b.is_vertex()) return relate_vertex(b, a);
  const int b_from = turn(a.from, a.to, b.from), b_to = turn(a.from, a.to, b.to);
  if (b_from == 0 && b_to == 0) return skeleton_.note_one_line(a.segment, b.segment);
  if (b_from * b_to > 0) return;
  const int a_from = turn(b.from, b.to, a.from), a_to = turn(b.from, b.to, a.to);
  if (a_from * a_to > 0) return;
  if (b_from == 0) cut_if_inside(a, b.from);
  if (b_to == 0) cut_if_inside(a, b.to);
  if (a_from == 0) cut_if_inside(b, a.from);
  if (a_to == 0) cut_if_inside(b, a.to);
  if (b_from * b_to < 0 && a_from * a_to < 0) cross(a, b);
}

void PlaneOverlay::relate_vertex(const Element& vertex, const Element& segment) {
  if (turn(segment.from, segment.to, vertex.from) == 0) cut_if_inside(segment, vertex.from);
}

/// A plane through the segment other than this one; kNone if it is an edge of an operand.
std::uint32_t PlaneOverlay::plane_across(const Element& element) const {
  if (skeleton_.segments()[element.segment].edge != kNone) return kNone;
  return skeleton_.other_plane(element.segment, plane_);
}

void PlaneOverlay::cross(const Element& a, const Element& b) {
  const std::uint32_t across_a = plane_across(a), across_b = plane_across(b);
  std::uint32_t vertex = kNone;
  if (across_a != kNone && across_b != kNone)
    vertex = skeleton_.crossing_of_planes(plane_, across_a, across_b);
  else if (across_a != kNone)
    vertex = skeleton_.crossing_of_plane({skeleton_.segments()[b.segment].edge, across_a});
  else if (across_b != kNone)
    vertex = skeleton_.crossing_of_plane({skeleton_.segments()[a.segment].edge, across_b});
  else
    vertex = skeleton_.crossing_of_edges(skeleton_.segments()[a.segment].edge, skeleton_.segments()[b.segment].edge,
                                         projection_);
  skeleton_.cut(a.segment, vertex);
  skeleton_.cut(b.segment, vertex);
}

/// Cuts segments of one line at each other's ends and cuts, whichever plane has found these.
void share_cuts(Skeleton& skeleton) {
  DisjointSets lines(skeleton.segments().size());
  std::vector<bool> is_shared(skeleton.segments().size());
  for (const auto& [a, b] : skeleton.one_line()) {
    lines.unite(a, b);
    is_shared[a] = is_shared[b] = true;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;  // of each line: line, vertex
  for (std::uint32_t s = 0; s < is_shared.size(); ++s) {
    if (!is_shared[s]) continue;
    vertices.emplace_back(lines.find(s), skeleton.segments()[s].from);
    vertices.emplace_back(lines.find(s), skeleton.segments()[s].to);
  }
  for (const auto& [segment, vertex] : skeleton.cuts())
    if (is_shared[segment]) vertices.emplace_back(lines.find(segment), vertex);
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (std::uint32_t s = 0; s < is_shared.size(); ++s) {
    if (!is_shared[s]) continue;
    const std::uint32_t line = lines.find(s);
    for (auto v = std::ranges::lower_bound(vertices, std::pair(line, 0U)); v != vertices.end() && v->first == line; ++v)
      cut_if_inside(skeleton, s, v->second);
  }
}

std::vector<Element> collect_elements(const Skeleton& skeleton) {
  std::vector<Element> elements;
  const Facets& facets = skeleton.facets();
  for (const Incidence& incidence : skeleton.incidences()) {
    const Segment& segment = skeleton.segments()[incidence.segment];
    elements.push_back({facets[incidence.facet].plane, incidence.segment, segment.from, segment.to, incidence.facet,
                        incidence.side != Side::both});
  }
  for (const auto& [facet, vertex] : skeleton.touches())
    elements.push_back({facets[facet].plane, kNone, vertex, vertex, facet, false});
  const auto is_less = [](const Element& a, const Element& b) {
    const std::uint64_t line_a = a.line(), line_b = b.line();
    if (line_a != line_b) return line_a < line_b;
    return std::tuple(a.from, a.facet, a.is_boundary) < std::tuple(b.from, b.facet, b.is_boundary);
  };
  bucket_sort(
      elements, facets.planes().size(), [](const Element& e) { return e.plane; }, is_less);
  // Each once, however many facets hold it.
  std::vector<Element> distinct;
  for (const Element& element : elements) {
    if (distinct.empty() || distinct.back().place() != element.place()) {
      distinct.push_back(element);
      continue;
    }
    if (distinct.back().facet != element.facet) distinct.back().facet = kNone;
    distinct.back().is_boundary |= element.is_boundary;
  }
  return distinct;
}

}  // namespace

Status cut_segments(Skeleton& skeleton, const Monitor& monitor, std::size_t max_cuts) {
  monitor.tell("finding crossings");
  const std::vector<Element> elements = collect_elements(skeleton);
  for (std::size_t begin = 0, end = 0; begin < elements.size(); begin = end) {
    while (end < elements.size() && elements[end].plane == elements[begin].plane) ++end;
    RETURN_IF_ERROR(monitor.check());
    PlaneOverlay(skeleton, std::span(elements).subspan(begin, end - begin)).run();
    if (skeleton.cuts().size() > max_cuts)
      return Error{ErrorCode::limit_exceeded, "triangles cut each other more than {} times", max_cuts};
  }
  share_cuts(skeleton);
  return {};
}

}  // namespace algebra3d::arrangement
