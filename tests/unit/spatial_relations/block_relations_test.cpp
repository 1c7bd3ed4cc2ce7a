// Questions answered by blocks of faces: beside the same questions to the sets in memory, with a count of the faces
// that were read.
#include "algebra3d/values/spatial_relations/block_relations.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/solids.h"

namespace algebra3d {
namespace {

/// The blocks of a geometry, encoded, in memory.
class KeptBlocks final : public FaceBlocks {
 public:
  static std::unique_ptr<KeptBlocks> of(const Geometry& geometry, std::size_t faces_of_block) {
    std::string list;
    std::vector<std::string> blocks;
    const Status encoded = encode_face_blocks(
        geometry,
        [&](std::string_view bytes) {
          list = bytes;
          return Status();
        },
        [&](std::size_t block, std::string_view bytes) {
          EXPECT_EQ(block, blocks.size());
          blocks.emplace_back(bytes);
          return Status();
        },
        faces_of_block);
    EXPECT_TRUE(encoded.ok());
    if (list.empty()) return nullptr;
    auto decoded = decode_face_block_list(list, geometry.box, static_cast<std::uint32_t>(geometry.mesh.face_count()));
    EXPECT_TRUE(decoded.ok()) << (decoded ? "" : decoded.error().text());
    return std::unique_ptr<KeptBlocks>(new KeptBlocks(*std::move(decoded), std::move(blocks)));
  }

  mutable std::size_t faces_read = 0;

 protected:
  Result<TriangleMesh> faces_of(std::uint32_t block) const override {
    faces_read += list().blocks[block].face_count;
    return decode_face_block(blocks_[block], list().blocks[block]);
  }

 private:
  KeptBlocks(FaceBlockList list, std::vector<std::string> blocks)
      : FaceBlocks(std::move(list)), blocks_(std::move(blocks)) {}

  std::vector<std::string> blocks_;
};

/// A solid in memory and in blocks.
struct Both {
  explicit Both(TriangleMesh mesh, std::size_t faces_of_block = kFacesOfBlock)
      : solid(Volume3d::trusted(std::move(mesh))), blocks(KeptBlocks::of(solid.geometry(), faces_of_block)) {}

  BlockedSet in_blocks() const { return {*blocks, true}; }
  BlockedSet in_memory() const { return {SpatialSet(solid), solid.box()}; }

  Volume3d solid;
  std::unique_ptr<KeptBlocks> blocks;
};

template <typename T>
std::string text(const Result<std::optional<T>>& result) {
  if (!result) return result.error().text();
  if (!*result) return "not decided";
  if constexpr (std::is_same_v<T, bool>)
    return **result ? "yes" : "no";
  else
    return (*result)->text();
}

/// Asks all questions about two solids, one or both of them in blocks. How many were decided.
std::size_t compare_all(const Both& a, const Both& b, double limit) {
  const bool meet = *do_meet(a.solid, b.solid);
  const Rational square = **squared_distance_of(a.solid, b.solid);
  const bool within = *are_within(a.solid, b.solid, Rational(limit));
  std::size_t decided = 0;
  const auto check = [&](const BlockedSet& first, const BlockedSet& second) {
    const auto meet_by_blocks = do_meet_by_blocks(first, second);
    const auto square_by_blocks = squared_distance_by_blocks(first, second);
    const auto within_by_blocks = are_within_by_blocks(first, second, limit);
    if (const std::string found = text(meet_by_blocks); found != "not decided") {
      EXPECT_EQ(found, meet ? "yes" : "no");
      ++decided;
    }
    if (const std::string found = text(square_by_blocks); found != "not decided") {
      EXPECT_EQ(found, square.text());
      ++decided;
    }
    if (const std::string found = text(within_by_blocks); found != "not decided") {
      EXPECT_EQ(found, within ? "yes" : "no");
      ++decided;
    }
  };
  check(a.in_blocks(), b.in_blocks());
  check(a.in_blocks(), b.in_memory());
  check(a.in_memory(), b.in_blocks());
  return decided;
}

TriangleMesh ball(int parts, double radius, const Vec3& middle) {
  std::vector<Vec3> points;
  const TriangleMesh unit = solids::geodesic_sphere(parts);
  for (const Vec3& p : unit.points().approx()) points.push_back(middle + radius * p);
  return {PointArray(std::move(points)), solids::triangles_of(unit)};
}

TEST(block_relations, balls_at_all_places_are_as_in_memory) {
  const Both large(ball(40, 4, {0, 0, 0}));  // 12,800 faces
  std::size_t decided = 0;
  for (const double x : {0.0, 1.0, 2.9, 3.0, 3.5, 4.5, 5.0, 5.5, 8.0})
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0.48, 0.6, 0.64}, Vec3{0, 0, -1}}) {
      const Both small(ball(24, 1, x * direction));
      decided += compare_all(large, small, 0.25);
      decided += compare_all(small, large, 0);
    }
  EXPECT_GT(decided, 200U) << "of 486: for the others more than a quarter of the few faces would be read";
}

TEST(block_relations, random_solids_are_as_in_memory) {
  std::size_t decided = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    solids::SetOperations engine;
    solids::RandomSolids random(seed, engine);
    const TriangleMesh first = random.operand(), second = random.operand();
    if (first.face_count() == 0 || second.face_count() == 0) continue;
    const Both a(first, 1), b(second, 1);
    if (a.blocks == nullptr || b.blocks == nullptr) continue;
    decided += compare_all(a, b, (a.solid.box().max.x - a.solid.box().min.x) / 16);
  }
  EXPECT_GT(decided, 40U);
}

TEST(block_relations, points_and_boxes_are_where_they_are_in_memory) {
  const Both large(ball(40, 4, {1, 2, 3}));
  solids::Chance chance(3);
  for (int i = 0; i < 60; ++i) {
    const double x = 6 * chance.unit(), y = 6 * chance.unit(), z = 6 * chance.unit();
    const ExactPoint point(Vec3{1 + x, 2 + y, 3 + z});
    const SpatialSet as_set = PointSet{{&point, 1}};
    const BlockedSet operand(as_set, box_of(point));
    EXPECT_EQ(text(do_meet_by_blocks(operand, large.in_blocks())), *do_meet(as_set, large.solid) ? "yes" : "no");
    EXPECT_EQ(text(squared_distance_by_blocks(large.in_blocks(), operand)),
              (*squared_distance_of(as_set, large.solid))->text());
    const Box3 box{{1 + x, 2 + y, 3 + z}, {1.5 + x, 2.5 + y, 3.25 + z}};
    const auto meets = do_meet_by_blocks(BlockedSet(SpatialSet(box), box), large.in_blocks());
    ASSERT_TRUE(meets.ok());
    if (meets->has_value()) {
      EXPECT_EQ(**meets, *do_meet(SpatialSet(box), large.solid));
    }
  }
}

TEST(block_relations, few_faces_are_read) {
  const Both a(ball(80, 4, {0, 0, 0})), b(ball(80, 4, {5, 5, 5}));  // 51,200 faces each
  EXPECT_EQ(text(do_meet_by_blocks(a.in_blocks(), b.in_blocks())), "no");
  EXPECT_LT(a.blocks->faces_read + b.blocks->faces_read, 16 * kFacesOfBlock);
  const Both inner(ball(80, 1, {0.2, 0.1, 0.3}));
  a.blocks->faces_read = b.blocks->faces_read = 0;
  EXPECT_EQ(text(do_meet_by_blocks(a.in_blocks(), inner.in_blocks())), "yes");
  EXPECT_LT(a.blocks->faces_read, 8 * kFacesOfBlock) << "those above the seed of the other";
  EXPECT_EQ(inner.blocks->faces_read, 0U);
  a.blocks->faces_read = b.blocks->faces_read = 0;
  EXPECT_EQ(text(squared_distance_by_blocks(a.in_blocks(), b.in_blocks())),
            (*squared_distance_of(a.solid, b.solid))->text());
  EXPECT_LT(a.blocks->faces_read + b.blocks->faces_read, 24'000U);
  const Both crossing(ball(80, 4, {0.3, 0.2, 7.5}));
  a.blocks->faces_read = 0;
  EXPECT_EQ(text(do_meet_by_blocks(a.in_blocks(), crossing.in_blocks())), "yes");
  EXPECT_LT(a.blocks->faces_read, 20'000U);
}

TEST(block_relations, sets_with_many_near_blocks_are_left_undecided) {
  const Both a(ball(40, 4, {0, 0, 0})), b(ball(40, 3.999, {0, 0, 0}));
  EXPECT_EQ(text(do_meet_by_blocks(a.in_blocks(), b.in_blocks())), "not decided");
  EXPECT_EQ(text(are_within_by_blocks(a.in_blocks(), b.in_blocks(), 100)), "not decided");
}

TEST(block_relations, a_solid_with_many_components_has_no_blocks) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  const TriangleMesh cube = solids::cube(0, 1);
  for (std::uint32_t i = 0; i <= kMostSeeds; ++i) {
    for (const Vec3& p : cube.points().approx()) points.push_back(p + Vec3{2.0 * i, 0, 0});
    for (const auto& [a, b, c] : solids::triangles_of(cube)) triangles.push_back({8 * i + a, 8 * i + b, 8 * i + c});
  }
  EXPECT_EQ(Both({PointArray(std::move(points)), triangles}).blocks, nullptr);
}

// ---- the bytes

struct Encoded {
  std::string list;
  std::vector<std::string> blocks;
};

Encoded encoded(const Geometry& geometry) {
  Encoded result;
  EXPECT_TRUE(encode_face_blocks(
                  geometry, [&](std::string_view bytes) { return result.list = bytes, Status(); },
                  [&](std::size_t, std::string_view bytes) { return result.blocks.emplace_back(bytes), Status(); })
                  .ok());
  return result;
}

TEST(face_blocks, have_all_faces_once) {
  const Volume3d solid = Volume3d::trusted(ball(20, 1, {0, 0, 0}));
  const auto blocks = KeptBlocks::of(solid.geometry(), kFacesOfBlock);
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < blocks->list().blocks.size(); ++i) all.push_back(i);
  const TriangleMesh faces = *blocks->faces(all);
  EXPECT_EQ(faces.face_count(), solid.mesh().face_count());
  const auto corners_of = [](const TriangleMesh& mesh) {
    std::vector<std::array<Vec3, 3>> corners;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const TriangleRef triangle = mesh.corners(FaceId(f));
      corners.push_back({triangle[0].approx, triangle[1].approx, triangle[2].approx});
    }
    std::ranges::sort(corners);
    return corners;
  };
  EXPECT_EQ(corners_of(faces), corners_of(solid.mesh()));
}

TEST(face_blocks, of_other_values_and_damaged_ones_are_errors) {
  const Volume3d solid = Volume3d::trusted(ball(20, 1, {0, 0, 0}));
  const auto count = static_cast<std::uint32_t>(solid.mesh().face_count());
  const Encoded bytes = encoded(solid.geometry());
  const auto error_of_list = [&](const std::string& list, const Box3& box, std::uint32_t faces) {
    const auto decoded = decode_face_block_list(list, box, faces);
    return decoded ? std::string("decoded") : decoded.error().text();
  };
  EXPECT_EQ(error_of_list(bytes.list, solid.box(), count), "decoded");
  EXPECT_EQ(error_of_list(bytes.list, solid.box(), count + 1),
            fmt::format("face blocks: expected {} faces in all, found {}", count + 1, count));
  EXPECT_EQ(error_of_list(bytes.list, {solid.box().min, {2, 2, 2}}, count),
            "face blocks: expected the bounding box of the value");
  std::string other_version = bytes.list;
  other_version[0] = 2;
  EXPECT_EQ(error_of_list(other_version, solid.box(), count), "face blocks: expected version 1, found 2");
  for (std::size_t length = 0; length < bytes.list.size(); length += 7)
    EXPECT_NE(error_of_list(bytes.list.substr(0, length), solid.box(), count), "decoded") << length;
  const FaceBlockList list = *decode_face_block_list(bytes.list, solid.box(), count);
  EXPECT_TRUE(decode_face_block(bytes.blocks[0], list.blocks[0]).ok());
  EXPECT_EQ(decode_face_block(bytes.blocks[1], list.blocks[0]).error().text(),
            "face blocks: expected a block of the faces that the list says");
  for (std::size_t place = 0; place < bytes.blocks[0].size(); place += 11) {
    std::string damaged = bytes.blocks[0];
    damaged[place] = static_cast<char>(damaged[place] ^ 4);
    EXPECT_FALSE(decode_face_block(damaged, list.blocks[0]).ok()) << place;
  }
}

}  // namespace
}  // namespace algebra3d
