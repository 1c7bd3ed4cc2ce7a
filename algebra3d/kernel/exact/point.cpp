#include "algebra3d/kernel/exact/point.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

#include "algebra3d/kernel/exact/detail/exact_coordinates.h"
#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "base/interruption_scope.h"
#include "base/next_number.h"
#include "base/scheduler.h"
#include "base/shrink.h"

namespace algebra3d {

namespace {

// -0 + 0 is 0 when rounding to nearest; all other values stay.
Vec3 without_negative_zero(const Vec3& v) {
  return {v.x + 0.0, v.y + 0.0, v.z + 0.0};
}

std::size_t combined(std::size_t hash, std::uint64_t value) {
  std::uint64_t x = hash ^ (value + 0x9e3779b97f4a7c15U + (static_cast<std::uint64_t>(hash) << 6U));
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

}  // namespace

ExactPoint::ExactPoint(const Vec3& doubles) : approx_(without_negative_zero(doubles)) {
  assert(is_finite(doubles));
}

ExactPoint::ExactPoint(const RationalVec3& exact) {
  thread_local detail::HomogeneousPoint numbers;
  numbers.set(exact);
  exact_ = ExactCoordinates::make(numbers, approx_);
  assert(is_finite(approx_));
}

bool operator==(const ExactPoint& a, const ExactPoint& b) {
  poll_interruption();
  return equal(a.ref(), b.ref());
}

std::strong_ordering operator<=>(const ExactPoint& a, const ExactPoint& b) {
  poll_interruption();
  return compare(a.ref(), b.ref());
}

std::size_t ExactPoint::hash() const {
  std::size_t hash = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) hash = combined(hash, std::bit_cast<std::uint64_t>(approx_[axis]));
  if (is_double()) return hash;
  for (std::size_t axis = 0; axis < 3; ++axis)
    hash = combined(hash, static_cast<std::uint64_t>(std::int64_t{exact_.get()->beyond(axis)}));
  return hash;
}

PointArray::PointArray(std::vector<Vec3> doubles) : approx_(std::move(doubles)) {
  constexpr std::size_t kPointsPerTask = 50000;
  parallel_for(approx_.size(), kPointsPerTask, [&](std::size_t i) { approx_[i] = without_negative_zero(approx_[i]); });
}

void PointArray::push_back(const PointRef& point) {
  approx_.push_back(without_negative_zero(point.approx));
  if (!point.is_double()) set_exact(approx_.size() - 1, SharedCoordinates(point.exact));
}

/// Stores the exact coordinates of a point whose index is larger than those of all points that have some.
void PointArray::set_exact(std::size_t index, SharedCoordinates exact) {
  poll_interruption();
  if (exact_.empty()) first_exact_ = index;
  exact_.resize(index - first_exact_);
  exact_.push_back(std::move(exact));
  ++exact_count_;
}

void PointArray::append(const PointArray& from, std::size_t first, std::size_t count) {
  const std::size_t shift = approx_.size() - first;
  approx_.insert(approx_.end(), from.approx_.begin() + static_cast<std::ptrdiff_t>(first),
                 from.approx_.begin() + static_cast<std::ptrdiff_t>(first + count));
  append_exact(from, std::max(first, from.first_exact_),
               std::min(first + count, from.first_exact_ + from.exact_.size()), shift);
}

/// Appends the exact coordinates of the points from `first` to `end`, whose indices here are greater by `shift`.
void PointArray::append_exact(const PointArray& from, std::size_t first, std::size_t end, std::size_t shift) {
  const auto is_double = [&](std::size_t i) { return from.exact_[i - from.first_exact_].get() == nullptr; };
  while (first < end && is_double(first)) ++first;
  while (first < end && is_double(end - 1)) --end;
  if (first >= end) return;
  if (exact_.empty()) first_exact_ = first + shift;
  exact_.resize(first + shift - first_exact_);
  for (std::size_t i = first; i < end; ++i) {
    poll_interruption_at(i);
    const std::size_t place = i - from.first_exact_;
    prefetch_beyond(from.exact_, place);
    exact_.push_back(from.exact_[place]);
    exact_count_ += exact_.back().get() != nullptr ? 1 : 0;
  }
}

void PointArray::prefetch_beyond(const std::vector<SharedCoordinates>& exact, std::size_t place) {
  constexpr std::size_t kAhead = 8;
  if (place + kAhead < exact.size()) __builtin_prefetch(exact[place + kAhead].get(), 1);
}

PointArray::~PointArray() {
  for (std::size_t place = 0; place < exact_.size(); ++place) {
    prefetch_beyond(exact_, place);
    exact_[place] = SharedCoordinates();
  }
}

void PointArray::shrink() {
  algebra3d::shrink(approx_);
  algebra3d::shrink(exact_);
}

bool operator==(const PointArray& a, const PointArray& b) {
  if (a.approx_ != b.approx_ || a.exact_count_ != b.exact_count_) return false;
  // As many points of both are exact, so all are compared.
  for (std::size_t i = a.first_exact_; i < a.first_exact_ + a.exact_.size(); ++i)
    if (!equal(a[i], b[i])) return false;
  return true;
}

std::size_t PointArray::heap_bytes() const {
  std::size_t bytes = approx_.capacity() * sizeof(Vec3) + exact_.capacity() * sizeof(SharedCoordinates);
  for (const SharedCoordinates& exact : exact_)
    if (exact.get() != nullptr) bytes += exact.get()->heap_bytes();
  return bytes;
}

Rational PointRef::coordinate(std::size_t axis) const {
  return is_double() ? Rational(approx[axis]) : exact->coordinate(axis);
}

Box3 detail::box_around(const PointRef& point) {
  Box3 box = Box3::of(point.approx);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int beyond = point.exact->beyond(axis);
    double& bound = beyond < 0 ? box.min[axis] : box.max[axis];
    if (beyond != 0) bound = beyond < 0 ? next_below(bound) : next_above(bound);
  }
  return box;
}

}  // namespace algebra3d
