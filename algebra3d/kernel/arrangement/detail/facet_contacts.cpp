#include "algebra3d/kernel/arrangement/detail/facet_contacts.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>

#include "algebra3d/kernel/arrangement/detail/crossings.h"
#include "algebra3d/kernel/arrangement/detail/face_contacts.h"
#include "algebra3d/kernel/arrangement/detail/numbers_by_bucket.h"
#include "algebra3d/kernel/arrangement/detail/segment_maker.h"
#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/equal_span.h"
#include "base/propagate.h"

namespace algebra3d::arrangement {
namespace {

/// One of the two ends of a contact.
struct ContactEnd {
  const FaceContact* contact;
  std::size_t number;

  const FaceContactEnd& get() const { return contact->ends[number]; }
  const FeaturePair& features() const { return get().features; }
  ContactEnd opposite() const { return {contact, 1 - number}; }
};

/// Joins the contacts of one block of facets after another: the memory for contacts of faces and points that are not
/// joined yet is that of one block.
class FacetContactFinder {
 public:
  FacetContactFinder(const Operands& operands, const Facets& facets)
      : operands_(operands),
        facets_(facets),
        boundaries_(operands, facets),
        crossings_(operands, facets, complex_),
        segments_(operands, facets, complex_),
        has_coefficients_(facets.planes.size()) {
    complex_.coefficients = PlaneCoefficients(facets);
  }

  Result<SegmentComplex> run(const PairContacts& contacts);

 private:
  void find_face_contacts(const PairContacts& contacts, std::span<const std::uint32_t> numbers);
  void compute_crossings();
  Status join_block();
  bool is_end(const Feature& feature, const EndInFace& end);
  bool is_real(const FaceContactEnd& end);
  bool is_segment(const FaceContact& contact) {
    return !contact.is_point() && is_real(contact.ends[0]) && is_real(contact.ends[1]);
  }
  EdgeAndPlane crossing_of(const FaceContact& contact, const FaceContactEnd& end);
  NodeId node_of(const FaceContact& contact, const FaceContactEnd& end);
  void cut_edges(const FaceContactEnd& end, NodeId node);

  Status join_facets(std::span<const FaceContact> contacts);
  void add_points(std::span<const FaceContact> contacts);
  Status add_segments(std::span<const FaceContact> contacts);
  void sort_ends(std::span<const FaceContact> contacts);
  std::optional<ContactEnd> beyond(const ContactEnd& end) const;
  std::optional<ContactEnd> end_of_chain(const ContactEnd& start, std::span<const FaceContact> contacts);
  Error broken_chain(const ContactEnd& start) const;
  void add_segment(const ContactEnd& start, const ContactEnd& end);

  const Operands& operands_;
  const Facets& facets_;
  SegmentComplex complex_;
  FacetBoundaries boundaries_;
  Crossings crossings_;
  SegmentMaker segments_;
  IdVector<PlaneId, bool> has_coefficients_;
  std::vector<FaceContact> block_;  // ascending, facet by facet
  // Contacts of the two facets at hand; a member, so that its memory is used again.
  std::vector<FaceContact> distinct_;
  std::vector<ContactEnd> real_, artificial_;  // the latter ascending; each point twice
  std::vector<bool> is_done_;                  // per contact
};

/// Adds the contacts of one first facet to the block.
void FacetContactFinder::find_face_contacts(const PairContacts& contacts, std::span<const std::uint32_t> numbers) {
  const auto first = static_cast<std::ptrdiff_t>(block_.size());
  for (const std::uint32_t number : numbers)
    if (const auto contact = face_contact(contacts.contacts[number], operands_, facets_, boundaries_))
      block_.push_back(*contact);
  std::sort(block_.begin() + first, block_.end(),
            [](const FaceContact& a, const FaceContact& b) { return a.key() < b.key(); });
}

/// True if common parts end at the feature, or at least everybody sees it, however the facet is triangulated.
bool FacetContactFinder::is_end(const Feature& feature, const EndInFace& end) {
  if (feature.is_vertex()) return boundaries_.has_origin(end.halfedge);
  return feature.is_edge() && !end.runs_along && boundaries_.has_edge(end.halfedge);
}

/// False for an end that the triangulation alone has made.
bool FacetContactFinder::is_real(const FaceContactEnd& end) {
  return is_end(end.features.first, end.first) || is_end(end.features.second, end.second);
}

/// The edge and the plane that meet in a real end which is not a vertex of an operand.
EdgeAndPlane FacetContactFinder::crossing_of(const FaceContact& contact, const FaceContactEnd& end) {
  const auto& [features, first, second] = end;
  return is_end(features.first, first) ? EdgeAndPlane{features.first.edge(), facets_[contact.second_facet].plane}
                                       : EdgeAndPlane{features.second.edge(), facets_[contact.first_facet].plane};
}

/// The node at a real end.
NodeId FacetContactFinder::node_of(const FaceContact& contact, const FaceContactEnd& end) {
  const auto& [features, first, second] = end;
  if (features.first.is_vertex()) return segments_.node_at_origin(first.halfedge);
  if (features.second.is_vertex()) return segments_.node_at_origin(second.halfedge);
  return crossings_.of_edge_and_plane(crossing_of(contact, end));
}

/// Planes and points that the block will need, all at once.
void FacetContactFinder::compute_crossings() {
  std::vector<EdgeAndPlane> crossings;
  std::vector<PlaneId> planes;
  for (const FaceContact& contact : block_)
    for (const FaceContactEnd& end : contact.ends) {
      if (end.features.first.is_vertex() || end.features.second.is_vertex() || !is_real(end)) continue;
      crossings.push_back(crossing_of(contact, end));
      // That of the edge as well: the result keeps planes of faces with such corners.
      for (const FacetId facet : {contact.first_facet, contact.second_facet}) {
        const PlaneId plane = facets_[facet].plane;
        if (!has_coefficients_[plane]) planes.push_back(plane);
        has_coefficients_[plane] = true;
      }
    }
  complex_.coefficients.compute(facets_, planes);
  crossings_.compute(crossings);
}

void FacetContactFinder::cut_edges(const FaceContactEnd& end, NodeId node) {
  const auto& [features, first, second] = end;
  if (features.first.is_edge() && boundaries_.has_edge(first.halfedge))
    complex_.cuts.push_back({segments_.of_edge(features.first.edge()), node});
  if (features.second.is_edge() && boundaries_.has_edge(second.halfedge))
    complex_.cuts.push_back({segments_.of_edge(features.second.edge()), node});
}

Status FacetContactFinder::join_facets(std::span<const FaceContact> contacts) {
  // Solids in general position have hardly any others: nothing is to be joined.
  if (contacts.size() == 1 && is_segment(contacts[0])) {
    add_segment({contacts.data(), 0}, {contacts.data(), 1});
    return {};
  }
  // Two faces at an artificial edge both report what lies along it; sorted, such reports are neighbours.
  distinct_.clear();
  for (const FaceContact& contact : contacts)
    if (distinct_.empty() || distinct_.back().key() != contact.key()) distinct_.push_back(contact);
  add_points(distinct_);
  return add_segments(distinct_);
}

void FacetContactFinder::add_points(std::span<const FaceContact> contacts) {
  for (const FaceContact& contact : contacts) {
    if (!contact.is_point() || !is_real(contact.ends[0])) continue;
    const NodeId node = node_of(contact, contact.ends[0]);
    cut_edges(contact.ends[0], node);
    // Also where it lies on a boundary: common parts with third facets may run along that.
    complex_.touches.push_back({contact.first_facet, node});
    complex_.touches.push_back({contact.second_facet, node});
  }
}

/// Each segment is a chain of common parts of faces, from one real end over artificial ones to another real end.
Status FacetContactFinder::add_segments(std::span<const FaceContact> contacts) {
  sort_ends(contacts);
  is_done_.assign(contacts.size(), false);
  for (const ContactEnd& start : real_) {
    if (is_done_[static_cast<std::size_t>(start.contact - contacts.data())]) continue;
    const std::optional<ContactEnd> end = end_of_chain(start, contacts);
    if (!end) return broken_chain(start);
    add_segment(start, *end);
  }
  return {};
}

void FacetContactFinder::sort_ends(std::span<const FaceContact> contacts) {
  real_.clear();
  artificial_.clear();
  for (const FaceContact& contact : contacts) {
    if (contact.is_point()) continue;
    for (const std::size_t end : {0U, 1U})
      (is_real(contact.ends[end]) ? real_ : artificial_).push_back({&contact, end});
  }
  std::ranges::sort(artificial_, {}, &ContactEnd::features);
}

/// The end of another contact with which the segment goes on beyond an artificial end.
std::optional<ContactEnd> FacetContactFinder::beyond(const ContactEnd& end) const {
  const auto ends = equal_span(artificial_, end.features(), &ContactEnd::features);
  if (ends.size() != 2) return std::nullopt;
  return ends[0].contact == end.contact ? ends[1] : ends[0];
}

std::optional<ContactEnd> FacetContactFinder::end_of_chain(const ContactEnd& start,
                                                           std::span<const FaceContact> contacts) {
  for (std::optional<ContactEnd> at = start; at;) {
    const auto contact = static_cast<std::size_t>(at->contact - contacts.data());
    if (is_done_[contact]) break;
    is_done_[contact] = true;
    const ContactEnd end = at->opposite();
    if (is_real(end.get())) return end;
    at = beyond(end);
  }
  return std::nullopt;
}

Error FacetContactFinder::broken_chain(const ContactEnd& start) const {
  const Vec3 first = facets_.plane_of(start.contact->first_facet).triangle()[0].approx;
  const Vec3 second = facets_.plane_of(start.contact->second_facet).triangle()[0].approx;
  return {ErrorCode::internal,
          "joining the common parts of the facets with triangles near ({} {} {}) and ({} {} {}): one ends inside both",
          first.x,
          first.y,
          first.z,
          second.x,
          second.y,
          second.z};
}

void FacetContactFinder::add_segment(const ContactEnd& start, const ContactEnd& end) {
  const FaceContact& last = *end.contact;
  const NodeId from = node_of(*start.contact, start.get()), to = node_of(last, end.get());
  cut_edges(start.get(), from);
  cut_edges(end.get(), to);
  const SegmentId segment = segments_.of_contact(from, to, last.first_facet, last.second_facet);
  for (const InputHalfedgeId edge : {last.first_edge, last.second_edge})
    if (!edge.is_none() && boundaries_.has_edge(edge))
      complex_.note_collinear(segment, segments_.of_edge(operands_.edge(edge)));
}

Status FacetContactFinder::join_block() {
  compute_crossings();
  const auto facets_of = [](const FaceContact& contact) { return std::tie(contact.first_facet, contact.second_facet); };
  for (std::size_t begin = 0, end = 0; begin < block_.size(); begin = end) {
    while (end < block_.size() && facets_of(block_[end]) == facets_of(block_[begin])) ++end;
    A3D_TRY(join_facets(std::span(block_).subspan(begin, end - begin)));
  }
  block_.clear();
  return {};
}

Result<SegmentComplex> FacetContactFinder::run(const PairContacts& contacts) {
  const NumbersByBucket by_first_facet(contacts.contacts.size(), facets_.facets.size(), [&](std::size_t number) {
    return facets_.of_face[contacts.contacts[number].first_face].index();
  });
  // An edge that meets a plane is one of two faces, so there are about as many points as contacts.
  crossings_.reserve(contacts.contacts.size());
  segments_.reserve(contacts.contacts.size());
  for (const FacetId facet : facets_.ids()) {
    find_face_contacts(contacts, by_first_facet.of(facet.index()));
    if (block_.size() < kContactsPerBlock) continue;
    A3D_TRY(join_block());
  }
  A3D_TRY(join_block());
  segments_.add_boundaries();
  return std::move(complex_);
}

}  // namespace

Result<SegmentComplex> find_facet_contacts(const Operands& operands, const Facets& facets,
                                           const PairContacts& contacts) {
  return FacetContactFinder(operands, facets).run(contacts);
}

}  // namespace algebra3d::arrangement
