#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/facets.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

class FacetsAudit {
 public:
  FacetsAudit(const Operands& operands, const Facets& facets) : operands_(operands), facets_(facets) {}

  std::vector<std::string> run() {
    if (check_lists()) {
      for (const FacetId facet : facets_.ids()) check_facet(facet);
      for (const PlaneId plane : facets_.planes.ids()) check_plane(plane);
    }
    return violations_.take();
  }

 private:
  bool check_lists();
  void check_facet(FacetId facet);
  void check_face(FacetId facet, InputFaceId face);
  void check_plane(PlaneId id);
  bool is_in_plane(InputFaceId face, const TriangleRef& plane) const;

  const Operands& operands_;
  const Facets& facets_;
  Violations violations_;
};

/// Whether all ids are those of something.
bool FacetsAudit::check_lists() {
  bool holds = violations_.expect(facets_.of_face.size() == operands_.face_count(), "{} faces are known, not {}",
                                  facets_.of_face.size(), operands_.face_count());
  std::size_t first = 0;
  for (const FacetId f : facets_.ids()) {
    const Facet& facet = facets_[f];
    holds &= violations_.expect(
        facet.faces.first == first && facet.faces.last > first && facet.faces.last <= facets_.faces.size(),
        "facet {} has the faces {} to {} of {}", f.index(), facet.faces.first, facet.faces.last, facets_.faces.size());
    first = facet.faces.last;
    holds &= violations_.expect(facet.plane.index() < facets_.planes.size(), "facet {}: no such plane", f.index());
  }
  holds &= violations_.expect(first == facets_.faces.size(), "{} faces are in facets, {} are listed", first,
                              facets_.faces.size());
  const auto in_facets =
      static_cast<std::size_t>(std::ranges::count_if(facets_.of_face, [](FacetId facet) { return !facet.is_none(); }));
  violations_.expect(in_facets == facets_.faces.size(), "{} faces have a facet, {} are listed", in_facets,
                     facets_.faces.size());
  return holds;
}

bool FacetsAudit::is_in_plane(InputFaceId face, const TriangleRef& plane) const {
  return std::ranges::all_of(operands_.corners(face), [&](const PointRef& corner) {
    return orient3d(plane[0], plane[1], plane[2], corner) == 0;
  });
}

void FacetsAudit::check_facet(FacetId facet) {
  for (const InputFaceId face : facets_.faces_of(facet)) {
    if (!violations_.expect(face.index() < operands_.face_count() && facets_.of_face[face] == facet,
                            "face {} is listed for facet {}, which is not its own", face.index(), facet.index()))
      continue;
    check_face(facet, face);
  }
}

void FacetsAudit::check_face(FacetId f, InputFaceId face) {
  const Facet& facet = facets_[f];
  const Plane& plane = facets_.plane_of(f);
  violations_.expect(operands_.operand_of(face) == facet.operand, "face {} of facet {} is of another operand",
                     face.index(), f.index());
  violations_.expect(is_in_plane(face, plane.triangle()), "face {} does not lie in the plane {} of its facet {}",
                     face.index(), facet.plane.index(), f.index());
  const TriangleRef corners = operands_.corners(face);
  violations_.expect(orient2d(plane.projection, corners[0], corners[1], corners[2]) == facet.orientation,
                     "face {} looks to another side than its facet {}", face.index(), f.index());
  for (const InputHalfedgeId h : Operands::halfedges(face)) {
    const InputHalfedgeId other = operands_.opposite(h);
    if (other.is_none() || facets_.of_face[Operands::face(other)] == f) continue;
    violations_.expect(!is_in_plane(Operands::face(other), plane.triangle()),
                       "facet {} is not maximal: face {} goes on in face {}", f.index(), face.index(),
                       Operands::face(other).index());
  }
}

void FacetsAudit::check_plane(PlaneId id) {
  const Plane& plane = facets_.planes[id];
  const TriangleRef triangle = plane.triangle();
  violations_.expect(orient2d(plane.projection, triangle[0], triangle[1], triangle[2]) > 0,
                     "plane {}: its triangle does not turn counter-clockwise", id.index());
  if (!plane.coefficients.is_null())
    violations_.expect(
        std::ranges::all_of(triangle, [&](const PointRef& corner) { return plane.coefficients.side(corner) == 0; }),
        "plane {}: its triangle is not in the plane of the coefficients", id.index());
}

}  // namespace

std::vector<std::string> audit(const Operands& operands, const Facets& facets) {
  return FacetsAudit(operands, facets).run();
}

}  // namespace algebra3d::arrangement
