// The auditor of MeshEditor.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/halfedge/mesh_editor.h"

namespace algebra3d {

void MeshEditor::audit_halfedges(std::vector<std::string>& found) const {
  std::size_t unused = 0;
  for (std::size_t i = 0; i < halfedges_.size(); ++i) {
    const HalfedgeId h(i);
    if (!is_used(h)) {
      ++unused;
      continue;
    }
    const Halfedge& half = halfedges_[i];
    for (const HalfedgeId other : {half.next, half.prev, half.opposite})
      if (other.index() >= halfedges_.size() || !is_used(other))
        return found.push_back(fmt::format("half-edge {} refers to {}, which is not in use", i, other.index()));
    if (half.origin.index() >= vertices_.size() || !is_used(half.origin))
      return found.push_back(fmt::format("half-edge {} leaves an unused vertex", i));
    if (half.face.is_valid() && (half.face.index() >= faces_.size() || !is_used(half.face)))
      return found.push_back(fmt::format("half-edge {} is of an unused face", i));
    if (prev(half.next) != h || next(half.prev) != h)
      found.push_back(fmt::format("half-edge {} is not between its neighbours", i));
    if (opposite(half.opposite) != h || half.opposite == h)
      found.push_back(fmt::format("half-edge {} is not the opposite of its opposite", i));
    if (face(half.next) != half.face) found.push_back(fmt::format("half-edge {} and its next differ in the face", i));
    if (origin(half.next) != origin(half.opposite))
      found.push_back(fmt::format("half-edge {} does not end where its next begins", i));
    if (is_boundary(h) && is_boundary(half.opposite))
      found.push_back(fmt::format("the edge of half-edge {} has no face", i));
  }
  if (unused != free_halfedges_.size()) found.emplace_back("unused half-edges are not all free");
}

void MeshEditor::audit_edges(std::vector<std::string>& found) const {
  std::vector<std::pair<VertexId, VertexId>> ends;
  for (std::size_t i = 0; i < halfedges_.size(); ++i)
    if (is_used(HalfedgeId(i))) ends.emplace_back(origin(HalfedgeId(i)), target(HalfedgeId(i)));
  std::ranges::sort(ends);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].first == ends[i].second)
      found.push_back(fmt::format("an edge joins vertex {} to itself", ends[i].first.index()));
    if (i > 0 && ends[i] == ends[i - 1])
      found.push_back(fmt::format("two edges join vertices {} and {}", ends[i].first.index(), ends[i].second.index()));
  }
}

void MeshEditor::audit_faces(std::vector<std::string>& found) const {
  // Each half-edge is on one closed walk, since next and prev are inverse: so the degrees must add up.
  std::size_t unused = 0, corners = 0, with_face = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const FaceId id(f);
    if (!is_used(id)) {
      ++unused;
      continue;
    }
    if (!is_used(faces_[f]) || face(faces_[f]) != id) {
      found.push_back(fmt::format("face {} does not have its half-edge", f));
      continue;
    }
    corners += degree(id);
    if (degree(id) < 3) found.push_back(fmt::format("face {} has {} corners", f, degree(id)));
  }
  for (std::size_t i = 0; i < halfedges_.size(); ++i)
    with_face += static_cast<std::size_t>(is_used(HalfedgeId(i)) && !is_boundary(HalfedgeId(i)));
  if (corners != with_face) found.emplace_back("a face has more than one loop of half-edges");
  if (unused != free_faces_.size()) found.emplace_back("unused faces are not all free");
}

void MeshEditor::audit_vertices(std::vector<std::string>& found) const {
  std::vector<std::size_t> leaving(vertices_.size(), 0), beyond(vertices_.size(), 0);
  for (std::size_t i = 0; i < halfedges_.size(); ++i) {
    const HalfedgeId h(i);
    if (!is_used(h)) continue;
    ++leaving[origin(h).index()];
    beyond[origin(h).index()] += static_cast<std::size_t>(is_boundary(h));
  }
  std::size_t unused = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const VertexId id(v);
    unused += static_cast<std::size_t>(!is_used(id));
    const HalfedgeId out = outgoing(id);
    if (out.is_valid() && (!is_used(out) || origin(out) != id)) {
      found.push_back(fmt::format("vertex {} does not have its half-edge", v));
      continue;
    }
    if (valence(id) != leaving[v]) found.push_back(fmt::format("the faces at vertex {} form several fans", v));
    if (beyond[v] > 1) found.push_back(fmt::format("vertex {} is on the boundary more than once", v));
    if (beyond[v] == 1 && !is_boundary(out))
      found.push_back(fmt::format("vertex {} is on the boundary, and its half-edge is not", v));
  }
  if (unused != free_vertices_.size()) found.emplace_back("unused vertices are not all free");
}

std::vector<std::string> MeshEditor::audit() const {
  std::vector<std::string> found;
  audit_halfedges(found);
  // The others walk along the half-edges.
  if (!found.empty()) return found;
  audit_edges(found);
  audit_faces(found);
  audit_vertices(found);
  return found;
}

}  // namespace algebra3d
