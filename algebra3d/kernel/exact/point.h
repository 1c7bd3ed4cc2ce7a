#pragma once

#include <cassert>
#include <compare>
#include <cstddef>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/rational.h"
#include "base/intrusive_pointer.h"

namespace algebra3d {

/// Exact coordinates.
struct RationalVec3 {
  Rational x, y, z;

  const Rational& operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const RationalVec3&, const RationalVec3&) = default;
  friend std::strong_ordering operator<=>(const RationalVec3&, const RationalVec3&) = default;

  explicit RationalVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
  RationalVec3(Rational px, Rational py, Rational pz) : x(std::move(px)), y(std::move(py)), z(std::move(pz)) {}
  RationalVec3() = default;
};

class ExactCoordinates;

void add_owner(const ExactCoordinates& coordinates) noexcept;
void remove_owner(const ExactCoordinates& coordinates) noexcept;
/// An owner of exact coordinates, or null; copies share them.
using SharedCoordinates = IntrusivePointer<const ExactCoordinates>;

/// A non-owning view of a point, the argument type of the predicates: three doubles and a pointer, passed by value.
/// `approx` is the correctly rounded point; `exact` is null if that is the point itself.
struct PointRef {
  Vec3 approx;
  const ExactCoordinates* exact = nullptr;

  PointRef(const Vec3& doubles) : approx(doubles) {}  // NOLINT(google-explicit-constructor)
  PointRef(const Vec3& rounded, const ExactCoordinates* coordinates) : approx(rounded), exact(coordinates) {}

  bool is_double() const { return exact == nullptr; }
  /// One exact coordinate. Cost: a greatest common divisor unless the point is a triple of doubles.
  Rational coordinate(std::size_t axis) const;
  RationalVec3 rational() const { return {coordinate(0), coordinate(1), coordinate(2)}; }
};

/// A point (or vector) with exact coordinates, as a value: the owning counterpart of PointRef. Cheap to copy.
/// Invariant: every `approx` coordinate is finite and is the exact one rounded to nearest; exact coordinates are stored
/// only if at least one is not a double. Negative zero is stored as zero, so that equal points have equal bytes.
class ExactPoint {
 public:
  ExactPoint() = default;
  /// From doubles, which must be finite.
  ExactPoint(const Vec3& doubles);  // NOLINT(google-explicit-constructor)
  /// From rationals, which must lie within the range of doubles.
  explicit ExactPoint(const RationalVec3& exact);
  /// From a view; shares the ownership of the coordinates.
  explicit ExactPoint(const PointRef& point) : approx_(point.approx), exact_(point.exact) {}
  /// From matching coordinates, as ExactCoordinates::make returns them.
  ExactPoint(const Vec3& approx, SharedCoordinates exact) : approx_(approx), exact_(std::move(exact)) {}

  const Vec3& approx() const { return approx_; }
  bool is_double() const { return exact_.get() == nullptr; }
  RationalVec3 rational() const { return ref().rational(); }
  PointRef ref() const { return {approx_, exact_.get()}; }
  /// The shared exact coordinates; null for doubles. Leaves the rounded point.
  operator PointRef() const { return ref(); }  // NOLINT(google-explicit-constructor)

  /// Lexicographic by exact coordinates; equality and hash agree with it.
  friend bool operator==(const ExactPoint& a, const ExactPoint& b);
  friend std::strong_ordering operator<=>(const ExactPoint& a, const ExactPoint& b);
  std::size_t hash() const;

 private:
  Vec3 approx_;
  SharedCoordinates exact_;
};

/// The points of a mesh: 24 bytes each, 8 more for those from the first to the last that is not a triple of doubles,
/// and the exact coordinates of these, which copies share. Indexed from 0.
class PointArray {
 public:
  PointArray() = default;
  /// From doubles, which must be finite; negative zeros become zeros.
  explicit PointArray(std::vector<Vec3> doubles);
  PointArray(const PointArray&) = default;
  PointArray(PointArray&&) noexcept = default;
  PointArray& operator=(const PointArray&) = default;
  PointArray& operator=(PointArray&&) noexcept = default;
  ~PointArray();

  std::size_t size() const { return approx_.size(); }
  void reserve(std::size_t count) { approx_.reserve(count); }
  void push_back(const PointRef& point);
  /// Appends `count` points of another array, from `first` on.
  void append(const PointArray& from, std::size_t first, std::size_t count);
  /// Releases unused capacity if there is much of it.
  void shrink();
  PointRef operator[](std::size_t index) const {
    assert(index < approx_.size());
    const std::size_t place = index - first_exact_;
    return {approx_[index], place < exact_.size() ? exact_[place].get() : nullptr};
  }
  ExactPoint point(std::size_t index) const { return ExactPoint((*this)[index]); }
  const std::vector<Vec3>& approx() const { return approx_; }
  /// Number of points that are not triples of doubles.
  std::size_t exact_count() const { return exact_count_; }
  /// Bytes on the heap, as if nothing were shared.
  std::size_t heap_bytes() const;

  friend bool operator==(const PointArray& a, const PointArray& b);

 private:
  void set_exact(std::size_t index, SharedCoordinates exact);
  void append_exact(const PointArray& from, std::size_t first, std::size_t end, std::size_t shift);
  /// Fetches the count of owners of a point some places further on: each is in a heap block of its own.
  static void prefetch_beyond(const std::vector<SharedCoordinates>& exact, std::size_t place);

  std::vector<Vec3> approx_;
  std::vector<SharedCoordinates> exact_;  // from the first to the last point that is not a triple of doubles
  std::size_t first_exact_ = 0;
  std::size_t exact_count_ = 0;
};

namespace detail {
Box3 box_around(const PointRef& point);
}

/// The smallest box of doubles around an exact point, outward-rounded.
inline Box3 box_of(const PointRef& point) {
  return point.is_double() ? Box3::of(point.approx) : detail::box_around(point);
}

}  // namespace algebra3d
