#include "algebra3d/validity/detail/triangles.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

namespace algebra3d {
namespace {

/// Corner opposite to the edge of `h`.
VertexId apex(const TriangleMesh& mesh, HalfedgeId h) {
  return mesh.origin(TriangleMesh::prev(h));
}

void check_degenerate(const TriangleMesh& mesh, const EmbeddedStars& stars, const FaceSet& known, SoundFaces& sound,
                      ValidityReport& report) {
  for (std::size_t i = 0; i < mesh.face_count(); ++i) {
    const FaceId face(i);
    if (known.contains(face.index()) || stars.is_at_embedded(mesh, face)) continue;
    const TriangleRef corners = mesh.corners(face);
    if (!collinear(corners[0], corners[1], corners[2])) continue;
    sound[i] = false;
    report.add({Defect::degenerate_triangle, face, FaceId(), corners[0].approx});
  }
}

/// Triangles with equal corners run along the same three edges. They are looked for along one of these only, that which
/// lies opposite to the corner of the highest index.
class DuplicateSearch {
 public:
  DuplicateSearch(const TriangleMesh& mesh, SoundFaces& sound, ValidityReport& report)
      : mesh_(mesh), sound_(sound), report_(report) {}

  void run(const EmbeddedStars& stars, const FaceSet& known) {
    for (std::size_t i = 0; i < mesh_.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      const HalfedgeId other = mesh_.opposite(h);
      if (!other.is_valid() || !(h < other) || stars.is_embedded(mesh_.origin(h))) continue;
      if (known.contains(TriangleMesh::face(h).index()) && known.contains(TriangleMesh::face(other).index())) continue;
      search({{h, other}});
    }
    for (std::size_t n = 0; n < mesh_.nonmanifold_edge_count(); ++n) {
      const std::span<const HalfedgeId> edge = mesh_.nonmanifold_edge(n);
      search({edge.begin(), edge.end()});
    }
  }

 private:
  void search(std::vector<HalfedgeId> along_edge) {
    std::erase_if(along_edge, [this](HalfedgeId h) {
      return !sound_[TriangleMesh::face(h).index()] || apex(mesh_, h) < std::max(mesh_.origin(h), mesh_.target(h));
    });
    std::ranges::sort(along_edge, {}, [this](HalfedgeId h) { return std::pair(apex(mesh_, h), h); });
    for (std::size_t i = 1, first = 0; i < along_edge.size(); ++i) {
      if (apex(mesh_, along_edge[i]) != apex(mesh_, along_edge[first])) {
        first = i;
        continue;
      }
      const FaceId face = TriangleMesh::face(along_edge[i]);
      sound_[face.index()] = false;
      const Vec3 where = mesh_.point(mesh_.origin(along_edge[i])).approx;
      report_.add({Defect::duplicate_triangle, TriangleMesh::face(along_edge[first]), face, where});
    }
  }

  const TriangleMesh& mesh_;
  SoundFaces& sound_;
  ValidityReport& report_;
};

}  // namespace

SoundFaces check_triangles(const TriangleMesh& mesh, const EmbeddedStars& stars, const FaceSet& known,
                           ValidityReport& report) {
  SoundFaces sound(mesh.face_count(), true);
  check_degenerate(mesh, stars, known, sound, report);
  DuplicateSearch(mesh, sound, report).run(stars, known);
  return sound;
}

}  // namespace algebra3d
