#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <utility>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/planar/polygons.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

// Values in the plane. For boxes and indexes they lie in space at z = 0.

/// point: a position in the plane with exact coordinates.
struct Point2d {
  ExactPoint position;  ///< z is 0
};

/// rect: an axis-parallel closed rectangle; it may be flat. Not empty.
struct Rect {
  double min_x = 0, max_x = 0, min_y = 0, max_y = 0;

  Box3 box() const { return {{min_x, min_y, 0}, {max_x, max_y, 0}}; }
  static Rect of(const Box3& box) { return {box.min.x, box.max.x, box.min.y, box.max.y}; }

  friend bool operator==(const Rect&, const Rect&) = default;
};

/// region: faces with holes in the plane, valid by construction (polygon_validity.h). Outer cycles run
/// counter-clockwise, holes clockwise; corners and cycles keep their order. Cheap to copy. Equal if they are the same
/// point sets, whatever the corners.
class Region {
 public:
  Region();  ///< the empty region
  /// Proves a region; undefined, with the segments, if the polygons bound no region. Exact. Errors: interrupted. Cost:
  /// n log n.
  static Result<Maybe<Region>> prove(const Polygons& polygons, const Monitor& monitor = {});
  /// Takes oriented polygons without a proof: polygons that were proved before storing, or are valid by construction.
  static Region trusted(Polygons polygons);

  const Polygons& polygons() const;
  const Box3& box() const;  ///< outward-rounded, flat at z = 0; empty for the empty region
  /// The canonical form: without collinear corners, everything in a fixed order.
  const Polygons& canonical() const;
  std::size_t heap_bytes() const;

 private:
  struct Content;
  explicit Region(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

template <>
struct TypeOf<Point2d> {
  static const Type& type();
};
template <>
struct TypeOf<Rect> {
  static const Type& type();
};
template <>
struct TypeOf<Region> {
  static const Type& type();
};

}  // namespace algebra3d
