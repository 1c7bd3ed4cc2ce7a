#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algebra3d/exact/integer_plane.h"

namespace algebra3d {

/// The planes of faces, as far as they are known. They follow from the corners, but where these are no doubles it takes
/// microseconds to compute them, and the plane of the input has fewer digits than its corners.
/// Memory: none while no plane is known.
class FacePlanes {
 public:
  static constexpr std::uint32_t kUnknown = 0xFFFFFFFF;

  /// Null if it is unknown.
  const IntegerPlane* find(std::size_t face) const {
    const std::uint32_t plane = number(face);
    return plane == kUnknown ? nullptr : &planes_[plane];
  }
  /// Faces with the same number lie in one plane and look the same way.
  std::uint32_t number(std::size_t face) const { return face < of_faces_.size() ? of_faces_[face] : kUnknown; }
  const IntegerPlane& operator[](std::uint32_t number) const { return planes_[number]; }
  /// Number of planes.
  std::size_t size() const { return planes_.size(); }

  /// Gives its number.
  std::uint32_t add(IntegerPlane plane) {
    planes_.push_back(std::move(plane));
    return static_cast<std::uint32_t>(planes_.size() - 1);
  }
  /// The face lies in this plane and looks to its front.
  void set(std::size_t face, std::uint32_t number) {
    if (of_faces_.size() <= face) of_faces_.resize(face + 1, kUnknown);
    of_faces_[face] = number;
  }
  std::size_t heap_bytes() const {
    return planes_.capacity() * (sizeof(IntegerPlane) + IntegerPlane::kTypicalBytes) +
           of_faces_.capacity() * sizeof(std::uint32_t);
  }

 private:
  std::vector<IntegerPlane> planes_;
  std::vector<std::uint32_t> of_faces_;  // ends with the last one that is known
};

}  // namespace algebra3d
