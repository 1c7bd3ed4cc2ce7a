#include "algebra3d/kernel/convex/detail/quickhull.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "algebra3d/kernel/convex/detail/hull_plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/id_vector.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

/// An undecided point, with its rounded coordinates at hand.
struct Candidate {
  Vec3 position;
  VertexId point;
};

/// The undecided points in front of one triangle. The farthest one is the last.
class OutsideSet {
 public:
  bool is_empty() const { return points_.empty(); }
  void add(const Candidate& candidate, double height) {
    points_.push_back(candidate);
    if (points_.size() > 1 && !(height > greatest_height_))
      std::swap(points_.back(), points_[points_.size() - 2]);
    else
      greatest_height_ = height;
  }
  Candidate take_farthest() {
    const Candidate farthest = points_.back();
    points_.pop_back();
    return farthest;
  }
  /// Moves all points to the end of a list. Keeps the memory.
  void move_to(std::vector<Candidate>& all) {
    all.insert(all.end(), points_.begin(), points_.end());
    points_.clear();
  }

 private:
  std::vector<Candidate> points_;
  double greatest_height_ = 0;
};

struct Face {
  HullTriangle triangle;
  HullPlane plane;
  OutsideSet outside;
  bool is_alive = true;
  bool is_visible = false;  ///< from the point of the round in which the face was last asked
  std::uint32_t round = 0;  ///< that round
};

/// An edge between a visible face, which it bounds, and one that is not.
struct HorizonEdge {
  VertexId from, to;
  FaceId outer;
};

class Quickhull {
 public:
  Quickhull(const PointArray& points, const Monitor& monitor)
      : points_(points),
        bounds_(points),
        faces_from_(points.size()),
        stage_(monitor, "building the hull", points.size()) {}

  Status build(const std::array<VertexId, 4>& simplex) {
    begin_with(simplex);
    if (!distribute()) return Monitor::interrupted();
    // First in, first out, so that all parts of the hull become finer together: where one is fine and the opposite one
    // is not, as on the two rims of a cylinder, horizons are long.
    while (!pending_.empty()) {
      const FaceId face = pending_.front();
      pending_.pop_front();
      if (!faces_[face].is_alive || faces_[face].outside.is_empty()) continue;
      const Candidate eye = faces_[face].outside.take_farthest();
      find_visible(face, eye);
      replace_visible_by_cone(eye.point);
      if (!stage_.begin_step() || !distribute()) return Monitor::interrupted();
    }
    return {};
  }

  /// The faces that are alive, renumbered.
  std::vector<HullTriangle> triangles() const {
    IdVector<FaceId, FaceId> numbers(faces_.size());
    std::vector<HullTriangle> result;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face& face = faces_[FaceId(f)];
      if (!face.is_alive) continue;
      numbers[FaceId(f)] = FaceId(result.size());
      result.push_back(face.triangle);
    }
    for (HullTriangle& triangle : result)
      for (FaceId& neighbour : triangle.neighbours) neighbour = numbers[neighbour];
    return result;
  }

 private:
  void begin_with(std::array<VertexId, 4> simplex) {
    const auto point = [&](std::size_t i) { return points_[simplex[i].index()]; };
    if (orient3d(point(0), point(1), point(2), point(3)) > 0) std::swap(simplex[1], simplex[2]);
    // Face i leaves out corner i, and its neighbour across an edge leaves out the third corner of that edge's face.
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kCorners{{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
    for (const auto& [a, b, c] : kCorners) {
      const FaceId face = add_face({simplex[a], simplex[b], simplex[c]});
      faces_[face].triangle.neighbours = {FaceId(c), FaceId(a), FaceId(b)};
      created_.push_back(face);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) orphans_.push_back({points_.approx()[i], VertexId(i)});
  }

  FaceId add_face(const std::array<VertexId, 3>& corners) {
    FaceId face;
    if (free_.empty()) {
      face = FaceId(faces_.size());
      faces_.values().emplace_back();
    } else {
      face = free_.back();
      free_.pop_back();
    }
    const auto position = [&](std::size_t i) { return points_.approx()[corners[i].index()]; };
    faces_[face].triangle.corners = corners;
    faces_[face].plane = HullPlane({position(0), position(1), position(2)}, bounds_);
    faces_[face].is_alive = true;
    return face;
  }

  bool is_in_front_exactly(const Face& face, VertexId point) const {
    const auto& [a, b, c] = face.triangle.corners;
    return orient3d(points_[a.index()], points_[b.index()], points_[c.index()], points_[point.index()]) > 0;
  }
  bool is_in_front(const Face& face, const Candidate& candidate, double height) const {
    const int side = face.plane.side(height);
    return side == kUndecided ? is_in_front_exactly(face, candidate.point) : side > 0;
  }

  /// Finds the faces that have `eye` in front, beginning with one of them, and their horizon.
  void find_visible(FaceId first, const Candidate& eye) {
    ++round_;
    visible_.clear();
    horizon_.clear();
    faces_[first].round = round_;
    faces_[first].is_visible = true;
    visible_.push_back(first);
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const HullTriangle triangle = faces_[visible_[i]].triangle;
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const FaceId neighbour = triangle.neighbours[edge];
        const bool is_known = faces_[neighbour].round == round_;
        if (!is_known) ask(neighbour, eye);
        if (!faces_[neighbour].is_visible)
          horizon_.push_back({triangle.corners[edge], triangle.corners[(edge + 1) % 3], neighbour});
        else if (!is_known)
          visible_.push_back(neighbour);
      }
    }
  }
  void ask(FaceId id, const Candidate& eye) {
    Face& face = faces_[id];
    face.round = round_;
    face.is_visible = is_in_front(face, eye, face.plane.height(eye.position));
  }

  void replace_visible_by_cone(VertexId apex) {
    for (const FaceId id : visible_) {
      faces_[id].is_alive = false;
      faces_[id].outside.move_to(orphans_);
    }
    // Their neighbours are known by now.
    free_.insert(free_.end(), visible_.begin(), visible_.end());
    created_.clear();
    for (const HorizonEdge& edge : horizon_) {
      const FaceId face = add_face({edge.from, edge.to, apex});
      link_outer(edge, face);
      faces_from_[edge.from] = face;
      created_.push_back(face);
    }
    for (const FaceId face : created_) {
      HullTriangle& triangle = faces_[face].triangle;
      const FaceId next = faces_from_[triangle.corners[1]];
      triangle.neighbours[1] = next;
      faces_[next].triangle.neighbours[2] = face;
    }
  }
  void link_outer(const HorizonEdge& edge, FaceId face) {
    faces_[face].triangle.neighbours[0] = edge.outer;
    HullTriangle& outer = faces_[edge.outer].triangle;
    for (std::size_t i = 0; i < 3; ++i)
      if (outer.corners[i] == edge.to) outer.neighbours[i] = face;
  }

  /// Gives the orphans to the created faces; drops those that are in front of none. False if interrupted.
  bool distribute() {
    for (const Candidate& candidate : orphans_)
      if (!adopt(candidate) && !stage_.begin_step()) return false;
    orphans_.clear();
    for (const FaceId face : created_)
      if (!faces_[face].outside.is_empty()) pending_.push_back(face);
    return true;
  }
  bool adopt(const Candidate& candidate) {
    for (const FaceId id : created_) {
      Face& face = faces_[id];
      const double height = face.plane.height(candidate.position);
      if (!is_in_front(face, candidate, height)) continue;
      face.outside.add(candidate, height);
      return true;
    }
    return false;
  }

  const PointArray& points_;
  CoordinateBounds bounds_;
  IdVector<FaceId, Face> faces_;
  std::vector<FaceId> free_;               // faces that are not alive
  std::deque<FaceId> pending_;             // contains all faces with outside points
  IdVector<VertexId, FaceId> faces_from_;  // of a horizon edge that begins at the point
  Stage stage_;

  // The state of the current round, which adds one point.
  std::uint32_t round_ = 0;
  std::vector<FaceId> visible_, created_;
  std::vector<HorizonEdge> horizon_;
  std::vector<Candidate> orphans_;
};

}  // namespace

Result<std::vector<HullTriangle>> quickhull(const PointArray& points, const std::array<VertexId, 4>& simplex,
                                            const Monitor& monitor) {
  Quickhull hull(points, monitor);
  A3D_TRY(hull.build(simplex));
  return hull.triangles();
}

}  // namespace algebra3d::detail
