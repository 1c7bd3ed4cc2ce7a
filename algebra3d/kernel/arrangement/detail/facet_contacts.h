#pragma once

#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"
#include "algebra3d/kernel/arrangement/detail/segment_complex.h"

namespace algebra3d::arrangement {

/// Stage 4: puts the common parts of pairs of faces together into the common parts of pairs of facets, for facets that
/// are not coplanar. Gives these as segments, with the segments of the boundary edges of all facets. Common parts end
/// at boundaries of the two facets, and these are cut there. Segments of one plane that cross inside a facet are not
/// cut yet; that is stage 5 (overlay.h). Exact. Errors: internal, if a common part ends inside both facets, which
/// correct contacts rule out. Cost: n log n in the contacts and faces of facets.
///
/// A common part that runs along a boundary edge and is shorter than it is a segment of its own, noted as collinear
/// with the segment of the edge, which stage 5 then cuts where the common part ends. At a common part both facets get
/// an incidence with FacetSides::both, even a facet that ends along it and so lies on one side only. That side is in
/// the incidence of its boundary edge, and stage 6 (sub_edges.h) prefers it.
///
/// Faces are compared in pairs, but inner edges of facets leave no trace: where the common part of two faces ends on
/// one, it goes on in the next face, and the two parts are one. No node is constructed from an inner edge.
Result<SegmentComplex> find_facet_contacts(const Operands& operands, const Facets& facets,
                                           const PairContacts& contacts);

}  // namespace algebra3d::arrangement
