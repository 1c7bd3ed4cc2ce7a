#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

namespace rtree {

// The image of a tree: its whole state as three arrays of bytes that can lie anywhere.
//
// header   kHeaderBytes:
//            0  8  magic: 89 41 33 54 0D 0A 1A 0A ("A3T", then what a transfer of text would change)
//            8  4  version of the image, kImageVersion
//           12  4  the number 0x01020304: shows the byte order
//           16  4  bytes of a payload: 4 or 8
//           20  4  slots of a node, 16
//           24  8  number of entries
//           32  4  number of inner nodes
//           36  4  number of leaves
//           40  4  root: a leaf if the height is 0, else an inner node
//           44  4  height
//           48 48  for x, y, z: base of the keys (8, signed), their shift (4), zero (4)
//           96  4  the first free inner node, or 0xffffffff
//          100  4  the first free leaf, or 0xffffffff
//          104 24  zero
// inner    kInnerBytes for each inner node: least keys of the slots (3 x 16 x 4, signed), greatest keys (the same),
//          children (16 x 4)
// leaves   leaf_bytes for each leaf: least and greatest keys as above, payloads (16 x 4 or 8), remainders of the least
//          and of the greatest coordinates (2 x 3 x 16 x 4)
//
// Numbers are in the byte order of the machine; an image of the other order is refused. Keys and remainders are
// explained in detail/key_frame.h. Unused slots have the least keys INT32_MAX and the greatest keys INT32_MIN, else
// zeros. Nodes that no node names are free: all their slots are unused, and their first child or payload is the next
// free one, or 0xffffffff. An image has no checksum. Version 1 did not link free nodes.

inline constexpr std::uint32_t kImageVersion = 2;
inline constexpr std::size_t kHeaderBytes = 128;
inline constexpr std::size_t kInnerBytes = 448;
inline constexpr std::size_t leaf_bytes(std::size_t payload_bytes) {
  return 768 + 16 * payload_bytes;
}

using ImageHeader = std::array<std::byte, kHeaderBytes>;

/// Consecutive bytes of an array of an image.
struct ImagePart {
  std::size_t begin;  ///< in the array
  std::span<const std::byte> bytes;
};

/// The header, and bytes of the other arrays of an image, in the order of their places. The bytes are those of the
/// tree: valid until it is changed, moved or destroyed.
struct ImageParts {
  ImageHeader header;
  std::vector<ImagePart> inner, leaves;
  std::size_t inner_bytes = 0, leaves_bytes = 0;  ///< of the whole arrays
};

/// How the nodes of an array of an image are read when they are first needed.
struct NodeReader {
  std::size_t bytes = 0;          ///< of the whole array, as it is stored
  std::size_t nodes_at_once = 1;  ///< one call reads a multiple of so many, from a multiple of it on; fewer at the end
  /// Fills `bytes` with the content of the array from `begin` on. Called from any thread, by one at a time. Its
  /// exceptions come out of the call that needed the nodes, which may then be asked for again.
  std::function<void(std::size_t begin, std::span<std::byte> bytes)> read;
};

/// Thrown when nodes that were read from an image are not such as a tree has. After it left `insert` or `erase` the
/// tree may only be destroyed.
class DamagedImage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rtree
