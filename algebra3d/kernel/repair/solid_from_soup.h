#pragma once

#include <optional>
#include <string>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/kernel/repair/repair_options.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/repair/soup_report.h"
#include "base/triangle_soup.h"

namespace algebra3d {

/// A solid made of a triangle soup, or the reason why there is none.
struct SolidFromSoup {
  std::optional<TriangleMesh> mesh;    ///< proved to be a valid volume3d
  SoupReport report;                   ///< of the triangles as given
  std::optional<RepairReport> repair;  ///< the changes; nothing if the file was a solid, or strict
  std::string reason;                  ///< why the repair gave no solid; empty if it gave one or there was no repair
  std::optional<Amount> volume;        ///< of the solid
  std::optional<Amount> area_seen;     ///< of the triangles as given, as in RepairAmounts; nothing if there is no solid

  /// The status for people, one line: "ok", "ok: turned right side out", "ok: no triangles, the solid is empty",
  /// "repaired: 1 hole closed (near (0 0 1)); added: area 0.5 (1 %), up to 0.2 from the triangles", or why there is no
  /// solid.
  std::string status() const;
};

/// Makes a solid of the triangles of a mesh file (docs/import.md), in this fixed order: equal corners are welded,
/// without a tolerance; a soup of negative volume is flipped; triangles are brought into spatial order, and vertices
/// numbered by first use; the result is proved. If the proof fails, the soup is repaired (repaired_solid.h), with the
/// orientation that it had in the file, unless the options are strict. A soup without triangles yields the empty solid.
/// Exactness: all decisions but those of the repair are exact. Errors: interrupted; limit_exceeded beyond
/// TriangleMesh::kMaxFaces triangles. Cost: that of prove_volume, and of the repair. Deterministic, including the order
/// of the triangles. Concurrent calls are safe.
Result<SolidFromSoup> solid_from_soup(const TriangleSoup& soup, const RepairOptions& options = {},
                                      const Monitor& monitor = {});

}  // namespace algebra3d
