#include "algebra3d/arrangement/pieces.h"

#include <algorithm>
#include <tuple>

#include "algebra3d/arrangement/bucket_sort.h"
#include "algebra3d/exact/predicates.h"

namespace algebra3d::arrangement {
namespace {

/// A piece in one facet, before those of one place are brought together.
struct FacetPiece {
  std::uint32_t u, v, plane, facet;
  Side side;

  auto place() const { return std::tie(u, v, plane); }
  friend auto operator<=>(const FacetPiece&, const FacetPiece&) = default;
};

Side opposite(Side side) {
  return side == Side::left ? Side::right : side == Side::right ? Side::left : Side::both;
}

std::vector<FacetPiece> facet_pieces(const Skeleton& skeleton, const CutSegments& segments) {
  std::vector<FacetPiece> pieces;
  for (const Incidence& incidence : skeleton.incidences()) {
    const auto vertices = segments.vertices(incidence.segment);
    const std::uint32_t plane = skeleton.facets()[incidence.facet].plane;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      const std::uint32_t from = vertices[i], to = vertices[i + 1];
      pieces.push_back(from < to ? FacetPiece{from, to, plane, incidence.facet, incidence.side}
                                 : FacetPiece{to, from, plane, incidence.facet, opposite(incidence.side)});
    }
  }
  bucket_sort(
      pieces, skeleton.vertices().size(), [](const FacetPiece& p) { return p.u; }, std::ranges::less());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

void add_step(Piece& piece, const Cover& cover, const Skeleton& skeleton) {
  const Facet& facet = skeleton.facets()[cover.facet];
  const std::uint32_t group = skeleton.operands().group(facet.operand);
  if (cover.is_on(Side::left)) piece.steps[0][group] += facet.orientation;
  if (cover.is_on(Side::right)) piece.steps[1][group] += facet.orientation;
}

}  // namespace

CutSegments::CutSegments(Skeleton& skeleton) {
  auto& cuts = skeleton.cuts();
  std::ranges::sort(cuts);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const VertexPool& points = skeleton.vertices();
  auto cut = cuts.begin();
  for (std::uint32_t s = 0; s < skeleton.segments().size(); ++s) {
    first_.push_back(static_cast<std::uint32_t>(vertices_.size()));
    const Segment& segment = skeleton.segments()[s];
    vertices_.push_back(segment.from);
    for (; cut != cuts.end() && cut->first == s; ++cut)
      if (cut->second != segment.from && cut->second != segment.to) vertices_.push_back(cut->second);
    vertices_.push_back(segment.to);
    const auto begin = vertices_.begin() + first_.back();
    if (vertices_.end() - begin == 2) continue;
    // On a line, the lexicographic order is that along it.
    std::sort(begin, vertices_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::is_lt(compare(points[a], points[b])); });
    if (*begin != segment.from) std::reverse(begin, vertices_.end());
  }
  first_.push_back(static_cast<std::uint32_t>(vertices_.size()));
}

Pieces divide(Skeleton& skeleton) {
  Pieces result;
  result.segments = CutSegments(skeleton);
  const std::vector<FacetPiece> pieces = facet_pieces(skeleton, result.segments);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const FacetPiece& piece = pieces[i];
    if (i == 0 || pieces[i - 1].place() != piece.place()) {
      const auto first = static_cast<std::uint32_t>(result.covers.size());
      result.pieces.push_back({piece.u, piece.v, piece.plane, first, first, {}});
    }
    // Sides are sorted with `both` first: a facet that is cut along its own boundary is on the side of that.
    const bool has_boundary =
        i + 1 < pieces.size() && pieces[i + 1].place() == piece.place() && pieces[i + 1].facet == piece.facet;
    if (piece.side == Side::both && has_boundary) continue;
    result.covers.push_back({piece.facet, piece.side});
    ++result.pieces.back().last_cover;
  }
  return result;
}

void count_steps(const Skeleton& skeleton, Pieces& pieces) {
  for (Piece& piece : pieces.pieces)
    for (const Cover& cover : pieces.covers_of(piece)) add_step(piece, cover, skeleton);
}

}  // namespace algebra3d::arrangement
