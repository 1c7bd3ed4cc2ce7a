#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/divided_outline.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "base/disjoint_ids.h"
#include "base/id_vector.h"
#include "base/indices.h"
#include "base/wide_vec3.h"

namespace algebra3d {

/// Two points, the one with the smaller id first: an undirected edge.
using PointPair = std::pair<PointId, PointId>;
PointPair ordered(PointId a, PointId b);

/// The rule for two triangles with the same corners. `vanishes`, for the boundary of a solid: both go if they have
/// opposite orientations, and both stay if not. `stays`, for a surface: the first one stays.
enum class Folded : std::uint8_t { vanishes, stays };

/// Changes of a mesh that are made at once.
struct FeatureJoins {
  std::vector<PointPair> merged;                  ///< points that become one
  std::map<PointPair, std::vector<PointId>> led;  ///< edges, and the points through which they are led
  std::map<std::size_t, PointId> divided;         ///< faces, and a point at which each is divided in three

  bool is_empty() const { return merged.empty() && led.empty() && divided.empty(); }
};

/// The faces of a mesh while its features are snapped to each other. A closed mesh stays closed: along every edge as
/// many triangles run one way as the other. Points with equal coordinates are one. For each corner it is known which
/// point of the given mesh it stands for, so that the distance of the faces from that mesh has a bound that does not
/// grow with the number of steps.
///
/// A face keeps its number as long as it is there: first come the given ones, then those into which they changed. The
/// cost of a change is that of the faces at it.
///
/// Given faces whose changes depend on each other form a *cluster*; the changes of one can be undone while those of
/// others stay.
class SnappedFaces {
 public:
  /// Domain: all coordinates are doubles. Faces that repeat a corner are dropped, and pairs as `folded` says.
  explicit SnappedFaces(const TriangleMesh& mesh, Folded folded = Folded::vanishes);

  /// The faces that are there; ascending.
  std::vector<std::size_t> faces() const;
  /// The number of the faces that are there.
  std::size_t size() const { return size_; }
  /// The number of the faces of the given mesh that were not dropped.
  std::size_t given_count() const { return given_count_; }
  /// The given face of which this one is, or is a part.
  std::size_t given_of(std::size_t face) const { return faces_[face].given; }
  bool is_given(std::size_t face) const { return face < given_count_; }
  bool is_there(std::size_t face) const { return faces_[face].is_there; }
  /// A given face keeps its corners while it is not there.
  const std::array<PointId, 3>& corners(std::size_t face) const { return faces_[face].corners; }
  TriangleRef triangle(std::size_t face) const;
  PointRef point(PointId id) const { return table_[id.index()]; }
  WideVec3 place(PointId id) const { return WideVec3(point(id).approx); }
  std::size_t point_count() const { return table_.size(); }
  /// The point at this place, which is added if it is new.
  PointId add_point(const Vec3& place);

  /// True unless the face is known to cross no other one: it is new since it was closed, or was given.
  bool is_open(std::size_t face) const { return faces_[face].is_open; }
  /// The faces that are open; ascending.
  const std::vector<std::size_t>& open_faces() const { return open_; }
  /// The faces that are not given ones; ascending.
  const std::vector<std::size_t>& changed_faces() const { return changed_; }
  /// Closes all faces but these.
  void close_all_but(std::vector<std::size_t> faces);

  /// Merges points, then leads edges, in all faces along them, through points, in the order along the edge, then
  /// divides those faces that have not changed otherwise. Errors: interrupted; then the faces mean nothing.
  Status apply(FeatureJoins joins, const Monitor& monitor = {});

  /// The cluster of a point, as one of its points.
  PointId cluster_of(PointId point) { return ties_.find(point); }
  /// Makes one cluster of those of two points.
  void tie(PointId a, PointId b) { ties_.unite(a, b); }
  /// Undoes all changes of the given faces of some clusters; ascending.
  void restore(std::span<const PointId> clusters);
  /// Makes each point of some restored clusters, ascending, a cluster of its own.
  void untie(std::span<const PointId> clusters);

  /// The mesh of the faces, in their order; points that no face uses are left out.
  TriangleMesh mesh() const { return mesh_of(faces()); }
  /// The mesh of some faces, in the given order.
  TriangleMesh mesh_of(std::span<const std::size_t> faces) const;
  /// The mesh of the given faces.
  TriangleMesh given_mesh() const;
  /// No corner is farther from the point of the given mesh that it stands for, and so no point of the faces from that
  /// mesh; rounded up.
  double largest_displacement() const;
  /// No point of the faces is farther from the given mesh; at most the largest displacement, and found to be smaller,
  /// if that is more than `enough`, where corners moved along the mesh. Errors: interrupted. Cost: nothing unless
  /// corners moved farther than `enough`; then that of the hierarchy of the given mesh and of bounded_distance.
  Result<double> largest_distance(double enough, const Monitor& monitor = {}) const;

 private:
  /// A corner, and its vector from the point of the given mesh for which it stands.
  struct Corner {
    PointId point;
    Vec3 displacement;
  };
  struct Face {
    std::array<PointId, 3> corners;
    std::array<Vec3, 3> displacements;
    std::size_t given;
    bool is_open;
    bool is_there;
  };
  using Chain = std::vector<Corner>;
  using Corners = std::array<PointId, 3>;

  static Corner corner(const Face& face, std::size_t index) { return {face.corners[index], face.displacements[index]}; }
  static Face part_of(std::size_t given, const Corner& a, const Corner& b, const Corner& c);
  static double largest_displacement(const Face& face);
  WideVec3 origin(const Corner& corner) const { return place(corner.point) - WideVec3(corner.displacement); }

  void drop_folded_given();
  std::vector<std::size_t>& faces_at(PointId point);
  std::vector<std::size_t> faces_along(const PointPair& edge);
  void add(const Face& face);
  void put_back(std::size_t given);
  void take_away(std::size_t face);
  void list_at_corners(std::size_t face);
  void fold(std::size_t face);
  void tidy_lists();

  void tie_to_given(const Face& face);
  Status merge(FeatureJoins& joins, const Monitor& monitor);
  Status lead(FeatureJoins& joins, const Monitor& monitor);
  void divide(std::size_t face, PointId point);
  void sort_along(const PointPair& edge, std::vector<PointId>& points) const;
  Chain chain(const Corner& from, const Corner& to, const FeatureJoins& joins) const;
  Corner corner_on_edge(PointId point, const Corner& from, const Corner& to) const;
  Corner corner_in_face(PointId point, const Face& face) const;
  Chain outline(const Face& face, const FeatureJoins& joins, std::vector<OutlineCorner>& outline) const;
  std::vector<OutlineChord> edges_across(std::span<const OutlineCorner> outline, const FeatureJoins& joins,
                                         const std::vector<PointPair>& links);
  void divide_along_sides(std::size_t face, const FeatureJoins& joins, const std::vector<PointPair>& links,
                          std::vector<Face>& parts);

  Folded folded_;
  PointTable table_;
  std::vector<Face> faces_;  // first the given ones
  std::size_t given_count_ = 0, size_ = 0;
  std::vector<std::size_t> open_, changed_;               // ascending
  std::vector<std::size_t> gone_;                         // given faces that are not there
  IdVector<PointId, std::vector<std::size_t>> faces_at_;  // all that are there, and some that are not
  DisjointIds<PointId> ties_{0};
};

}  // namespace algebra3d
