#include "algebra3d/arrangement/classification.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

#include "algebra3d/arrangement/clean_edges.h"
#include "algebra3d/arrangement/faces_above.h"
#include "algebra3d/arrangement/point_location.h"
#include "algebra3d/arrangement/radial_order.h"
#include "algebra3d/arrangement/room_above.h"
#include "algebra3d/arrangement/wedges.h"
#include "algebra3d/arrangement/winding_sets.h"

namespace algebra3d::arrangement {
namespace {

class Classifier {
 public:
  Classifier(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches, Closure closure)
      : closure_(closure),
        skeleton_(skeleton),
        operands_(skeleton.operands()),
        facets_(skeleton.facets()),
        pieces_(pieces),
        patches_(patches),
        sets_(2 * pieces.pieces.size() + patches.patches.size()),
        location_(operands_),
        face_tree_(operands_),
        rooms_above_(operands_, location_),
        faces_above_(operands_, face_tree_) {}

  /// What each set's name stands for, as soon as a seed tells.
  using Names = std::map<std::uint32_t, Windings>;

  Result<Classification> run(const Monitor& monitor);

 private:
  /// A place at which the windings of a set can be told: a half-plane at a line, or a patch.
  struct Seed {
    std::size_t operand_count = 0;    ///< operands with a face there
    std::size_t first = 0, last = 0;  ///< pieces along the line
    HalfPlane half_plane{kNone, 0};
  };

  /// Windings of a room: those of a member, and by how much they exceed these.
  struct Front {
    std::uint32_t member;
    Windings excess;
  };

  std::uint32_t member_of_patch(std::uint32_t patch) const {
    return 2 * static_cast<std::uint32_t>(pieces_.pieces.size()) + patch;
  }
  const Windings& step(const HalfPlane& h) const { return pieces_.pieces[h.piece].steps[h.side]; }
  /// What the windings in the room that follows the half-plane counter-clockwise, or comes before it, exceed those in
  /// front of its cell by.
  Windings after(const HalfPlane& h) const { return h.side == 0 ? Windings{} : step(h); }
  Windings before(const HalfPlane& h) const { return h.side == 0 ? step(h) : Windings{}; }

  void join_lines();
  void join_line(std::size_t first, std::size_t last);
  void join_clean_edges();
  void join_fronts_of_faces(const Piece& piece, std::uint32_t member);
  /// Of the pieces along a line; in a room that the next call uses again.
  std::span<HalfPlane> half_planes(std::size_t first, std::size_t last, bool only_steps);
  std::size_t count_operands(std::size_t first, std::size_t last);
  /// Just in front of the cell of the seed's half-plane.
  Windings front_at(const Seed& seed);
  /// The same from what is above the middle of the line, for operands that are closed only together.
  Windings front_from_above(const Seed& seed);
  Windings front_at_patch(std::uint32_t patch);
  Windings front_at_patch_from_above(std::uint32_t patch);
  ExactPoint middle_of(std::uint32_t face) const;
  /// Ties the sets of patches inside many operands to what is above them.
  Status join_to_what_is_above(const Monitor& monitor, Names& names);
  /// Nothing if a face above is no patch's; else what stands for the room in which the way up ends: of the first other
  /// set that is met, or of the last face below the open air.
  struct Ascent {
    Front below;                 ///< the room above the last face of the own set
    std::optional<Front> above;  ///< the same room, as the other set knows it
  };
  std::optional<Ascent> ascend(std::uint32_t start);
  std::vector<std::uint32_t> highest_faces();
  /// Adds what operands other than `known` (ascending) contribute at the point.
  void add_others(const PointRef& point, const std::vector<std::uint32_t>& known, Windings& windings);

  Closure closure_;
  const Skeleton& skeleton_;
  const Operands& operands_;
  const Facets& facets_;
  const Pieces& pieces_;
  const Patches& patches_;
  WindingSets sets_;
  PointLocation location_;
  FaceTree face_tree_;
  RoomsAbove rooms_above_;
  FacesAbove faces_above_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> clean_lines_;  // u, v of the pieces of clean edges, ascending
  std::vector<Seed> line_seeds_;                                      // candidates, at most one per line
  std::vector<HalfPlane> half_planes_;                                // rooms that are used again and again
  std::vector<std::uint32_t> operands_at_line_;
};

std::span<HalfPlane> Classifier::half_planes(std::size_t first, std::size_t last, bool only_steps) {
  half_planes_.clear();
  for (auto p = static_cast<std::uint32_t>(first); p < last; ++p)
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (pieces_.is_covered(2 * p + side) && (!only_steps || pieces_.pieces[p].steps[side] != Windings{}))
        half_planes_.push_back({p, side});
    }
  return half_planes_;
}

std::size_t Classifier::count_operands(std::size_t first, std::size_t last) {
  operands_at_line_.clear();
  for (std::size_t p = first; p < last; ++p)
    for (const Cover& cover : pieces_.covers_of(pieces_.pieces[p]))
      operands_at_line_.push_back(facets_[cover.facet].operand);
  std::ranges::sort(operands_at_line_);
  return static_cast<std::size_t>(std::unique(operands_at_line_.begin(), operands_at_line_.end()) -
                                  operands_at_line_.begin());
}

void Classifier::join_line(std::size_t first, std::size_t last) {
  const std::span<HalfPlane> around = half_planes(first, last, true);
  if (around.empty()) return;
  sort_around_line(skeleton_, pieces_, around);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const HalfPlane &h = around[i], &next = around[i + 1 == around.size() ? 0 : i + 1];
    // front(h) + after(h) are the windings between the two, and so are front(next) + before(next).
    sets_.unite(h.cell_side(), next.cell_side(), after(h) - before(next));
  }
  line_seeds_.push_back({count_operands(first, last), first, last, around.front()});
}

void Classifier::join_lines() {
  const auto& pieces = pieces_.pieces;
  for (std::size_t first = 0, last = 0; first < pieces.size(); first = last) {
    while (last < pieces.size() && pieces[last].u == pieces[first].u && pieces[last].v == pieces[first].v) ++last;
    if (!std::ranges::binary_search(clean_lines_, std::pair(pieces[first].u, pieces[first].v))) join_line(first, last);
  }
}

/// No other operand is at a clean edge, so the windings in front of all faces along each of its pieces are the same.
/// What is between the faces is not looked at, for not all of them are cells.
void Classifier::join_clean_edges() {
  for (const CleanEdge& edge : clean_edges(skeleton_, patches_)) {
    const auto in_patch =
        std::ranges::find_if(edge.halfedges, [&](auto h) { return patches_.of_face[h / 3] != kNone; });
    const std::uint32_t first = member_of_patch(patches_.of_face[*in_patch / 3]);
    for (const std::uint32_t h : edge.halfedges)
      if (patches_.of_face[h / 3] != kNone) sets_.unite(first, member_of_patch(patches_.of_face[h / 3]), {});
    const auto vertices = pieces_.segments.vertices(edge.segment);
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      clean_lines_.emplace_back(std::minmax(vertices[i], vertices[i + 1]));
      for (const Piece& piece : pieces_.along(vertices[i], vertices[i + 1])) join_fronts_of_faces(piece, first);
    }
  }
  std::ranges::sort(clean_lines_);
}

/// The windings in front of all faces along the piece are those of the member.
void Classifier::join_fronts_of_faces(const Piece& piece, std::uint32_t member) {
  const auto number = static_cast<std::uint32_t>(&piece - pieces_.pieces.data());
  for (const Cover& cover : pieces_.covers_of(piece))
    for (std::uint32_t side = 0; side < 2; ++side) {
      if (!cover.is_on(side == 0 ? Side::left : Side::right)) continue;
      const HalfPlane cell{number, side};
      // The cell's front and its step are those in front of the face, unless the face looks to the back of its plane.
      const Windings excess = facets_[cover.facet].orientation > 0 ? Windings{} : step(cell);
      sets_.unite(member, cell.cell_side(), Windings{} - excess);
    }
}

void Classifier::add_others(const PointRef& point, const std::vector<std::uint32_t>& known, Windings& windings) {
  for (const std::uint32_t operand : location_.near(point))
    if (!std::ranges::binary_search(known, operand))
      windings[operands_.group(operand)] += location_.crossings_above(operand, point);
}

Windings Classifier::front_at(const Seed& seed) {
  // From the room after the half-plane on, the first face of an operand that is met says on which side of it this is.
  const std::span<HalfPlane> around = half_planes(seed.first, seed.last, false);
  const auto start = std::ranges::find_if(
      around, [&](const HalfPlane& h) { return h.piece == seed.half_plane.piece && h.side == seed.half_plane.side; });
  std::swap(around.front(), *start);
  sort_around_line(skeleton_, pieces_, around);
  std::rotate(around.begin(), around.begin() + 1, around.end());

  Windings windings{};
  std::vector<std::uint32_t> known;
  for (const HalfPlane& h : around)
    for (const Cover& cover : pieces_.covers_of(pieces_.pieces[h.piece])) {
      if (!cover.is_on(h.side == 0 ? Side::left : Side::right)) continue;
      const Facet& facet = facets_[cover.facet];
      if (std::ranges::find(known, facet.operand) != known.end()) continue;
      known.push_back(facet.operand);
      // A left half-plane is met from behind.
      const bool is_inside = (h.side == 0) == (facet.orientation > 0);
      if (is_inside) ++windings[operands_.group(facet.operand)];
    }
  std::ranges::sort(known);
  const Piece& piece = pieces_.pieces[seed.half_plane.piece];
  if (known.size() != operands_.count()) add_others(skeleton_.middle(piece.u, piece.v), known, windings);
  return windings - after(seed.half_plane);
}

Windings Classifier::front_from_above(const Seed& seed) {
  const std::span<HalfPlane> around = half_planes(seed.first, seed.last, true);
  sort_around_line(skeleton_, pieces_, around);
  const HalfPlane& below = before_room_above(skeleton_, pieces_, around);
  const Piece& piece = pieces_.pieces[below.piece];
  const Windings front = rooms_above_.windings(skeleton_.middle(piece.u, piece.v)) - after(below);
  const auto from = sets_.find(below.cell_side()), to = sets_.find(seed.half_plane.cell_side());
  return front - from.difference + to.difference;
}

ExactPoint Classifier::middle_of(std::uint32_t face) const {
  const TriangleRef corners = operands_.corners(face);
  return ExactPoint(Rational(1, 3) * (corners[0].rational() + corners[1].rational() + corners[2].rational()));
}

Windings Classifier::front_at_patch_from_above(std::uint32_t patch) {
  const Patch& at = patches_.patches[patch];
  Windings step{};
  if (!is_room_above_in_front(operands_.corners(at.first_face))) step[operands_.group(at.operand)] = 1;
  return rooms_above_.windings(middle_of(at.first_face)) - step;
}

std::optional<Classifier::Ascent> Classifier::ascend(std::uint32_t start) {
  const std::uint32_t patch = patches_.of_face[start];
  const auto room = [&](std::uint32_t of, bool is_in_front) {
    Front front{member_of_patch(of), {}};
    if (!is_in_front) front.excess[operands_.group(patches_.patches[of].operand)] = 1;
    return front;
  };
  const std::uint32_t own_set = sets_.find(member_of_patch(patch)).set;
  Ascent ascent{room(patch, is_room_above_in_front(operands_.corners(start))), {}};
  bool are_all_patches = true;
  const bool is_ordered = faces_above_.for_each(middle_of(start), [&](std::uint32_t face, int sign) {
    const std::uint32_t met = patches_.of_face[face];
    are_all_patches = met != kNone;
    if (!are_all_patches) return false;
    if (sets_.find(member_of_patch(met)).set != own_set) {
      ascent.above = room(met, sign < 0);
      return false;
    }
    ascent.below = room(met, sign > 0);
    return true;
  });
  if (!is_ordered || !are_all_patches) return std::nullopt;
  return ascent;
}

/// Of each set with patches, the face in one of them whose middle is highest: from there the way up is shortest.
std::vector<std::uint32_t> Classifier::highest_faces() {
  struct Highest {
    double height;
    std::uint32_t face = kNone;
  };
  const auto raise = [](Highest& highest, const Highest& other) {
    if (highest.face == kNone || highest.height < other.height) highest = other;
  };
  std::vector<Highest> of_patches(patches_.patches.size());
  for (std::uint32_t face = 0; face < operands_.face_count(); ++face) {
    const std::uint32_t patch = patches_.of_face[face];
    if (patch == kNone) continue;
    const TriangleRef corners = operands_.corners(face);
    raise(of_patches[patch], {corners[0].approx.z / 3 + corners[1].approx.z / 3 + corners[2].approx.z / 3, face});
  }
  std::map<std::uint32_t, Highest> of_sets;
  for (std::uint32_t patch = 0; patch < of_patches.size(); ++patch)
    raise(of_sets[sets_.find(member_of_patch(patch)).set], of_patches[patch]);
  std::vector<std::uint32_t> result;
  result.reserve(of_sets.size());
  for (const auto& [set, highest] : of_sets) result.push_back(highest.face);
  std::ranges::sort(result);
  return result;
}

/// From one face of each set the way leads up to another set, or to the open air. A set that is tied to others is one
/// with them from then on; since each takes one step that ties two sets or ends in the open, one of those that are tied
/// together has ended there. So no set needs more than the way to the next one, however many are around it.
Status Classifier::join_to_what_is_above(const Monitor& monitor, Names& names) {
  constexpr std::size_t kMany = 8;
  if (operands_.count() <= kMany) return {};
  std::vector<Front> in_the_open;
  for (const std::uint32_t face : highest_faces()) {
    if (!location_.is_near_many(operands_.point_of(3 * face), kMany)) continue;
    RETURN_IF_ERROR(monitor.check());
    const std::optional<Ascent> ascent = ascend(face);
    if (!ascent) continue;
    if (ascent->above)
      sets_.unite(ascent->below.member, ascent->above->member, ascent->below.excess - ascent->above->excess);
    else
      in_the_open.push_back(ascent->below);
  }
  for (const Front& front : in_the_open) {
    const auto [set, difference] = sets_.find(front.member);
    names.try_emplace(set, Windings{} - front.excess - difference);
  }
  return {};
}

Windings Classifier::front_at_patch(std::uint32_t patch) {
  const Patch& at = patches_.patches[patch];
  Windings windings{};
  add_others(operands_.point_of(3 * at.first_face), {at.operand}, windings);
  return windings;
}

Result<Classification> Classifier::run(const Monitor& monitor) {
  monitor.tell("telling inside from outside");
  join_cells(skeleton_, pieces_, sets_);
  join_clean_edges();
  join_lines();

  Names names;
  if (closure_ == Closure::each) RETURN_IF_ERROR(join_to_what_is_above(monitor, names));
  // Lines where many operands meet need the fewest rays.
  std::ranges::stable_sort(line_seeds_, std::ranges::greater{}, &Seed::operand_count);
  for (const Seed& seed : line_seeds_) {
    const auto [set, difference] = sets_.find(seed.half_plane.cell_side());
    const auto [entry, is_new] = names.try_emplace(set);
    if (!is_new) continue;
    RETURN_IF_ERROR(monitor.check());
    entry->second = (closure_ == Closure::each ? front_at(seed) : front_from_above(seed)) - difference;
  }
  for (std::uint32_t patch = 0; patch < patches_.patches.size(); ++patch) {
    const auto [set, difference] = sets_.find(member_of_patch(patch));
    const auto [entry, is_new] = names.try_emplace(set);
    if (!is_new) continue;
    RETURN_IF_ERROR(monitor.check());
    entry->second = (closure_ == Closure::each ? front_at_patch(patch) : front_at_patch_from_above(patch)) - difference;
  }

  Classification result;
  const auto windings_of = [&](std::uint32_t member) {
    const auto [set, difference] = sets_.find(member);
    const auto name = names.find(set);
    return name == names.end() ? Windings{} : name->second + difference;
  };
  for (std::uint32_t side = 0; side < 2 * pieces_.pieces.size(); ++side)
    result.cell_fronts.push_back(windings_of(side));
  for (std::uint32_t patch = 0; patch < patches_.patches.size(); ++patch)
    result.patch_fronts.push_back(windings_of(member_of_patch(patch)));
  return result;
}

}  // namespace

Result<Classification> classify(const Skeleton& skeleton, const Pieces& pieces, const Patches& patches, Closure closure,
                                const Monitor& monitor) {
  return Classifier(skeleton, pieces, patches, closure).run(monitor);
}

}  // namespace algebra3d::arrangement
