#include "algebra3d/arrangement/facet_contacts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "algebra3d/arrangement/bucket_sort.h"
#include "algebra3d/arrangement/pair_contacts.h"

namespace algebra3d::arrangement {
namespace {

/// The smallest part of a mesh that holds a point: a corner, an edge, or a face; by half-edges that start or stand for
/// it, so that all faces round it name the same one.
struct Feature {
  Place::Kind kind;
  std::uint32_t number;  ///< vertex of the operands, edge, or facet

  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// A point of two facets, by the features of their meshes that it lies on: the same for all pairs of faces that have
/// it.
struct Meeting {
  Feature first, second;

  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// Where an end of a common part lies in one of the two faces.
struct FaceEnd {
  std::uint32_t
      halfedge;     ///< that begins at the corner, or runs along the edge; some one of the face if it lies inside
  bool runs_along;  ///< the edge is in the plane of the other face
};

/// What two faces have in common; a point if both ends are the same.
struct FaceContact {
  std::uint32_t first_facet, second_facet;
  struct End {
    Meeting meeting;
    FaceEnd first, second;
  };
  std::array<End, 2> ends;
  /// The half-edge of each face along which the common part runs; kNone if it does not.
  std::uint32_t first_edge, second_edge;

  auto key() const { return std::tie(first_facet, second_facet, ends[0].meeting, ends[1].meeting); }
  bool is_point() const { return ends[0].meeting == ends[1].meeting; }
};

class ContactFinder {
 public:
  ContactFinder(Facets& facets, Skeleton& skeleton)
      : operands_(skeleton.operands()), facets_(facets), skeleton_(skeleton) {}

  void add(const PairContact& pair);
  void join_faces();

 private:
  bool is_corner_on_corner(const PairContact& pair);
  Feature feature_of(std::uint32_t face, const Place& place) const;
  static std::uint32_t halfedge_of(std::uint32_t face, const Place& place) { return 3 * face + place.index; }
  bool is_end(const Feature& feature, const FaceEnd& end);
  bool is_real(const FaceContact::End& end);
  EdgeAndPlane crossing_of(const FaceContact& contact, const FaceContact::End& end);
  std::uint32_t vertex_of(const FaceContact& contact, const FaceContact::End& end);
  void compute_crossings();
  void cut_edges(const FaceContact::End& end, std::uint32_t vertex);
  void join_facets(std::span<const FaceContact> contacts);
  void add_points(std::span<const FaceContact> contacts);
  void add_segments(std::span<const FaceContact> contacts);

  const Operands& operands_;
  Facets& facets_;
  Skeleton& skeleton_;
  std::vector<FaceContact> contacts_;
};

void ContactFinder::add(const PairContact& pair) {
  const auto& [first_face, second_face, contact] = pair;
  const std::uint32_t first_facet = facets_.add(first_face), second_facet = facets_.add(second_face);
  if (contact.is_coplanar) {
    facets_.join_planes(first_facet, second_facet);
    return;
  }
  if (is_corner_on_corner(pair)) return;
  const auto along = [](std::uint32_t face, std::uint8_t edge) {
    return edge == TriangleContact::kNoEdge ? kNone : 3 * face + edge;
  };
  FaceContact found{
      first_facet, second_facet, {}, along(first_face, contact.first_edge), along(second_face, contact.second_edge)};
  for (std::size_t end = 0; end < 2; ++end) {
    const ContactPoint& point = contact.points[contact.count == 2 ? end : 0];
    found.ends[end] = {{feature_of(first_face, point.first), feature_of(second_face, point.second)},
                       {halfedge_of(first_face, point.first), point.first_runs_along},
                       {halfedge_of(second_face, point.second), point.second_runs_along}};
  }
  if (found.ends[1].meeting < found.ends[0].meeting) std::swap(found.ends[0], found.ends[1]);
  contacts_.push_back(found);
}

/// A point that bounds both facets anyhow: whatever runs through it in either of them ends there.
bool ContactFinder::is_corner_on_corner(const PairContact& pair) {
  const auto& [first, second, first_runs_along, second_runs_along] = pair.contact.points[0];
  return pair.contact.count == 1 && first.kind == Place::Kind::corner && second.kind == Place::Kind::corner &&
         facets_.has_boundary_origin(halfedge_of(pair.first_face, first)) &&
         facets_.has_boundary_origin(halfedge_of(pair.second_face, second));
}

Feature ContactFinder::feature_of(std::uint32_t face, const Place& place) const {
  const std::uint32_t halfedge = halfedge_of(face, place);
  switch (place.kind) {
    case Place::Kind::corner:
      return {place.kind, operands_.vertex(halfedge)};
    case Place::Kind::edge:
      return {place.kind, operands_.edge(halfedge)};
    default:
      return {place.kind, facets_.of_face(face)};
  }
}

/// True if common parts end at the feature, or at least everybody sees it, however the facet is triangulated.
bool ContactFinder::is_end(const Feature& feature, const FaceEnd& end) {
  switch (feature.kind) {
    case Place::Kind::corner:
      return facets_.has_boundary_origin(end.halfedge);
    case Place::Kind::edge:
      return !end.runs_along && facets_.is_boundary(end.halfedge);
    default:
      return false;
  }
}

bool ContactFinder::is_real(const FaceContact::End& end) {
  return is_end(end.meeting.first, end.first) || is_end(end.meeting.second, end.second);
}

/// Where a real end is that is no corner.
EdgeAndPlane ContactFinder::crossing_of(const FaceContact& contact, const FaceContact::End& end) {
  const auto& [meeting, first, second] = end;
  return is_end(meeting.first, first) ? EdgeAndPlane{meeting.first.number, facets_[contact.second_facet].plane}
                                      : EdgeAndPlane{meeting.second.number, facets_[contact.first_facet].plane};
}

/// The vertex of a real end.
std::uint32_t ContactFinder::vertex_of(const FaceContact& contact, const FaceContact::End& end) {
  const auto& [meeting, first, second] = end;
  if (meeting.first.kind == Place::Kind::corner) return skeleton_.corner(first.halfedge);
  if (meeting.second.kind == Place::Kind::corner) return skeleton_.corner(second.halfedge);
  return skeleton_.crossing_of_plane(crossing_of(contact, end));
}

/// Planes and points that will be needed, all at once.
void ContactFinder::compute_crossings() {
  std::vector<EdgeAndPlane> crossings;
  std::vector<std::uint32_t> planes;
  for (const FaceContact& contact : contacts_)
    for (const FaceContact::End& end : contact.ends) {
      const auto& [first, second] = end.meeting;
      if (first.kind == Place::Kind::corner || second.kind == Place::Kind::corner || !is_real(end)) continue;
      crossings.push_back(crossing_of(contact, end));
      // That of the edge as well: the result keeps planes of faces with such corners.
      planes.push_back(facets_[contact.first_facet].plane);
      planes.push_back(facets_[contact.second_facet].plane);
    }
  facets_.make_exact_planes(std::move(planes));
  skeleton_.compute_crossings(crossings);
}

void ContactFinder::cut_edges(const FaceContact::End& end, std::uint32_t vertex) {
  const auto& [meeting, first, second] = end;
  if (meeting.first.kind == Place::Kind::edge && facets_.is_boundary(first.halfedge))
    skeleton_.cut(skeleton_.edge_segment(meeting.first.number), vertex);
  if (meeting.second.kind == Place::Kind::edge && facets_.is_boundary(second.halfedge))
    skeleton_.cut(skeleton_.edge_segment(meeting.second.number), vertex);
}

void ContactFinder::join_faces() {
  compute_crossings();
  bucket_sort(
      contacts_, facets_.size(), [](const FaceContact& contact) { return contact.first_facet; },
      [](const FaceContact& a, const FaceContact& b) { return a.key() < b.key(); });
  for (std::size_t begin = 0, end = 0; begin < contacts_.size(); begin = end) {
    while (end < contacts_.size() && contacts_[end].first_facet == contacts_[begin].first_facet &&
           contacts_[end].second_facet == contacts_[begin].second_facet)
      ++end;
    join_facets(std::span(contacts_).subspan(begin, end - begin));
  }
}

void ContactFinder::join_facets(std::span<const FaceContact> contacts) {
  // Two faces at an artificial edge both report what lies along it; sorted, such reports are neighbours.
  std::vector<FaceContact> distinct;
  for (const FaceContact& contact : contacts)
    if (distinct.empty() || distinct.back().key() != contact.key()) distinct.push_back(contact);
  add_points(distinct);
  add_segments(distinct);
}

void ContactFinder::add_points(std::span<const FaceContact> contacts) {
  for (const FaceContact& contact : contacts) {
    if (!contact.is_point() || !is_real(contact.ends[0])) continue;
    const std::uint32_t vertex = vertex_of(contact, contact.ends[0]);
    cut_edges(contact.ends[0], vertex);
    // Also where it lies on a boundary: common parts with third facets may run along that.
    skeleton_.add_touch(contact.first_facet, vertex);
    skeleton_.add_touch(contact.second_facet, vertex);
  }
}

void ContactFinder::add_segments(std::span<const FaceContact> contacts) {
  struct End {
    Meeting meeting;
    std::uint32_t contact, end;
  };
  std::vector<End> artificial;  // each meeting twice
  std::vector<End> real;
  for (std::uint32_t c = 0; c < contacts.size(); ++c) {
    if (contacts[c].is_point()) continue;
    for (std::uint32_t end = 0; end < 2; ++end)
      (is_real(contacts[c].ends[end]) ? real : artificial).push_back({contacts[c].ends[end].meeting, c, end});
  }
  std::ranges::sort(artificial, {}, &End::meeting);
  // The part that goes on beyond an artificial end.
  const auto beyond = [&](std::uint32_t contact, std::uint32_t end) {
    const auto first = std::ranges::lower_bound(artificial, contacts[contact].ends[end].meeting, {}, &End::meeting);
    assert(std::next(first) < artificial.end() && std::next(first)->meeting == first->meeting);
    return first->contact == contact ? *std::next(first) : *first;
  };
  std::vector<bool> is_done(contacts.size());
  for (const End& start : real) {
    if (is_done[start.contact]) continue;
    std::uint32_t contact = start.contact, end = 1 - start.end;
    is_done[contact] = true;
    while (!is_real(contacts[contact].ends[end])) {
      const End continued = beyond(contact, end);
      contact = continued.contact;
      end = 1 - continued.end;
      is_done[contact] = true;
    }
    const std::uint32_t from = vertex_of(contacts[start.contact], contacts[start.contact].ends[start.end]);
    const std::uint32_t to = vertex_of(contacts[contact], contacts[contact].ends[end]);
    cut_edges(contacts[start.contact].ends[start.end], from);
    cut_edges(contacts[contact].ends[end], to);
    const std::uint32_t segment =
        skeleton_.add_contact(from, to, contacts[contact].first_facet, contacts[contact].second_facet);
    for (const std::uint32_t edge : {contacts[contact].first_edge, contacts[contact].second_edge})
      if (edge != kNone && facets_.is_boundary(edge))
        skeleton_.note_one_line(segment, skeleton_.edge_segment(operands_.edge(edge)));
  }
}

}  // namespace

Status find_contacts(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs, Facets& facets, Skeleton& skeleton,
                     const Monitor& monitor) {
  ContactFinder finder(facets, skeleton);
  ASSIGN_OR_RETURN(const std::vector<PairContact> contacts, pair_contacts(pairs, skeleton.operands(), facets, monitor));
  for (const PairContact& contact : contacts) finder.add(contact);
  facets.number_planes();
  finder.join_faces();
  skeleton.add_boundaries();
  return {};
}

}  // namespace algebra3d::arrangement
