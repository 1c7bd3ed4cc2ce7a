#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/integer_plane.h"
#include "base/indices.h"

namespace algebra3d {

/// Known planes of faces, kept because computing them from exact corners takes microseconds, and the plane of the input
/// has fewer digits than its corners. Memory: none while no plane is known.
class FacePlanes {
 public:
  /// The plane of a face; null if it is unknown.
  const IntegerPlane* find(std::size_t face) const {
    const std::uint32_t plane = number(face);
    return plane == kNone ? nullptr : &planes_[plane];
  }
  /// The number of the plane of a face. Faces with the same number lie in one plane and have the same orientation.
  std::uint32_t number(std::size_t face) const {
    const std::size_t place = face - first_face_;
    return place < of_faces_.size() ? of_faces_[place] : kNone;
  }
  const IntegerPlane& operator[](std::uint32_t number) const { return planes_[number]; }
  /// Number of planes.
  std::size_t size() const { return planes_.size(); }

  /// Adds a plane and returns its number.
  std::uint32_t add(IntegerPlane plane) {
    planes_.push_back(std::move(plane));
    return static_cast<std::uint32_t>(planes_.size() - 1);
  }
  /// Sets the plane of a face, whose normal must point to the front of the plane.
  void set(std::size_t face, std::uint32_t number) { numbers(face, 1)[0] = number; }
  /// The numbers of the planes of consecutive faces, to be set.
  std::span<std::uint32_t> numbers(std::size_t first, std::size_t count) {
    if (of_faces_.empty()) first_face_ = first;
    if (first < first_face_) {
      of_faces_.insert(of_faces_.begin(), first_face_ - first, kNone);
      first_face_ = first;
    }
    const std::size_t place = first - first_face_;
    if (of_faces_.size() < place + count) of_faces_.resize(place + count, kNone);
    return std::span(of_faces_).subspan(place, count);
  }
  std::size_t heap_bytes() const {
    return planes_.capacity() * (sizeof(IntegerPlane) + IntegerPlane::kTypicalBytes) +
           of_faces_.capacity() * sizeof(std::uint32_t);
  }

 private:
  std::vector<IntegerPlane> planes_;
  std::vector<std::uint32_t> of_faces_;  // from the first to the last face with a known plane
  std::size_t first_face_ = 0;
};

}  // namespace algebra3d
