#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "algebra3d/kernel/distance/detail/face_bounds.h"
#include "algebra3d/kernel/distance/detail/sampled_set.h"
#include "algebra3d/kernel/distance/farthest_point.h"

namespace algebra3d::distances {

/// Branch and bound for one FarthestSearch, for faces whose FaceBounds do not settle them. A piece is a part of a
/// triangle, with an upper bound of the distance of its points: the distance from one triangle is convex, so it is
/// largest in a corner of the piece. The piece with the largest bound is divided next: along the points that are
/// equally far from the two triangles that are nearest to its corners, so that few pieces are needed where large parts
/// are at one distance, or else in the middle of its longest edge.
class PieceSearch {
 public:
  /// `box` holds both sets.
  PieceSearch(const FarthestSearch& search, const Box3& box)
      : from_(*search.from.mesh),
        to_(search.to),
        box_(box),
        set_(search.to, box),
        rounding_(kRoundings * largest_coordinate(box) + kLeast),
        tolerance_(kTolerance * largest_coordinate(box) + 4 * kLeast) {}

  // The steps, in this order. What several searches need for their farthest point is less if each step of all is done
  // before the next one, and gets the largest lower bound of all as `at_least`.

  /// Measures some vertices and points inside of faces.
  Status measure_some(const Monitor& monitor);
  /// Measures the others, as far as they can be farther than `at_least` and the best sample.
  Status measure_vertices(double at_least, const Monitor& monitor);
  /// Bounds the distance of each face roughly.
  Status begin_bounds(double at_least, const Monitor& monitor);
  /// False if no face is left for another round.
  bool has_round() const { return !left_.empty(); }
  /// Bounds those left that seem to be farthest, few in the first round and more in each one after it: what is found in
  /// a round settles many of the next. Takes samples where the largest bounds were found.
  Status bound_round(double at_least, const Monitor& monitor);
  /// Where sets nearly coincide, bounds what is not settled once more in long doubles, and then all that is left by a
  /// covering.
  Status bound_near_faces(double at_least, const Monitor& monitor);
  /// Divides pieces until none can have a point that is clearly farther than `at_least` and the best sample, or until
  /// there are too many.
  Status refine(double at_least, const Monitor& monitor);

  /// The best sample.
  SampleId best() const { return best_; }
  /// A lower bound of the largest distance.
  double lower_bound() const { return lower_; }
  /// An upper bound, after `refine`.
  double upper_bound() const { return upper_; }
  /// False if there were too many pieces, so that the upper bound is larger than it should be.
  bool is_bounded() const { return is_bounded_; }
  const SampledSet& samples() const { return set_; }

 private:
  static constexpr double kRoundings = 0x1p-46, kTolerance = 0x1p-44, kRelative = 0x1p-30;
  static constexpr double kLeast = 0x1p-1068;  // for roundings of subnormal numbers
  static constexpr std::size_t kMaxPieces = std::size_t{1} << 22U;
  /// Comparisons of points with faces for sets that nearly coincide, at all and for each face: where needles and folds
  /// of one are beside those of the other, more would hardly bring the bounds nearer to each other.
  static constexpr std::size_t kWorkOfNear = std::size_t{1} << 18U, kWorkOfNearFace = 256;
  static constexpr std::size_t kWorkOfDivision = 240;  ///< besides that of its samples
  static constexpr double kNear = 0x1p-16;
  static constexpr std::size_t kProbedFaces = 64;  ///< in a round at most, and the faces of the first one
  /// So many vertices and points of faces at most are measured before all others.
  static constexpr std::size_t kFirstSamples = 256;

  using Corners = std::array<SampleId, 3>;
  struct Piece {
    Corners corners;
    double upper;
    std::uint32_t depth;
    friend bool operator<(const Piece& a, const Piece& b) { return a.upper < b.upper; }
  };
  /// The points of a piece, in order, on both sides of a division.
  struct Division {
    std::vector<SampleId> first, second;
  };

  template <typename IsTaken>
  Status measure(IsTaken is_taken, const Monitor& monitor);
  static std::size_t first_step(std::size_t count);
  static double largest_coordinate(const Box3& box);
  bool is_better(double distance) const;
  void take_sample(SampleId id, double rounding);
  void take_sharpened(SampleId id, double rounding);
  void push(Piece piece);
  double enough() const { return lower_ * (1 + kRelative) + tolerance_; }
  bool is_settled(double upper) const { return upper <= enough(); }
  /// True if no point is known that is far from the other set, in comparison with the largest coordinate.
  bool do_nearly_coincide() const { return lower_ <= kNear / kTolerance * tolerance_; }
  std::size_t near_work() const;
  bool may_go_on(std::size_t piece_count) const;
  std::vector<std::uint32_t> unsettled_faces() const;
  template <typename Vector>
  void bound(std::span<const std::uint32_t> faces, std::size_t max_work, const Monitor& monitor);
  Status cover(std::span<const std::uint32_t> faces, const Monitor& monitor);
  void move_farthest_to_front(std::vector<std::uint32_t>& faces, std::size_t count) const;
  void probe(std::span<const std::uint32_t> bounded);
  void bound_by(FaceId face, const Corners& corners, double& least, FaceId& of_least) const;
  void divide(const Piece& piece, const FaceBounds<Vec3>& bounds);
  bool divide_between(const Piece& piece, FaceId first, FaceId second, Division& division);
  void halve(const Piece& piece, Division& division);
  void push_polygon(const std::vector<SampleId>& polygon, const Piece& parent);
  SampleId new_sample(const Vec3& point, FaceId near);
  Vec3 position(SampleId id) const { return set_[id].point.approx(); }
  double nearness(const Vec3& point, FaceId first, FaceId second) const;
  double share_near(const Vec3& near_first, const Vec3& near_second, FaceId first, FaceId second) const;

  const TriangleMesh& from_;
  DistanceOperand to_;
  Box3 box_;
  SampledSet set_;
  double rounding_;   // of points on the way to pieces
  double tolerance_;  // what no piece is divided for
  SampleId best_;
  double lower_ = 0, upper_ = 0;
  bool is_bounded_ = true;
  std::size_t work_ = 0;  // comparisons for pieces
  std::vector<FaceBound> face_bounds_;
  std::vector<std::uint32_t> left_;        // faces for the rounds to come
  std::size_t round_size_ = kProbedFaces;  // of the next one
  std::optional<LargeFacets> facets_;      // of `to`
  std::priority_queue<Piece> pieces_;
};

}  // namespace algebra3d::distances
