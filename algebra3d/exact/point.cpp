#include "algebra3d/exact/point.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "algebra3d/exact/predicates.h"

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

ExactPoint::ExactPoint(RationalVec3 exact)
    : approx_(without_negative_zero({exact.x.nearest_double(), exact.y.nearest_double(), exact.z.nearest_double()})) {
  assert(is_finite(approx_));
  if (!exact.x.is_double() || !exact.y.is_double() || !exact.z.is_double())
    exact_ = std::make_shared<const RationalVec3>(std::move(exact));
}

bool operator==(const ExactPoint& a, const ExactPoint& b) {
  return equal(a.ref(), b.ref());
}

std::strong_ordering operator<=>(const ExactPoint& a, const ExactPoint& b) {
  return compare(a.ref(), b.ref());
}

std::size_t ExactPoint::hash() const {
  std::size_t hash = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) hash = combined(hash, std::bit_cast<std::uint64_t>(approx_[axis]));
  if (exact_)
    for (std::size_t axis = 0; axis < 3; ++axis) hash = combined(hash, (*exact_)[axis].hash());
  return hash;
}

PointArray::PointArray(std::vector<Vec3> doubles) : approx_(std::move(doubles)) {
  for (Vec3& v : approx_) v = without_negative_zero(v);
}

PointArray::PointArray(const PointArray& other)
    : approx_(other.approx_), exact_(other.exact_ ? std::make_unique<ExactTable>(*other.exact_) : nullptr) {}

PointArray& PointArray::operator=(const PointArray& other) {
  if (this != &other) *this = PointArray(other);
  return *this;
}

void PointArray::push_back(const ExactPoint& point) {
  if (!point.is_double()) {
    if (!exact_) exact_ = std::make_unique<ExactTable>();
    exact_->emplace_back(static_cast<std::uint32_t>(approx_.size()), *point.ref().exact);
  }
  approx_.push_back(point.approx());
}

PointRef PointArray::operator[](std::size_t index) const {
  assert(index < approx_.size());
  if (!exact_) return approx_[index];
  const auto entry =
      std::lower_bound(exact_->begin(), exact_->end(), index,
                       [](const auto& candidate, std::size_t sought) { return candidate.first < sought; });
  const bool found = entry != exact_->end() && entry->first == index;
  return {approx_[index], found ? &entry->second : nullptr};
}

ExactPoint PointArray::point(std::size_t index) const {
  const PointRef ref = (*this)[index];
  return ref.is_double() ? ExactPoint(ref.approx) : ExactPoint(*ref.exact);
}

const std::vector<std::pair<std::uint32_t, RationalVec3>>& PointArray::exact_entries() const {
  static const ExactTable none;
  return exact_ ? *exact_ : none;
}

std::size_t PointArray::heap_bytes() const {
  const std::size_t table = exact_ ? sizeof(ExactTable) + exact_->capacity() * sizeof(ExactTable::value_type) : 0;
  return approx_.capacity() * sizeof(Vec3) + table;
}

Box3 box_of(PointRef point) {
  if (point.is_double()) return Box3::of(point.approx);
  const RationalVec3& exact = *point.exact;
  return {{exact.x.lower_double(), exact.y.lower_double(), exact.z.lower_double()},
          {exact.x.upper_double(), exact.y.upper_double(), exact.z.upper_double()}};
}

}  // namespace algebra3d
