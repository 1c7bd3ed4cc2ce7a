#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/known_facets.h"
#include "algebra3d/repair/repair_options.h"
#include "algebra3d/repair/repair_report.h"
#include "algebra3d/validity/report.h"

namespace algebra3d {

struct RepairedSolid {
  /// A valid volume, the empty one if no facet has an area; none if nothing can be made of the facets.
  std::optional<TriangleMesh> mesh;
  std::string reason;  ///< why there is none
  RepairReport report;
};

/// A solid from facets that are none, as `found` says, a proof that counted all defects. Each step sees what the ones
/// before it left, and is skipped if there is nothing for it to do:
///  1. facets that repeat a corner or have no area are dropped (degenerate_facets.h);
///  2. of equal facets one is kept, or none where the surface does not need it, unless closed shells would be open
///  then;
///  3. boundary vertices are joined that are as near as rounding leaves them, and boundary edges divided at boundary
///     vertices that lie on them (cracks.h);
///  4. vertices are moved across cracks, and edges divided beside them;
///  5. facets are turned to agree with their neighbours (facet_orientation.h);
///  6. fins are dropped (fins.h), holes are closed, and sheets beside others dropped (holes.h, rims.h);
///  7. shells are turned right side out (shell_orientation.h);
///  8. if that is no solid yet, facets are divided at one another, and the places kept about which the winding number
///  is
///     positive (winding_solid.h) or, if along some edge more facets run one way than the other, those that are mostly
///     inside (tolerant_solid.h);
///  9. cavities and small shells are left out, as the options say.
/// Where that leaves out or adds much, a band between boundaries that run close to each other (bands.h), and other ways
/// to close what is open are tried, and the cheapest is taken.
/// What does not keep all facets is compared with what they enclose (enclosure.h). If it lacks much of that, other
/// approaches are tried in a fixed order (see the source), and the first that agrees is taken; there is no solid if all
/// of them lack most of it. Where facets are divided, those in one plane are brought together and triangulated anew.
/// The result is proved. Exactness: only steps 3, 4 and 6 move or add anything away from the facets; the report says
/// how far. Errors: interrupted. Cost: that of a few proofs, and of an arrangement of what passes through itself.
Result<RepairedSolid> repaired_solid(const KnownFacets& given, const ValidityReport& found,
                                     const RepairOptions& options, const Monitor& monitor = {});

}  // namespace algebra3d
