// Stored triangles: whatever is decoded has the links that the mesh has when it is built from its triangles.
#include "algebra3d/values/types/detail/mesh_codec.h"

#include <gtest/gtest.h>

#include "unit/halfedge/mesh_samples.h"
#include "unit/halfedge/same_mesh.h"

namespace algebra3d {
namespace {

void expect_comes_back(const TriangleMesh& mesh) {
  std::string bytes;
  ByteWriter writer(bytes);
  write_mesh(writer, mesh);
  ByteReader reader(bytes, "mesh");
  const TriangleMesh decoded = read_mesh(reader);
  ASSERT_TRUE(reader.finish().ok());
  EXPECT_TRUE(decoded.points() == mesh.points());
  samples::expect_same_mesh(decoded, mesh);
}

TEST(MeshCodec, meshes_of_all_kinds_come_back_with_their_links) {
  for (const samples::Triangles& triangles : samples::all_kinds()) expect_comes_back(samples::mesh_of(triangles));
}

/// Large enough for two threads; with faces out of order, and with some turned round and some twice.
TEST(MeshCodec, large_meshes_come_back) {
  std::mt19937 random(2);
  samples::Triangles triangles = samples::torus(120, 90);
  expect_comes_back(samples::mesh_of(triangles));
  for (std::size_t i = 0; i < triangles.size(); i += 7)
    std::swap(triangles[i], triangles[std::min(i + random() % 200, triangles.size() - 1)]);
  expect_comes_back(samples::mesh_of(triangles));
  for (std::size_t i = 5; i < triangles.size(); i += 1000) {
    std::swap(triangles[i][0], triangles[i][1]);
    triangles.push_back(triangles[i + 1]);
  }
  expect_comes_back(samples::mesh_of(triangles));
  EXPECT_GT(samples::mesh_of(triangles).nonmanifold_edge_count(), 10U);
}

TEST(PlaneReader, reads_more_than_a_block) {
  std::mt19937 random(6);
  for (const std::size_t count : {1U, 255U, 256U, 257U, 1000U}) {
    std::vector<std::uint64_t> values(count);
    for (std::uint64_t& value : values) value = random() % 0x1000000;
    std::string bytes;
    ByteWriter(bytes).planes(values);
    ByteReader reader(bytes, "test");
    PlaneReader planes = reader.plane_reader(count, 1, 8);
    for (const std::uint64_t value : values) ASSERT_EQ(planes.next(), value);
    EXPECT_TRUE(reader.finish().ok());
  }
}

}  // namespace
}  // namespace algebra3d
