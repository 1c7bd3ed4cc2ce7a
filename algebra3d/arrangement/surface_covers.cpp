#include "algebra3d/arrangement/surface_covers.h"

#include <algorithm>
#include <unordered_map>

#include "algebra3d/arrangement/contact.h"
#include "algebra3d/halfedge/boxes.h"
#include "rtree/rtree.h"

namespace algebra3d::arrangement {
namespace {

using Tree = rtree::RTree<std::uint32_t>;

/// The faces of all facets of a plane.
std::unordered_map<std::uint32_t, Tree> trees_of_planes(const Skeleton& skeleton, const Pieces& pieces) {
  const Facets& facets = skeleton.facets();
  std::unordered_map<std::uint32_t, std::vector<rtree::Entry<std::uint32_t>>> entries;
  for (const Piece& piece : pieces.pieces) entries.try_emplace(piece.plane);
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (const std::uint32_t face : facets.faces(f))
      if (const auto of_plane = entries.find(facets[f].plane); of_plane != entries.end())
        of_plane->second.push_back({box_of_triangle(skeleton.operands().corners(face)), face});
  std::unordered_map<std::uint32_t, Tree> trees;
  for (const auto& [plane, boxes] : entries) trees.emplace(plane, Tree::bulk_load(boxes));
  return trees;
}

}  // namespace

Status complete_covers(const Skeleton& skeleton, Pieces& pieces, const Monitor& monitor) {
  const Facets& facets = skeleton.facets();
  const auto trees = trees_of_planes(skeleton, pieces);
  std::vector<Cover> covers;
  Stage stage(monitor.silent(), {}, pieces.pieces.size());
  for (Piece& piece : pieces.pieces) {
    if (!stage.begin_step()) return Monitor::interrupted();
    const auto given = pieces.covers_of(piece);
    const auto first = static_cast<std::uint32_t>(covers.size());
    covers.insert(covers.end(), given.begin(), given.end());
    const ExactPoint middle = skeleton.middle(piece.u, piece.v);
    for (const std::uint32_t face : trees.at(piece.plane).window(box_of(middle))) {
      const std::uint32_t facet = facets.of_face(face);
      const auto own = std::span(covers).subspan(first);
      if (std::ranges::find(own, facet, &Cover::facet) != own.end()) continue;
      // Not on the facet's boundary, along which the piece would have its cover: inside.
      if (TriangleInPlane(skeleton.operands().corners(face)).place(middle)) covers.push_back({facet, Side::both});
    }
    piece.first_cover = first;
    piece.last_cover = static_cast<std::uint32_t>(covers.size());
  }
  pieces.covers = std::move(covers);
  return {};
}

}  // namespace algebra3d::arrangement
