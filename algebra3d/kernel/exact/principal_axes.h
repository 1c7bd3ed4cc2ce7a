#pragma once

#include <array>

#include "algebra3d/base/vec3.h"
#include "algebra3d/kernel/exact/rational.h"

namespace algebra3d {

/// A symmetric 3 x 3 matrix.
struct SymmetricMatrix {
  Rational xx, yy, zz, yz, zx, xy;
};

/// The eigenvalues of a symmetric matrix, ascending, and unit eigenvectors.
struct PrincipalAxes {
  std::array<double, 3> values{};
  std::array<Vec3, 3> axes{};
  /// values[i] == values[i + 1] exactly, before rounding.
  std::array<bool, 2> are_equal{};
};

/// The principal axes of a positive definite matrix. Exactness: values rounded once; components of axes within 2^-50.
/// Signs: of the first component of an axis that exceeds 0.57 in magnitude, which is then positive; the third axis
/// makes the system right-handed. Where eigenvalues are equal exactly, the first of their axes is in the direction of
/// the coordinate axis, projected, that is farthest from the other eigenvector (the first of several); if all three are
/// equal, the axes are those of the coordinates. Cost: a few hundred operations with rationals as long as the entries,
/// more if eigenvalues are nearly equal.
PrincipalAxes principal_axes(const SymmetricMatrix& matrix);

}  // namespace algebra3d
