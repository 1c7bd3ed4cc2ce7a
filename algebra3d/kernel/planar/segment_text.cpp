#include "algebra3d/kernel/planar/segment_text.h"

#include "base/number_text.h"

namespace algebra3d::planar {
namespace {

std::string plain_number_text(PointRef point, std::size_t axis) {
  const Rational exact = point.coordinate(axis);
  if (!exact.is_double()) return exact.text();
  std::string text = real_text(point.approx[axis]);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

}  // namespace

std::string corner_text(PointRef point) {
  return "(" + plain_number_text(point, 0) + " " + plain_number_text(point, 1) + ")";
}

std::string segment_text(PointRef from, PointRef to) {
  return corner_text(from) + "-" + corner_text(to);
}

}  // namespace algebra3d::planar
