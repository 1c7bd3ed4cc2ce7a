#pragma once

#include <cstddef>

namespace algebra3d::arrangement {

/// Number of faces from which on another thread saves more than it costs (base/scheduler.h).
inline constexpr std::size_t kWorthAThread = 20000;
/// Faces that one task goes through, a few nanoseconds each.
inline constexpr std::size_t kFacesPerTask = 16384;
/// Number of faces from which on a pass over all of them beside the work on facets saves more than starting it takes.
inline constexpr std::size_t kFacesWorthATask = 1500;
/// Points or planes that are computed exactly by one task.
inline constexpr std::size_t kPointsPerTask = 32;
/// Contacts of faces that are joined at once: many tasks' worth of points.
inline constexpr std::size_t kContactsPerBlock = 8192;
/// Planes in which one task overlays segments.
inline constexpr std::size_t kPlanesPerTask = 32;
/// Nodes at which one task looks for pseudo-nodes; many have no edge of a region.
inline constexpr std::size_t kNodesPerTask = 128;
/// Sub-edges sorted by one task; sub-edges whose radial orders are kept in memory at a time.
inline constexpr std::size_t kSubEdgesPerTask = 512, kSubEdgesPerBlock = 65536;

}  // namespace algebra3d::arrangement
