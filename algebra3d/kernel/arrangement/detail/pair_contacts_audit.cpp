#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"
#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

namespace algebra3d::arrangement {
namespace {

bool are_coplanar(const TriangleRef& first, const TriangleRef& second) {
  return std::ranges::all_of(
      second, [&](const PointRef& corner) { return orient3d(first[0], first[1], first[2], corner) == 0; });
}

/// Whether the contact is right according to intersect_triangles, which computes it independently.
bool is_right(const TriangleContact& contact, const TriangleRef& first, const TriangleRef& second) {
  const Contact found = intersect_triangles(first, second);
  if (contact.is_coplanar != are_coplanar(first, second)) return false;
  if (contact.is_coplanar) return found != Contact::none;
  if (contact.count == 1) return found == Contact::point;
  return contact.count == 2 && found == Contact::segment;
}

bool is_place(const Place& place) {
  return place.kind == Place::Kind::inside ? place.index == 0 : place.index < 3;
}

/// An end runs along an edge of a triangle only if the whole common part does.
bool runs_consistently(const Place& place, bool runs_along, std::uint8_t edge) {
  return runs_along == (place.kind == Place::Kind::edge && place.index == edge);
}

void audit_points(const PairContact& pair, Violations& violations) {
  const TriangleContact& contact = pair.contact;
  for (std::size_t i = 0; i < std::min<std::size_t>(contact.count, 2); ++i) {
    const ContactPoint& point = contact.points[i];
    violations.expect(is_place(point.first) && is_place(point.second),
                      "faces {} and {}: end {} has a place that does not exist", pair.first_face.index(),
                      pair.second_face.index(), i);
    violations.expect(runs_consistently(point.first, point.first_runs_along, contact.first_edge) &&
                          runs_consistently(point.second, point.second_runs_along, contact.second_edge),
                      "faces {} and {}: end {} runs along another edge than the contact", pair.first_face.index(),
                      pair.second_face.index(), i);
  }
}

}  // namespace

std::vector<std::string> audit(const Operands& operands, const PairContacts& contacts) {
  Violations violations;
  for (const PairContact& pair : contacts.contacts) {
    const auto& [first, second, contact] = pair;
    if (!violations.expect(first.index() < operands.face_count() && second.index() < operands.face_count(),
                           "faces {} and {}: no such face", first.index(), second.index()))
      continue;
    violations.expect(operands.operand_of(first) < operands.operand_of(second),
                      "faces {} and {} are of operands {} and {}; expected ascending ones", first.index(),
                      second.index(), operands.operand_of(first).index(), operands.operand_of(second).index());
    violations.expect(is_right(contact, operands.corners(first), operands.corners(second)),
                      "faces {} and {}: the common part is not the one in the contact", first.index(), second.index());
    audit_points(pair, violations);
  }
  return violations.take();
}

}  // namespace algebra3d::arrangement
