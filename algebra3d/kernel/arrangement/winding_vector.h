#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace algebra3d {

/// A winding number vector, "windings" for short: for each group of operands, how many of them contain a point that
/// lies on no face; where operands are closed only together, their winding number about it. Also the difference of two
/// such vectors.
class WindingVector {
 public:
  static constexpr std::size_t kGroupCount = 2;

  constexpr WindingVector() = default;
  constexpr WindingVector(std::int32_t first, std::int32_t second) : windings_{first, second} {}
  /// `count` for one group, 0 for the other.
  static constexpr WindingVector of_group(std::size_t group, std::int32_t count) {
    WindingVector result;
    result[group] = count;
    return result;
  }

  constexpr std::int32_t& operator[](std::size_t group) { return windings_[group]; }
  constexpr std::int32_t operator[](std::size_t group) const { return windings_[group]; }

  friend constexpr WindingVector operator+(const WindingVector& a, const WindingVector& b) {
    return {a[0] + b[0], a[1] + b[1]};
  }
  friend constexpr WindingVector operator-(const WindingVector& a, const WindingVector& b) {
    return {a[0] - b[0], a[1] - b[1]};
  }
  friend constexpr WindingVector operator-(const WindingVector& a) { return {-a[0], -a[1]}; }
  /// Not the default one, which calls memcmp.
  friend constexpr bool operator==(const WindingVector& a, const WindingVector& b) {
    return a[0] == b[0] && a[1] == b[1];
  }

 private:
  std::array<std::int32_t, kGroupCount> windings_{};
};

/// A rule for solids: whether a cell with these windings belongs to the result. False for the cell that no operand
/// holds.
using KeepRule = std::function<bool(const WindingVector& windings)>;
/// A rule for faces: whether the result has a face of the arrangement, by the windings of the cells in front of it and
/// behind it. 1 if it has the face, -1 if it has the face flipped, 0 if not.
using FaceRule = std::function<int(const WindingVector& front, const WindingVector& back)>;

}  // namespace algebra3d
