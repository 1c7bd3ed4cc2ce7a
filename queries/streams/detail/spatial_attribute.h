#pragma once

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/mapping.h"
#include "queries/streams/spatial_index.h"

namespace queries {

/// True for types of kind SPATIAL2D and SPATIAL3D; two-dimensional values lie at z = 0.
bool is_spatial(const algebra3d::Registry& registry, const TypeExpr& type);
/// Index of the spatial attribute that the argument names.
Result<std::size_t> spatial_attribute(const algebra3d::Registry& registry, const MappingCheck& check,
                                      std::size_t position, const TypeExpr& tuple);

/// Work memory of an entry of a tree that is to be loaded: it stands once in the list and once, or nearly so, in the
/// tree.
inline constexpr std::size_t kBytesOfEntry = 3 * sizeof(rtree::Entry<std::uint64_t>);

/// The bounding box of a spatial value; empty for an undefined or empty value.
algebra3d::Box3 window_of(const Value& value);

/// Ids of the entries whose box meets the window, ascending, so that the result does not depend on the tree's history.
std::vector<std::uint64_t> ids_in_window(const SpatialIndex::Tree& tree, const algebra3d::Box3& window);
/// As above, for the tree of an index. Errors: those of SpatialIndex::tree.
Result<std::vector<std::uint64_t>> ids_in_window(const SpatialIndex& index, const algebra3d::Box3& window);

}  // namespace queries
