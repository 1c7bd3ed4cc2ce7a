#include "algebra3d/kernel/arrangement/detail/facets.h"

#include <utility>

#include "base/disjoint_sets.h"
#include "base/shrink.h"

namespace algebra3d::arrangement {
namespace {

class FacetMaker {
 public:
  FacetMaker(const Operands& operands, const PlanesOfFaces& planes) : operands_(operands), planes_of_faces_(planes) {
    facets_.of_face.resize(operands.face_count());
  }

  FacetId add(InputFaceId face);
  void note_coplanar(FacetId a, FacetId b) { coplanar_.unite(a.index(), b.index()); }
  Facets finish();

 private:
  void add_faces_around(InputFaceId face, FacetId facet);
  bool is_coplanar_across(InputHalfedgeId halfedge, InputHalfedgeId other) const;
  bool are_coplanar_at(InputHalfedgeId halfedge, InputHalfedgeId other) const;
  void join_planes_across_nonmanifold_edges(OperandId operand);
  void number_planes();
  PlaneId add_plane(Facet& facet);

  const Operands& operands_;
  const PlanesOfFaces& planes_of_faces_;
  Facets facets_;
  DisjointSets coplanar_{0};  // of facets
};

bool FacetMaker::is_coplanar_across(InputHalfedgeId halfedge, InputHalfedgeId other) const {
  const IntegerPlane* plane = planes_of_faces_.find(Operands::face(halfedge));
  const IntegerPlane* beyond = planes_of_faces_.find(Operands::face(other));
  if (plane != nullptr && beyond != nullptr) return *plane == *beyond;
  return are_coplanar_at(halfedge, other);
}

/// True if two faces with a common edge lie in one plane, whichever way each looks.
bool FacetMaker::are_coplanar_at(InputHalfedgeId halfedge, InputHalfedgeId other) const {
  const IntegerPlane* plane = planes_of_faces_.find(Operands::face(halfedge));
  const IntegerPlane* beyond = planes_of_faces_.find(Operands::face(other));
  if (beyond != nullptr) return beyond->side(operands_.point(Operands::previous(halfedge))) == 0;
  const PointRef apex = operands_.point(Operands::previous(other));
  if (plane != nullptr) return plane->side(apex) == 0;
  const TriangleRef triangle = operands_.corners(Operands::face(halfedge));
  return orient3d(triangle[0], triangle[1], triangle[2], apex) == 0;
}

/// The face's facet, which is made unless it is there.
FacetId FacetMaker::add(InputFaceId face) {
  if (const FacetId known = facets_.of_face[face]; !known.is_none()) return known;
  const FacetId facet = facets_.facets.next_id();
  const std::size_t first = facets_.faces.size();
  facets_.of_face[face] = facet;
  facets_.faces.push_back(face);
  for (std::size_t next = first; next < facets_.faces.size(); ++next) add_faces_around(facets_.faces[next], facet);
  facets_.facets.push_back({operands_.operand_of(face), {}, 0, Slice::from(first, facets_.faces)});
  coplanar_.add();
  return facet;
}

void FacetMaker::add_faces_around(InputFaceId face, FacetId facet) {
  for (const InputHalfedgeId h : Operands::halfedges(face)) {
    const InputHalfedgeId other = operands_.opposite(h);
    if (other.is_none()) continue;
    const InputFaceId neighbour = Operands::face(other);
    if (!facets_.of_face[neighbour].is_none() || !is_coplanar_across(h, other)) continue;
    facets_.of_face[neighbour] = facet;
    facets_.faces.push_back(neighbour);
  }
}

/// A face that is in no facet stays as it is, so nothing can become one with it.
void FacetMaker::join_planes_across_nonmanifold_edges(OperandId operand) {
  const TriangleMesh& mesh = operands_.mesh(operand);
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n) {
    const std::span<const HalfedgeId> along = mesh.nonmanifold_edge(n);
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = i + 1; j < along.size(); ++j) {
        const InputHalfedgeId one = operands_.input(operand, along[i]), other = operands_.input(operand, along[j]);
        const FacetId facet = facets_.of_face[Operands::face(one)], beyond = facets_.of_face[Operands::face(other)];
        if (!facet.is_none() && !beyond.is_none() && are_coplanar_at(one, other)) note_coplanar(facet, beyond);
      }
  }
}

PlaneId FacetMaker::add_plane(Facet& facet) {
  const InputFaceId face = facets_.faces[facet.faces.first];
  const auto [projection, turn] = dominant_turn(operands_.corners(face));
  facet.orientation = turn;
  const IntegerPlane* known = planes_of_faces_.find(face);
  return facets_.planes.push_back({&operands_.mesh(facet.operand), operands_.in_mesh(facet.operand, face), projection,
                                   turn < 0,
                                   known == nullptr ? IntegerPlane()
                                   : turn > 0       ? *known
                                                    : known->flipped()});
}

void FacetMaker::number_planes() {
  std::size_t count = 0;
  for (const FacetId f : facets_.ids()) count += coplanar_.find(f.index()) == f.index() ? 1 : 0;
  facets_.planes.reserve(count);
  for (const FacetId f : facets_.ids()) {
    Facet& facet = facets_.facets[f];
    const FacetId first_of_plane(coplanar_.find(f.index()));
    if (first_of_plane == f) {
      facet.plane = add_plane(facet);
    } else {
      const TriangleRef triangle = operands_.corners(facets_.faces[facet.faces.first]);
      facet.plane = facets_[first_of_plane].plane;
      facet.orientation = orient2d(facets_.planes[facet.plane].projection, triangle[0], triangle[1], triangle[2]);
    }
  }
}

Facets FacetMaker::finish() {
  for (const OperandId operand : operands_.ids()) join_planes_across_nonmanifold_edges(operand);
  shrink(facets_.facets.values());
  number_planes();
  return std::move(facets_);
}

}  // namespace

Facets make_facets(const Operands& operands, const PairContacts& contacts) {
  FacetMaker maker(operands, contacts.planes);
  for (const auto& [first_face, second_face, contact] : contacts.contacts) {
    const FacetId first = maker.add(first_face), second = maker.add(second_face);
    if (contact.is_coplanar) maker.note_coplanar(first, second);
  }
  return maker.finish();
}

Facets make_facets_of_all_faces(const Operands& operands) {
  const PlanesOfFaces planes(operands);
  FacetMaker maker(operands, planes);
  for (const InputFaceId face : operands.faces()) maker.add(face);
  return maker.finish();
}

}  // namespace algebra3d::arrangement
