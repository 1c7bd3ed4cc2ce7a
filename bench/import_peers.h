#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/triangle_soup.h"

/// The results of other programs for a mesh file. CGAL is always there; admesh and assimp are if CMake found them
/// (BENCH_WITH_ADMESH, BENCH_WITH_ASSIMP).
namespace bench {

/// A peer's report on its own result; defects that it does not look for count as absent.
struct PeerMesh {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  bool is_closed = false;
  bool crosses_itself = false;
  std::string failure;  ///< empty if there is a mesh
};

/// CGAL: read, weld, orient, mesh; and whether it crosses itself, if asked for.
PeerMesh import_with_cgal(const std::filesystem::path& path, bool with_proof);
/// CGAL: read, repair_polygon_soup, stitch, orient, mesh, triangulate each hole; and whether it crosses itself.
PeerMesh repair_with_cgal(const std::filesystem::path& path);
/// The points that are left of the corners of the triangles when CGAL has merged equal ones.
class CgalSoup {
 public:
  explicit CgalSoup(std::span<const algebra3d::TriangleSoup::Triangle> triangles);
  CgalSoup(const CgalSoup&) = delete;
  CgalSoup& operator=(const CgalSoup&) = delete;
  ~CgalSoup();
  std::size_t merge();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// admesh, all that the command line program does to a file when no option is given. STL only.
PeerMesh repair_with_admesh(const std::filesystem::path& path);
/// assimp: read and JoinIdenticalVertices; facet normals are removed before, which would keep vertices apart.
PeerMesh import_with_assimp(const std::filesystem::path& path);

}  // namespace bench
