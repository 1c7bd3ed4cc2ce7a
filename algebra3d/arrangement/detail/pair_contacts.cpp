#include "algebra3d/arrangement/detail/pair_contacts.h"

#include <algorithm>
#include <optional>
#include <span>

#include "algebra3d/base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

using PairSpan = std::span<const FacePair>;

/// Pairs of one task: enough to be worth it, and at most 64 tasks.
std::size_t pairs_per_task(std::size_t pairs) {
  return std::max<std::size_t>(250, pairs / 64);
}

bool has_exact_corners(const Operands& operands) {
  return std::ranges::any_of(operands.ids(),
                             [&](OperandId operand) { return operands.mesh(operand).points().exact_count() > 0; });
}

/// Kinds of the faces that come up in pairs (exact corners, plane made or not), so that each face is looked at once.
class FaceNotes {
 public:
  explicit FaceNotes(const Operands& operands) : operands_(operands), notes_(operands.face_count()) {}

  bool is_exact(InputFaceId face) {
    Note& note = notes_[face];
    if (note == Note::unseen) note = has_exact_corner(operands_.corners(face)) ? Note::exact : Note::doubles;
    return note == Note::exact || note == Note::exact_with_plane;
  }
  /// True at the first call for a face that was seen.
  bool begins_to_have_plane(InputFaceId face) {
    Note& note = notes_[face];
    if (note == Note::doubles_with_plane || note == Note::exact_with_plane) return false;
    note = note == Note::exact ? Note::exact_with_plane : Note::doubles_with_plane;
    return true;
  }

 private:
  enum class Note : std::uint8_t { unseen, doubles, exact, doubles_with_plane, exact_with_plane };

  const Operands& operands_;
  IdVector<InputFaceId, Note> notes_;
};

/// Planes of faces with corners that are no doubles, and of those that are compared with such. Between doubles, planes
/// would take longer.
PlanesOfFaces planes_for(PairSpan pairs, const Operands& operands) {
  PlanesOfFaces planes(operands);
  if (!has_exact_corners(operands)) return planes;
  FaceNotes notes(operands);
  for (const auto& [first, second] : pairs) {
    const bool is_first_exact = notes.is_exact(first), is_second_exact = notes.is_exact(second);
    if (!is_first_exact && !is_second_exact) continue;
    for (const InputFaceId face : {first, second})
      if (notes.begins_to_have_plane(face)) planes.get(face);
  }
  return planes;
}

/// One of a pair. Pairs with the same face often follow one another.
class PairMember {
 public:
  PairMember(const Operands& operands, const PlanesOfFaces& planes) : operands_(operands), planes_(planes) {}

  const PlaneTriangle& get(InputFaceId face) {
    if (face != face_) {
      triangle_.emplace(operands_.corners(face), operands_.vertices(face), planes_.find(face));
      face_ = face;
    }
    return *triangle_;
  }

 private:
  const Operands& operands_;
  const PlanesOfFaces& planes_;
  InputFaceId face_;
  std::optional<PlaneTriangle> triangle_;
};

/// Contacts of the pairs that touch. Incomplete once the work is cancelled.
std::vector<PairContact> contacts_of(PairSpan pairs, const Operands& operands, const PlanesOfFaces& planes,
                                     Stage stage) {
  std::vector<PairContact> result;
  PairMember first_member(operands, planes), second_member(operands, planes);
  EdgeSides edge_sides;
  for (const auto& [first_face, second_face] : pairs) {
    if (!stage.begin_step()) break;
    const PlaneTriangle& second = second_member.get(second_face);
    // Most faces are clearly beside the other one's plane, and need not be looked up any further.
    if (are_all_on_one_side(second.rounded_sides(operands.corners(first_face)))) continue;
    const TriangleContact contact = contact_of(first_member.get(first_face), second, edge_sides);
    if (!contact.is_empty()) result.push_back({first_face, second_face, contact});
  }
  return result;
}

}  // namespace

Result<PairContacts> find_pair_contacts(const Operands& operands, const Candidates& candidates,
                                        const Monitor& monitor) {
  const PairSpan pairs = candidates.pairs;
  PairContacts result{{}, planes_for(pairs, operands)};
  const Stage stage(monitor, "finding what touches", pairs.size());
  result.contacts =
      parallel_collect(pairs.size(), pairs_per_task(pairs.size()), [&](std::size_t begin, std::size_t end) {
        return contacts_of(pairs.subspan(begin, end - begin), operands, result.planes, stage);
      });
  ALGEBRA3D_RETURN_IF_ERROR(monitor.check());
  return result;
}

}  // namespace algebra3d::arrangement
