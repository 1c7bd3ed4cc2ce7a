#pragma once

#include <optional>
#include <span>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/vec3.h"

namespace algebra3d {

/// The rounding noise of the coordinates of a file. Its numbers are rounded floats if each is one, or the text of one
/// with up to nine significant digits, and if one at least needs the last bit of a float: whole numbers far out are
/// exact. Else they are doubles.
class RoundingNoise {
 public:
  /// `points`: those of the file, which must outlive this.
  explicit RoundingNoise(std::span<const Vec3> points) : points_(points) {}

  /// The largest distance between equal corners in the box that were rounded: a millionth of its diagonal, or 4
  /// spacings of the file's numbers at its largest coordinate if that is more. The box may be scaled. Cost: constant;
  /// linear in the points once, where the spacing of floats would decide.
  double within(const Box3& box) const;

 private:
  bool are_floats() const;

  std::span<const Vec3> points_;
  mutable std::optional<bool> are_floats_;  // once it was asked
};

}  // namespace algebra3d
