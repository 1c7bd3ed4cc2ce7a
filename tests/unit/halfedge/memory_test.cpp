#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <new>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/scheduler.h"
#include "mesh_samples.h"

// Counts the bytes that are asked for on the heap and not given back, while it is switched on. All replaceable forms
// are replaced, so that each allocation meets its own kind of release.
namespace {

struct Allocation {
  void* address = nullptr;
  std::size_t size = 0;
};

bool counting = false;
std::array<Allocation, 4096> allocations;

void* allocate(std::size_t size) noexcept {
  void* address = std::malloc(size != 0 ? size : 1);  // NOLINT(cppcoreguidelines-no-malloc)
  if (counting && address != nullptr)
    for (Allocation& free : allocations)
      if (free.address == nullptr) {
        free = {address, size};
        return address;
      }
  return address;
}

void release(void* address) noexcept {
  if (counting && address != nullptr)
    for (Allocation& held : allocations)
      if (held.address == address) held = {};
  std::free(address);  // NOLINT(cppcoreguidelines-no-malloc)
}

std::size_t counted_bytes() {
  std::size_t sum = 0;
  for (const Allocation& held : allocations) sum += held.size;
  return sum;
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* address = allocate(size)) return address;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  return operator new(size);
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size);
}
void operator delete(void* address) noexcept {
  release(address);
}
void operator delete[](void* address) noexcept {
  release(address);
}
void operator delete(void* address, std::size_t /*size*/) noexcept {
  release(address);
}
void operator delete[](void* address, std::size_t /*size*/) noexcept {
  release(address);
}
void operator delete(void* address, const std::nothrow_t& /*tag*/) noexcept {
  release(address);
}
void operator delete[](void* address, const std::nothrow_t& /*tag*/) noexcept {
  release(address);
}

namespace algebra3d {
namespace {

/// With one thread, which counts; the first mesh is not counted, since the scheduler keeps what it needs for tasks.
std::size_t bytes_on_heap(PointArray points, const samples::Triangles& triangles) {
  std::size_t bytes = 0;
  with_threads(1, [&] {
    { const TriangleMesh first(PointArray(points), triangles); }
    allocations = {};
    counting = true;
    // The points come from outside the count: copied here, so that their bytes are counted too.
    const TriangleMesh mesh(PointArray(points), triangles);
    bytes = counted_bytes();
    counting = false;
    EXPECT_EQ(bytes, mesh.heap_bytes());
  });
  return bytes;
}

TEST(TriangleMeshMemory, closed_manifold_takes_24_bytes_per_triangle_and_28_per_vertex) {
  for (const std::uint32_t size : {3U, 10U, 100U, 300U}) {
    const auto triangles = samples::torus(size, size);
    const std::size_t bytes = bytes_on_heap(samples::torus_points(size, size), triangles) + sizeof(TriangleMesh);
    EXPECT_LE(bytes, 24 * triangles.size() + 28 * std::size_t{size} * size + 256);
  }
  const auto triangles = samples::tetrahedron();
  EXPECT_LE(bytes_on_heap(samples::points_for(4), triangles) + sizeof(TriangleMesh), 24U * 4 + 28U * 4 + 256U);
}

TEST(TriangleMeshMemory, spare_capacity_of_the_points_is_not_kept) {
  std::vector<Vec3> points = samples::points_for(4).approx();
  points.reserve(10000);
  const TriangleMesh mesh(PointArray(std::move(points)), samples::tetrahedron());
  EXPECT_LE(mesh.heap_bytes() + sizeof(TriangleMesh), 24U * 4 + 28U * 4 + 256U);
}

}  // namespace
}  // namespace algebra3d
