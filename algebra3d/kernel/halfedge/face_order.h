#pragma once

#include <compare>
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

/// A face and the first 32 bits of its place along the Hilbert curve of a frame. Ordered by places, then by faces.
class PlacedFace {
 public:
  PlacedFace() = default;
  constexpr PlacedFace(std::uint32_t place, std::uint32_t face) : code_(std::uint64_t{place} << 32U | face) {}

  constexpr std::uint32_t place() const { return static_cast<std::uint32_t>(code_ >> 32U); }
  constexpr std::uint32_t face() const { return static_cast<std::uint32_t>(code_); }

  friend auto operator<=>(const PlacedFace&, const PlacedFace&) = default;

 private:
  std::uint64_t code_;  // one number, which is sorted fast
};

/// Some faces of a mesh, each once, by ascending places along the curve of a frame. Faces that a set operation takes
/// over from an operand keep their places if the frame is still the same; so most of a hierarchy's order is known
/// before it is made.
struct FaceOrder {
  BoxFrame frame;
  std::vector<PlacedFace> faces;
};

}  // namespace algebra3d
