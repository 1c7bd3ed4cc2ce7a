#include "algebra3d/operators/all.h"

#include "algebra3d/types/all.h"

namespace algebra3d {

Registry make_registry() {
  Registry registry;
  for (const Type* type : all_types()) registry.add(*type);
  registry.begin_family("arithmetic");
  register_arithmetic(registry);
  registry.begin_family("functions of numbers");
  register_numbers(registry);
  register_mathematics(registry);
  registry.begin_family("comparison");
  register_comparison(registry);
  registry.begin_family("logic");
  register_logic(registry);
  registry.begin_family("strings and texts");
  register_strings(registry);
  registry.begin_family("points, vectors and planes");
  register_points(registry);
  registry.begin_family("boxes");
  register_boxes(registry);
  registry.begin_family("facts about values");
  register_information(registry);
  registry.begin_family("measures");
  register_measure(registry);
  registry.begin_family("creation of solids");
  register_creation(registry);
  registry.begin_family("transformations");
  register_transformation(registry);
  registry.begin_family("set operations");
  register_set_operations(registry);
  register_cuts(registry);
  registry.begin_family("parts of solids");
  register_decomposition(registry);
  registry.begin_family("mesh files");
  register_imports(registry);
  register_exports(registry);
  registry.begin_family("rounding");
  register_rounding(registry);
  registry.begin_family("regions");
  register_regions(registry);
  register_space_time(registry);
  registry.begin_family("region files");
  register_region_texts(registry);
  register_json_members(registry);
  registry.begin_family("time");
  register_time(registry);
  registry.begin_family("moving regions");
  register_moving_regions(registry);
  return registry;
}

}  // namespace algebra3d
