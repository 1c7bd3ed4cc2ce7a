#include "algebra3d/values/types/all.h"

#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/moving_region.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/time.h"
#include "algebra3d/values/types/tuple_number.h"

namespace algebra3d {

std::vector<const Type*> all_types() {
  return {&TypeOf<std::int64_t>::type(), &TypeOf<double>::type(),       &TypeOf<bool>::type(),
          &TypeOf<std::string>::type(),  &TypeOf<Text>::type(),         &TypeOf<Bytes>::type(),
          &TypeOf<Point3d>::type(),      &TypeOf<Points3d>::type(),     &TypeOf<Vector3d>::type(),
          &TypeOf<Plane3d>::type(),      &TypeOf<Box3>::type(),         &TypeOf<Surface3d>::type(),
          &TypeOf<Volume3d>::type(),     &TypeOf<Mesh3d>::type(),       &TypeOf<Point2d>::type(),
          &TypeOf<Rect>::type(),         &TypeOf<Region>::type(),       &TypeOf<Instant>::type(),
          &TypeOf<Duration>::type(),     &TypeOf<TimeInterval>::type(), &TypeOf<RegionUnit>::type(),
          &TypeOf<MovingRegion>::type(), &TypeOf<TupleNumber>::type()};
}

}  // namespace algebra3d
