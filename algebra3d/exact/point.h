#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"
#include "algebra3d/exact/rational.h"

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

/// A vertex as the predicates take it: a view that owns nothing, two words and a pointer to pass by value.
/// `approx` is the correctly rounded double triple; `exact` is null if that is the point itself.
struct PointRef {
  Vec3 approx;
  const RationalVec3* exact = nullptr;

  PointRef(const Vec3& doubles) : approx(doubles) {}  // NOLINT(google-explicit-constructor)
  PointRef(const Vec3& rounded, const RationalVec3* exact_value) : approx(rounded), exact(exact_value) {}

  bool is_double() const { return exact == nullptr; }
  /// The exact coordinates, made from the doubles if need be.
  RationalVec3 rational() const { return exact != nullptr ? *exact : RationalVec3(approx); }
};

/// A point (or vector) with exact coordinates, as a value: what PointRef refers to, with ownership. Cheap to copy.
/// Invariant: every `approx` coordinate is finite and is the exact one rounded to nearest; an exact triple is held only
/// if at least one coordinate is no double. Negative zero is stored as zero, so that equal points have equal bytes.
class ExactPoint {
 public:
  ExactPoint() = default;
  /// Exactly these doubles, which must be finite.
  ExactPoint(const Vec3& doubles);  // NOLINT(google-explicit-constructor)
  /// Exactly these rationals, which must lie within the range of doubles.
  explicit ExactPoint(RationalVec3 exact);

  const Vec3& approx() const { return approx_; }
  bool is_double() const { return exact_ == nullptr; }
  RationalVec3 rational() const { return ref().rational(); }
  PointRef ref() const { return {approx_, exact_.get()}; }
  operator PointRef() const { return ref(); }  // NOLINT(google-explicit-constructor)

  /// Lexicographic by exact coordinates; equality and hash agree with it.
  friend bool operator==(const ExactPoint& a, const ExactPoint& b);
  friend std::strong_ordering operator<=>(const ExactPoint& a, const ExactPoint& b);
  std::size_t hash() const;

 private:
  Vec3 approx_;
  std::shared_ptr<const RationalVec3> exact_;
};

/// The points of a mesh: 24 bytes each, and exact triples only for those that are no doubles. Indexed from 0.
/// Memory: no byte beyond the doubles if all are doubles (the side table is one null pointer then).
class PointArray {
 public:
  PointArray() = default;
  /// Exactly these doubles, which must be finite; negative zeros become zeros.
  explicit PointArray(std::vector<Vec3> doubles);
  PointArray(const PointArray& other);
  PointArray(PointArray&&) noexcept = default;
  PointArray& operator=(const PointArray& other);
  PointArray& operator=(PointArray&&) noexcept = default;
  ~PointArray() = default;

  std::size_t size() const { return approx_.size(); }
  void reserve(std::size_t count) { approx_.reserve(count); }
  void push_back(const ExactPoint& point);
  PointRef operator[](std::size_t index) const;
  ExactPoint point(std::size_t index) const;
  const std::vector<Vec3>& approx() const { return approx_; }
  /// Number of points that are no doubles.
  std::size_t exact_count() const { return exact_ ? exact_->size() : 0; }
  /// Their indices, ascending, with their values.
  const std::vector<std::pair<std::uint32_t, RationalVec3>>& exact_entries() const;
  /// Bytes on the heap, without those of large rationals.
  std::size_t heap_bytes() const;

 private:
  using ExactTable = std::vector<std::pair<std::uint32_t, RationalVec3>>;  // ascending index
  std::vector<Vec3> approx_;
  std::unique_ptr<ExactTable> exact_;
};

/// Smallest box of doubles that holds the exact point: outward-rounded where the point is no double.
Box3 box_of(PointRef point);

}  // namespace algebra3d
