#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/base/triangle_soup.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/amount.h"
#include "algebra3d/repair/repair_options.h"
#include "algebra3d/repair/repair_report.h"
#include "algebra3d/validity/report.h"

namespace algebra3d {

/// What was found in a triangle soup on its way to a solid. Facets are numbered from 1, in the order of the soup.
struct SoupReport {
  /// The defects after welding; the faces in the examples are facets of the soup, numbered from 0.
  ValidityReport validity;
  double size = 0;  ///< diagonal of the box around the facets
  /// Facets whose given normal points to the other side than the order of their corners says; zero normals are ignored.
  std::uint64_t contradicting_normal_count = 0;
  std::size_t first_contradicting_facet = 0;  ///< from 1; 0 if there is none
  /// The soup was a solid turned inside out, and every triangle was turned over.
  bool was_turned = false;

  /// For people, one line: "no valid solid: 12 boundary edges (facet 17, near (0 0.5 1)), 3 intersecting pairs (facets
  /// 4 and 9, near (2 0 0))"; empty if the soup gave a solid.
  std::string defects() const;
  /// For people: what changed no decision, one sentence each.
  std::vector<std::string> remarks() const;
};

/// As people call it: "boundary edges".
std::string_view name_of(Defect kind);

/// A solid, or why there is none.
struct SolidFromSoup {
  std::optional<TriangleMesh> mesh;    ///< proved to be a valid volume3d
  SoupReport report;                   ///< of the facets as given
  std::optional<RepairReport> repair;  ///< what was changed; none if nothing had to be, or nothing was to be
  std::string reason;                  ///< why the repair gave no solid
  std::optional<Amount> volume;        ///< of the solid
  std::optional<Amount> area_seen;     ///< of the facets as given, as in RepairAmounts; none if nothing was made

  /// For people, one line: "ok", "ok: turned right side out", "ok: no facets, the solid is empty", "repaired: 1 hole
  /// closed (near (0 0 1)); added: area 0.5, up to 0.2 from the facets", or why there is no solid.
  std::string status() const;
};

/// A solid from the triangles of a mesh file, in this fixed order: equal corners are welded (no tolerance, nothing is
/// dropped); a soup of negative volume is turned over; triangles are brought into spatial order, vertices numbered by
/// first use; the result is proved. So a soup that is a solid comes out untouched. One that is none is repaired
/// (repaired_solid.h), unless the options are strict. A soup without triangles gives the empty solid.
/// Exactness: every decision on what is no repair is exact; the solid has exactly the triangles of the soup then.
/// Errors: interrupted; limit_exceeded beyond TriangleMesh::kMaxFaces triangles. Cost: that of prove_volume, and of the
/// repair. Deterministic: the same soup gives the same mesh, to the order of its triangles. Any number of calls may run
/// at once.
Result<SolidFromSoup> solid_from_soup(const TriangleSoup& soup, const RepairOptions& options = {},
                                      const Monitor& monitor = {});

}  // namespace algebra3d
