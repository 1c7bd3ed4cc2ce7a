#pragma once

#include <span>
#include <utility>

#include "algebra3d/arrangement/skeleton.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d::arrangement {

/// Finds where the faces of each pair meet, makes their facets, and adds to `skeleton` the common parts of all facets
/// that are not coplanar, cut where they meet a boundary of either, and the boundaries of all facets. `facets` is that
/// of `skeleton`, and its planes are numbered afterwards. Errors: interrupted.
///
/// Faces are compared in pairs, but artificial edges leave no trace: where the common part of two faces ends on one, it
/// goes on in the next face, and the two parts are one. No vertex is constructed from an artificial edge.
Status find_contacts(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs, Facets& facets, Skeleton& skeleton,
                     const Monitor& monitor);

}  // namespace algebra3d::arrangement
