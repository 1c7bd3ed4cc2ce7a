#include "algebra3d/arrangement/pair_contacts.h"

#include <algorithm>
#include <optional>

#include "algebra3d/base/parallel.h"

namespace algebra3d::arrangement {
namespace {

using PairSpan = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

/// From so many pairs on, a second thread saves more than it costs.
constexpr std::size_t kPairsWorthAThread = 500;

bool has_exact_corner(const TriangleRef& corners) {
  return !std::ranges::all_of(corners, &PointRef::is_double);
}

/// Planes of faces with corners that are no doubles, and of those that are compared with such. Between doubles, planes
/// would take longer.
void make_planes(PairSpan pairs, const Operands& operands, Facets& facets) {
  bool is_needed = false;
  for (std::uint32_t operand = 0; operand < operands.count(); ++operand)
    is_needed = is_needed || operands.mesh(operand).points().exact_count() > 0;
  if (!is_needed) return;
  constexpr unsigned kSeen = 1, kExact = 2, kHasPlane = 4;
  std::vector<std::uint8_t> notes(operands.face_count());  // so that each face is looked at once
  const auto note = [&](std::uint32_t face) {
    if (notes[face] == 0) notes[face] = has_exact_corner(operands.corners(face)) ? kSeen | kExact : kSeen;
    return notes[face];
  };
  for (const auto& [first, second] : pairs) {
    if (((note(first) | note(second)) & kExact) == 0) continue;
    for (const std::uint32_t face : {first, second}) {
      if ((notes[face] & kHasPlane) != 0) continue;
      facets.plane_of_face(face);
      notes[face] |= kHasPlane;
    }
  }
}

/// One of a pair. Pairs with the same face often follow one another.
class PairMember {
 public:
  PairMember(const Operands& operands, const Facets& facets) : operands_(operands), facets_(facets) {}

  const PlaneTriangle& get(std::uint32_t face) {
    if (face != face_) {
      triangle_.emplace(
          PlaneTriangle{operands_.corners(face), operands_.vertices(face), facets_.known_plane_of_face(face)});
      face_ = face;
    }
    return *triangle_;
  }

 private:
  const Operands& operands_;
  const Facets& facets_;
  std::uint32_t face_ = kNone;
  std::optional<PlaneTriangle> triangle_;
};

bool touch(const TriangleContact& contact, const PlaneTriangle& first, const PlaneTriangle& second) {
  if (contact.is_coplanar) return intersect_triangles(first.corners, second.corners) != Contact::none;
  return contact.count > 0;
}

/// False if it was interrupted.
bool add_contacts(PairSpan pairs, const Operands& operands, const Facets& facets, Stage stage,
                  std::vector<PairContact>& result) {
  PairMember first_member(operands, facets), second_member(operands, facets);
  EdgeSides edge_sides;
  for (const auto& [first_face, second_face] : pairs) {
    if (!stage.begin_step()) return false;
    const PlaneTriangle &first = first_member.get(first_face), &second = second_member.get(second_face);
    const TriangleContact contact = contact_of(first, second, edge_sides);
    if (touch(contact, first, second)) result.push_back({first_face, second_face, contact});
  }
  return true;
}

}  // namespace

Result<std::vector<PairContact>> pair_contacts(PairSpan pairs, const Operands& operands, Facets& facets,
                                               const Monitor& monitor) {
  make_planes(pairs, operands, facets);
  std::vector<PairContact> result, others;
  const std::size_t half = pairs.size() / 2;
  // The two halves come along together; one tells for both.
  const Stage told(monitor, "finding what touches", half), silent(monitor.silent(), {}, half);
  bool is_done = false, are_others_done = false;
  in_parallel(
      pairs.size() >= kPairsWorthAThread,
      [&] { is_done = add_contacts(pairs.first(half), operands, facets, told, result); },
      [&] { are_others_done = add_contacts(pairs.subspan(half), operands, facets, silent, others); });
  if (!is_done || !are_others_done) return Monitor::interrupted();
  result.insert(result.end(), others.begin(), others.end());
  return result;
}

}  // namespace algebra3d::arrangement
