#include "queries/streams/detail/spatial_attribute.h"

#include <algorithm>

#include "base/propagate.h"

namespace queries {

using algebra3d::Box3;

bool is_spatial(const algebra3d::Registry& registry, const TypeExpr& type) {
  const algebra3d::Type* known = registry.find_type(type.name());
  return known != nullptr && known->is_spatial();
}

Result<std::size_t> spatial_attribute(const algebra3d::Registry& registry, const MappingCheck& check,
                                      std::size_t position, const TypeExpr& tuple) {
  A3D_ASSIGN(const std::size_t index, check.attribute(position, tuple));
  const TypeExpr& type = tuple.attributes()[index].type;
  if (!is_spatial(registry, type)) return check.expected("an attribute of kind SPATIAL2D or SPATIAL3D", type);
  return index;
}

Box3 window_of(const Value& value) {
  return value.is_defined() ? value.header().box : Box3{};
}

Result<std::vector<std::uint64_t>> ids_in_window(const SpatialIndex& index, const Box3& window) {
  return index.ask([&](const SpatialIndex::Tree& tree) { return ids_in_window(tree, window); });
}

std::vector<std::uint64_t> ids_in_window(const SpatialIndex::Tree& tree, const Box3& window) {
  std::vector<std::uint64_t> ids;
  if (window.is_empty()) return ids;
  for (const std::uint64_t id : tree.window(window)) ids.push_back(id);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace queries
