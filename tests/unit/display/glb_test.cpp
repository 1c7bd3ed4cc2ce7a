#include "algebra3d/values/display/glb.h"

#include <array>
#include <map>
#include <set>
#include <vector>

#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <assimp/Importer.hpp>

#include "unit/display/glb_file.h"
#include "unit/display/values.h"

namespace algebra3d {
namespace {

std::string file_of(const std::vector<DrawnShape>& shapes) {
  std::vector<GlbNode> nodes;
  for (const DrawnShape& shape : shapes) nodes.push_back({10 + nodes.size(), &shape});
  Result<std::string> file = glb_of(nodes);
  EXPECT_TRUE(file.ok());
  return std::move(file).value();
}

TEST(Glb, has_a_node_for_each_shape) {
  DrawnShape nothing;
  nothing.kind = "region";
  const GlbFile file(file_of({shape_of_solid(cube_triangles(1, 3)), shape_from<Box3>("(0 1 0 2 0 3)"), nothing}));
  ASSERT_EQ(file.json["nodes"].size(), 3U);
  EXPECT_EQ(file.json["scenes"][0]["nodes"], (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(file.json["nodes"][0]["translation"], (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(
      file.json["nodes"][0]["extras"],
      nlohmann::json::parse(
          R"({"row": 10, "triangles": 12, "shown": 12, "kind": "volume3d", "box": [1.0, 3.0, 1.0, 3.0, 1.0, 3.0]})"));
  EXPECT_EQ(file.json["nodes"][1]["extras"]["box"], (std::vector<double>{0, 1, 0, 2, 0, 3}));
  EXPECT_EQ(file.json["nodes"][2],
            nlohmann::json::parse(R"({"extras": {"row": 12, "triangles": 0, "shown": 0, "kind": "region"}})"));
  EXPECT_EQ(file.json["meshes"].size(), 2U);
}

TEST(Glb, arrays_are_those_of_the_shape) {
  DrawnShape shape = shape_of_solid(cube_triangles(1, 3));
  shape.face_ids.assign(12, 7);
  shape.tree.assign(64, std::byte{42});
  shape.deviation = 0.25;
  const GlbFile file(file_of({shape}));
  const auto faces = file.primitive(0, "faces");
  std::vector<float> positions;
  for (const auto& position : shape.positions) positions.insert(positions.end(), position.begin(), position.end());
  EXPECT_EQ(file.numbers<float>(faces["attributes"]["POSITION"]), positions);
  std::vector<int> normals;
  for (const auto& normal : shape.normals) normals.insert(normals.end(), normal.begin(), normal.begin() + 3);
  EXPECT_EQ(file.numbers<int>(faces["attributes"]["NORMAL"]), normals);
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : shape.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  EXPECT_EQ(file.numbers<std::uint32_t>(faces["indices"]), corners);
  EXPECT_EQ(file.numbers<std::uint32_t>(faces["extras"]["faceIds"]), std::vector<std::uint32_t>(12, 7));
  EXPECT_EQ(file.numbers<std::uint32_t>(faces["extras"]["vertexIds"]),
            std::vector<std::uint32_t>(shape.vertex_ids.begin(), shape.vertex_ids.end()));
  EXPECT_EQ(file.view_bytes(faces["extras"]["tree"]), std::string(64, '*'));
  EXPECT_EQ(faces["extras"]["deviation"], 0.25);
  EXPECT_EQ(file.json["accessors"][faces["indices"].get<std::size_t>()]["componentType"], 5123) << "16 bits are enough";
  const auto edges = file.primitive(0, "edges");
  EXPECT_EQ(edges["mode"], 1);
  EXPECT_EQ(edges["attributes"], (nlohmann::json{{"POSITION", faces["attributes"]["POSITION"]}})) << "shared";
  EXPECT_EQ(file.numbers(edges["indices"]).size(), 24U);
  EXPECT_TRUE(file.primitive(0, "boundary").is_null());
}

/// 65,535 would restart a primitive.
TEST(Glb, indices_have_32_bits_from_65536_vertices_on) {
  for (const std::size_t count : {65535U, 65536U}) {
    DrawnShape shape;
    for (std::size_t i = 0; i < count; ++i) {
      shape.positions.push_back({static_cast<float>(i), 0, 0});
      shape.points.push_back(static_cast<std::uint32_t>(i));
    }
    const GlbFile file(file_of({shape}));
    const std::size_t indices = file.primitive(0, "points")["indices"];
    EXPECT_EQ(file.json["accessors"][indices]["componentType"], count == 65535 ? 5123 : 5125);
    EXPECT_EQ(file.numbers(indices).back(), static_cast<double>(count - 1));
  }
}

TEST(Glb, without_shapes_is_a_file_too) {
  EXPECT_FALSE(GlbFile(file_of({})).json.contains("nodes"));
}

/// A reader that is not ours.
TEST(Glb, assimp_reads_it) {
  const std::string file =
      file_of({shape_of_solid(cube_triangles(1, 3)), shape_from<Surface3d>("(((0 0 0) (1 0 0) (0 1 0)))")});
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(file.data(), file.size(), 0, "glb");
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mRootNode->mNumChildren, 2U);
  const aiNode& cube = *scene->mRootNode->mChildren[0];
  EXPECT_EQ(cube.mTransformation.a4, 2);
  // Each primitive is a mesh there: faces and edges.
  std::map<unsigned, const aiMesh*> by_corners;
  for (unsigned i = 0; i < cube.mNumMeshes; ++i) {
    const aiMesh* mesh = scene->mMeshes[cube.mMeshes[i]];
    by_corners[mesh->mFaces[0].mNumIndices] = mesh;
  }
  ASSERT_EQ(by_corners.size(), 2U);
  EXPECT_EQ(by_corners[2]->mNumFaces, 12U);
  const aiMesh& faces = *by_corners[3];
  ASSERT_EQ(faces.mNumFaces, 12U);
  double volume = 0;
  for (unsigned i = 0; i < faces.mNumFaces; ++i) {
    const auto corner = [&](unsigned k) { return faces.mVertices[faces.mFaces[i].mIndices[k]]; };
    volume += static_cast<double>(corner(0) * (corner(1) ^ corner(2))) / 6;
  }
  EXPECT_DOUBLE_EQ(volume, 8) << "2 by 2 by 2, seen counter-clockwise from outside";
}

}  // namespace
}  // namespace algebra3d
