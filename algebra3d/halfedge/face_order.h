#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// The frame in which a hierarchy keeps its boxes: coordinates are half their distance from `origin`, times `scale`, a
/// power of two. A mesh has an extent of 2^19 to 2^20 in its frame, but for meshes of one point or below some 2^-980.
struct BoxFrame {
  Vec3 origin;
  double scale = 1;

  Vec3 place_of(const Vec3& point) const { return scale * (0.5 * point - 0.5 * origin); }
  friend bool operator==(const BoxFrame&, const BoxFrame&) = default;
};

/// A face (lower half) and the first 32 bits of its place along the Hilbert curve of a frame (upper half).
using PlacedFace = std::uint64_t;

constexpr std::uint32_t face_of(PlacedFace placed) {
  return static_cast<std::uint32_t>(placed);
}
constexpr std::uint32_t place_of(PlacedFace placed) {
  return static_cast<std::uint32_t>(placed >> 32U);
}
constexpr PlacedFace placed_face(std::uint32_t place, std::uint32_t face) {
  return PlacedFace{place} << 32U | face;
}

/// Some faces of a mesh, each once, by ascending places along the curve of a frame. What a set operation takes over
/// from an operand has the places that it had there, if the frame is still the same; so most of a hierarchy's order is
/// known before it is made.
struct FaceOrder {
  BoxFrame frame;
  std::vector<PlacedFace> faces;
};

}  // namespace algebra3d
