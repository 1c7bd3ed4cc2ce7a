#include "algebra3d/operators/descriptions/set_of_value.h"

#include <algorithm>
#include <array>

#include "algebra3d/operators/descriptions/detail/spatial_sets.h"

namespace algebra3d {
namespace {

using Make = Result<SpatialSet> (*)(const Value& value, Context& context);

template <typename T>
Result<SpatialSet> make_set(const Value& value, Context& context) {
  return set_of(value.get<T>(), context);
}

struct SetType {
  const Type* type;
  Make make;
};

template <typename T>
SetType set_type() {
  return {&TypeOf<T>::type(), &make_set<T>};
}

const SetType* find_set_type(const Type& type) {
  static const std::array types{set_type<Box3>(),     set_type<Point3d>(), set_type<Points3d>(), set_type<Surface3d>(),
                                set_type<Volume3d>(), set_type<Rect>(),    set_type<Point2d>(),  set_type<Region>()};
  const auto* const found = std::ranges::find(types, &type, &SetType::type);
  return found == types.end() ? nullptr : found;
}

}  // namespace

bool is_set(const Type& type) {
  return find_set_type(type) != nullptr;
}

Result<SpatialSet> set_of_value(const Value& value, const Monitor& monitor) {
  Diagnostics diagnostics;
  Context context{diagnostics, monitor.cancel(), {}};
  return find_set_type(value.type())->make(value, context);
}

}  // namespace algebra3d
