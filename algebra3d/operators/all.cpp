#include "algebra3d/operators/all.h"

#include "algebra3d/types/all.h"

namespace algebra3d {

Registry make_registry() {
  Registry registry;
  for (const Type* type : all_types()) registry.add(*type);
  register_arithmetic(registry);
  register_comparison(registry);
  register_logic(registry);
  register_strings(registry);
  register_points(registry);
  register_boxes(registry);
  register_information(registry);
  register_measure(registry);
  register_creation(registry);
  register_transformation(registry);
  register_set_operations(registry);
  register_cuts(registry);
  register_decomposition(registry);
  register_imports(registry);
  register_exports(registry);
  register_rounding(registry);
  register_regions(registry);
  register_space_time(registry);
  register_region_texts(registry);
  register_json_members(registry);
  register_time(registry);
  register_moving_regions(registry);
  return registry;
}

}  // namespace algebra3d
