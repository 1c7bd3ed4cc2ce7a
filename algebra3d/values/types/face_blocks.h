#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/kernel/exact/point.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

struct Geometry;

/// The list of the face blocks of a surface or solid: what is known of them before they are read.
struct FaceBlockList {
  struct Block {
    Box3 box;  ///< smallest box of doubles around the faces
    std::uint32_t face_count = 0;
  };
  /// In the order of a box hierarchy over the faces, so that neighbours in the list are near each other.
  std::vector<Block> blocks;
  /// A vertex of each edge-connected component of the faces, in ascending order; equal ones once.
  std::vector<ExactPoint> seeds;
};

/// Faces of a block, at most.
inline constexpr std::size_t kFacesOfBlock = 512;
/// Values with more components have no blocks: their seeds would take as long as they do.
inline constexpr std::size_t kMostSeeds = 64;

/// Calls visit_list once with the bytes of the list, then visit_block with the number and the bytes of each block,
/// until an error, which is returned. Nothing is called for a value with too many components. Errors: interrupted.
/// Cost: linear.
Status encode_face_blocks(const Geometry& geometry, const std::function<Status(std::string_view bytes)>& visit_list,
                          const std::function<Status(std::size_t block, std::string_view bytes)>& visit_block,
                          std::size_t faces_of_block = kFacesOfBlock);
/// Decodes such a list. Safe for any bytes. Errors: database_corrupt, also if box and number of the faces are not those
/// of the header.
Result<FaceBlockList> decode_face_block_list(std::string_view bytes, const Box3& box, std::uint32_t face_count);
/// The faces of a block of a list. Safe for any bytes. Errors: database_corrupt, also if box and number are not those
/// of the list.
Result<TriangleMesh> decode_face_block(std::string_view bytes, const FaceBlockList::Block& block);

/// The faces of a stored surface or solid in blocks, which are read by need: for questions that are decided by few of
/// its faces. May be used by several threads.
class FaceBlocks {
 public:
  explicit FaceBlocks(FaceBlockList list) : list_(std::move(list)) {}
  virtual ~FaceBlocks() = default;
  FaceBlocks(const FaceBlocks&) = delete;
  FaceBlocks& operator=(const FaceBlocks&) = delete;

  const FaceBlockList& list() const { return list_; }
  /// The number of faces of some blocks.
  std::size_t face_count(std::span<const std::uint32_t> blocks) const;
  /// The faces of some blocks as one mesh. A vertex of several blocks occurs once for each, so that their faces are not
  /// linked. Errors: database_corrupt, those of reading.
  Result<TriangleMesh> faces(std::span<const std::uint32_t> blocks) const;

 protected:
  /// The faces of one block, as decode_face_block gives them.
  virtual Result<TriangleMesh> faces_of(std::uint32_t block) const = 0;

 private:
  FaceBlockList list_;
};

}  // namespace algebra3d
