#include "algebra3d/kernel/validity/detail/triangles.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "base/scheduler.h"

namespace algebra3d {
namespace {

/// Corner opposite to the edge of `h`.
VertexId apex(const TriangleMesh& mesh, HalfedgeId h) {
  return mesh.origin(TriangleMesh::prev(h));
}

constexpr std::size_t kFacesPerCheck = 8192;

/// The faces without an embedded corner, ascending: the others are neither degenerate nor duplicates.
std::vector<FaceId> doubtful_faces(const TriangleMesh& mesh, const EmbeddedStars& stars) {
  return parallel_collect(mesh.face_count(), kFacesPerCheck, [&](std::size_t begin, std::size_t end) {
    std::vector<FaceId> doubtful;
    for (std::size_t f = begin; f < end; ++f)
      if (!stars.is_at_embedded(mesh, FaceId(f))) doubtful.emplace_back(f);
    return doubtful;
  });
}

void check_degenerate(const TriangleMesh& mesh, const ProvedParts& proved, const std::vector<FaceId>& doubtful,
                      SoundFaces& sound, ValidityReport& report) {
  for (const FaceId face : doubtful) {
    if (proved.known.contains(face.index()) || !proved.fields.field(face).is_none()) continue;
    const TriangleRef corners = mesh.corners(face);
    if (!collinear(corners[0], corners[1], corners[2])) continue;
    sound[face.index()] = false;
    report.add({Defect::degenerate_triangle, face, FaceId(), corners[0].approx});
  }
}

/// Triangles with equal corners run along the same three edges. They are looked for along one of these only, that which
/// lies opposite to the corner of the highest index.
class DuplicateSearch {
 public:
  DuplicateSearch(const TriangleMesh& mesh, SoundFaces& sound, ValidityReport& report)
      : mesh_(mesh), sound_(sound), report_(report) {}

  void run(const ProvedParts& proved, const std::vector<FaceId>& doubtful) {
    for (const FaceId face : doubtful) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const HalfedgeId h = TriangleMesh::halfedge(face, corner), other = mesh_.opposite(h);
        if (!other.is_valid() || !(h < other)) continue;
        const FaceId next = TriangleMesh::face(other);
        if (proved.known.contains(face.index()) && proved.known.contains(next.index())) continue;
        if (!proved.fields.are_in_one(face, next)) search({{h, other}});
      }
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

SoundFaces check_triangles(const TriangleMesh& mesh, const ProvedParts& proved, ValidityReport& report) {
  SoundFaces sound(mesh.face_count(), true);
  const std::vector<FaceId> doubtful = doubtful_faces(mesh, proved.stars);
  check_degenerate(mesh, proved, doubtful, sound, report);
  DuplicateSearch(mesh, sound, report).run(proved, doubtful);
  return sound;
}

}  // namespace algebra3d
