#include "algebra3d/kernel/arrangement/detail/pair_contacts.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/propagate.h"
#include "base/scheduler.h"

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

/// Which faces of pairs have exact corners, so that each face is looked at once.
class ExactFaces {
 public:
  explicit ExactFaces(const Operands& operands) : operands_(operands), notes_(operands.face_count()) {}

  bool contains(InputFaceId face) {
    Note& note = notes_[face];
    if (note == Note::unseen) note = has_exact_corner(operands_.corners(face)) ? Note::exact : Note::doubles;
    return note == Note::exact;
  }

 private:
  enum class Note : std::uint8_t { unseen, doubles, exact };

  const Operands& operands_;
  IdVector<InputFaceId, Note> notes_;
};

/// Planes of faces with corners that are not doubles, and of those that are compared with such. Between doubles, planes
/// would take longer.
PlanesOfFaces planes_for(PairSpan pairs, const Operands& operands) {
  PlanesOfFaces planes(operands);
  if (!has_exact_corners(operands)) return planes;
  ExactFaces exact(operands);
  IdVector<InputFaceId, bool> have_plane(operands.face_count());
  for (const auto& [first, second] : pairs) {
    if (have_plane[first] && have_plane[second]) continue;
    if (!exact.contains(first) && !exact.contains(second)) continue;
    for (const InputFaceId face : {first, second}) {
      if (have_plane[face]) continue;
      planes.get(face);
      have_plane[face] = true;
    }
  }
  return planes;
}

/// The triangles of pairs. Pairs with the same faces follow soon after one another, since they come from two leaves of
/// a hierarchy: so each face is looked up for some eight pairs.
class PairMembers {
 public:
  PairMembers(const Operands& operands, const PlanesOfFaces& planes) : operands_(operands), planes_(planes) {
    triangles_.reserve(kPlaces);
  }

  /// Valid until the next call.
  const PlaneTriangle& get(InputFaceId face) {
    Known& known = known_[face.index() % kPlaces];
    if (known.face != face) {
      const PlaneTriangle triangle(operands_.corners(face), operands_.vertices(face), planes_.find(face));
      if (known.face.is_none()) {
        known.triangle = triangles_.size();
        triangles_.push_back(triangle);
      } else {
        triangles_[known.triangle] = triangle;
      }
      known.face = face;
    }
    return triangles_[known.triangle];
  }

 private:
  static constexpr std::size_t kPlaces = 64;
  struct Known {
    InputFaceId face;
    std::size_t triangle = 0;  // its position in triangles_
  };

  const Operands& operands_;
  const PlanesOfFaces& planes_;
  std::array<Known, kPlaces> known_;  // each at the place that its number gives
  std::vector<PlaneTriangle> triangles_;
};

/// Contacts of the pairs that touch. Incomplete once the work is cancelled.
std::vector<PairContact> contacts_of(PairSpan pairs, const Operands& operands, const PlanesOfFaces& planes,
                                     Stage stage) {
  std::vector<PairContact> result;
  PairMembers first_members(operands, planes), second_members(operands, planes);
  EdgeSides edge_sides;
  for (const auto& [first_face, second_face] : pairs) {
    if (!stage.begin_step()) break;
    const PlaneTriangle &first = first_members.get(first_face), &second = second_members.get(second_face);
    const Signs sides = second.rounded_sides(first.corners());
    if (are_all_on_one_side(sides)) continue;
    const TriangleContact contact = contact_of(first, sides, second, edge_sides);
    if (!contact.is_empty()) result.push_back({first_face, second_face, contact});
  }
  return result;
}

}  // namespace

const IntegerPlane* PlanesOfFaces::find(InputFaceId face) const {
  if (const IntegerPlane* known = operands_->plane(face); known != nullptr) return known;
  return computed_of_.empty() ? nullptr : computed_of_[face];
}

const IntegerPlane& PlanesOfFaces::get(InputFaceId face) {
  if (const IntegerPlane* plane = find(face); plane != nullptr) return *plane;
  if (computed_of_.empty()) computed_of_.resize(operands_->face_count(), nullptr);
  computed_of_[face] = &computed_.emplace_back(IntegerPlane::through(operands_->corners(face)));
  return *computed_of_[face];
}

Result<PairContacts> find_pair_contacts(const Operands& operands, const Candidates& candidates,
                                        const Monitor& monitor) {
  const PairSpan pairs = candidates.pairs;
  PairContacts result{{}, planes_for(pairs, operands)};
  const Stage stage(monitor, "finding contacts", pairs.size());
  result.contacts =
      parallel_collect(pairs.size(), pairs_per_task(pairs.size()), [&](std::size_t begin, std::size_t end) {
        return contacts_of(pairs.subspan(begin, end - begin), operands, result.planes, stage);
      });
  A3D_TRY(monitor.check());
  return result;
}

}  // namespace algebra3d::arrangement
