#include "queries/streams/detail/spatial_operands.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/streams/detail/spatial_attribute.h"

namespace queries {
namespace {

TypeExpr with_suffix(const TypeExpr& tuple, std::string_view suffix) {
  auto attributes = tuple.attributes();
  for (auto& attribute : attributes) attribute.name += suffix;
  return TypeExpr::tuple(std::move(attributes));
}

}  // namespace

Result<SpatialOperands> spatial_operands(const algebra3d::Registry& registry, const MappingCheck& check) {
  A3D_ASSIGN(const TypeExpr left, check.stream(0));
  A3D_ASSIGN(const TypeExpr right, check.stream(1));
  A3D_ASSIGN(const std::size_t left_key, spatial_attribute(registry, check, 2, left));
  A3D_ASSIGN(const std::size_t right_key, spatial_attribute(registry, check, 3, right));
  A3D_ASSIGN(TypeExpr joined, check.concatenated(left, right));
  return SpatialOperands{left_key, right_key, left.attributes()[left_key].type, right.attributes()[right_key].type,
                         std::move(joined)};
}

Result<SpatialOperands> spatial_self_operands(const algebra3d::Registry& registry, const MappingCheck& check) {
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t key, spatial_attribute(registry, check, 1, tuple));
  A3D_ASSIGN(TypeExpr joined, check.concatenated(with_suffix(tuple, "_a"), with_suffix(tuple, "_b")));
  const TypeExpr& type = tuple.attributes()[key].type;
  return SpatialOperands{key, key, type, type, std::move(joined)};
}

}  // namespace queries
