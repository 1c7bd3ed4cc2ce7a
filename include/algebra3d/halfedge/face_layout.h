#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "algebra3d/base/int128.h"
#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// The half-edges of triangles: those of face f are 3f, 3f + 1 and 3f + 2, so everything is computed.
struct TriangleLayout {
  static HalfedgeId next(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 2 ? h.index() - 2 : h.index() + 1); }
  static HalfedgeId prev(HalfedgeId h) { return HalfedgeId(h.index() % 3 == 0 ? h.index() + 2 : h.index() - 1); }
  static FaceId face(HalfedgeId h) { return FaceId(h.index() / 3); }
  /// The half-edge that leaves a corner of a face.
  static HalfedgeId halfedge(FaceId f, std::uint32_t corner = 0) { return HalfedgeId(3 * f.index() + corner); }
  /// The number of corners of a face.
  static std::uint32_t degree(FaceId /*f*/) { return 3; }

 protected:
  static std::size_t count_faces(std::size_t halfedges) { return halfedges / 3; }
};

/// The half-edges of polygons: those of a face are numbered consecutively, faces in ascending order. Faces of one
/// degree need no memory; others need four bytes per face and four per half-edge. `Numbers` is an array of
/// std::uint32_t: one that owns them, or a std::span.
template <typename Numbers>
class PolygonLayoutIn {
 public:
  /// No faces.
  PolygonLayoutIn() = default;
  /// The same faces, with arrays that are made of those of `layout`.
  template <typename Other>
  explicit PolygonLayoutIn(const PolygonLayoutIn<Other>& layout)
      : starts_(layout.face_starts()), faces_(layout.faces_of_halfedges()) {
    if (layout.common_degree() != 0) set_degree(layout.common_degree());
  }

  HalfedgeId next(HalfedgeId h) const {
    const std::uint32_t after = h.index() + 1;
    if (degree_ != 0) return HalfedgeId(after - degree_if_first(after));
    const auto [first, end] = bounds(face(h));
    return HalfedgeId(after == end ? first : after);
  }
  HalfedgeId prev(HalfedgeId h) const {
    if (degree_ != 0) return HalfedgeId(h.index() - 1 + degree_if_first(h.index()));
    const auto [first, end] = bounds(face(h));
    return HalfedgeId(h.index() == first ? end - 1 : h.index() - 1);
  }
  FaceId face(HalfedgeId h) const { return FaceId(degree_ != 0 ? divided_by_degree(h.index()) : faces_[h.index()]); }
  /// The half-edge that leaves a corner of a face.
  HalfedgeId halfedge(FaceId f, std::uint32_t corner = 0) const { return HalfedgeId(bounds(f).first + corner); }
  /// The number of corners of a face.
  std::uint32_t degree(FaceId f) const { return degree_ != 0 ? degree_ : starts_[f.index() + 1] - starts_[f.index()]; }
  /// The degree of all faces; 0 if it differs.
  std::uint32_t common_degree() const { return degree_; }

  // The arrays, empty if all faces have one degree.
  const Numbers& face_starts() const { return starts_; }        ///< per face, and the end
  const Numbers& faces_of_halfedges() const { return faces_; }  ///< per half-edge

 protected:
  std::size_t count_faces(std::size_t halfedges) const {
    if (degree_ != 0) return halfedges / degree_;
    return starts_.empty() ? 0 : starts_.size() - 1;
  }
  void set_degree(std::uint32_t degree) {
    degree_ = degree;
    reciprocal_ = (std::uint64_t{1} << 63) / degree + 1;
    divisor_ = ~std::uint64_t{0} / degree + 1;
  }

  Numbers starts_;
  Numbers faces_;

 private:
  std::pair<std::uint32_t, std::uint32_t> bounds(FaceId f) const {
    if (degree_ != 0) return {f.index() * degree_, (f.index() + 1) * degree_};
    return {starts_[f.index()], starts_[f.index() + 1]};
  }

  /// Exact, since the reciprocal is too large by at most 1. A product takes a fraction of the time of a division.
  std::uint32_t divided_by_degree(std::uint32_t halfedge) const {
    return static_cast<std::uint32_t>(UInt128{reciprocal_} * (std::uint64_t{halfedge} << 1) >> 64);
  }
  /// The degree at the first half-edge of a face and at the end of all, else 0: without a branch, which would often be
  /// predicted wrongly. Source: [lemire2019].
  std::uint32_t degree_if_first(std::uint32_t halfedge) const {
    return degree_ * static_cast<std::uint32_t>(divisor_ * halfedge <= divisor_ - 1);
  }

  std::uint32_t degree_ = 0;      // 0: in the arrays
  std::uint64_t reciprocal_ = 0;  // 2^63 / degree, rounded down, plus 1
  std::uint64_t divisor_ = 0;     // 2^64 / degree, rounded up, modulo 2^64
};

}  // namespace algebra3d
