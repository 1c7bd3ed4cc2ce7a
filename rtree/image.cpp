#include "rtree/image.h"

#include <cstring>

#include "base/propagate.h"
#include "rtree/rtree.h"

namespace rtree {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;
using Bytes = std::span<const std::byte>;

constexpr std::array<unsigned char, 8> kMagic = {0x89, 'A', '3', 'T', 0x0d, 0x0a, 0x1a, 0x0a};
constexpr std::uint32_t kByteOrder = 0x01020304;

struct HeaderFields {
  std::array<unsigned char, 8> magic = kMagic;
  std::uint32_t version = kImageVersion;
  std::uint32_t byte_order = kByteOrder;
  std::uint32_t payload_bytes = 0;
  std::uint32_t slots = kFanOut;
  std::uint64_t entry_count = 0;
  std::uint32_t inner_count = 0, leaf_count = 0;
  std::uint32_t root = 0, height = 0;
  struct Axis {
    std::int64_t base = 0;
    std::uint32_t shift = 0, zero = 0;
  } axes[3];
  std::uint32_t free_inner = kNoNode, free_leaf = kNoNode;
  std::array<std::uint64_t, 3> zeros{};
};
static_assert(sizeof(HeaderFields) == kHeaderBytes);
static_assert(sizeof(InnerNode) == kInnerBytes);
static_assert(sizeof(ExactLeaf<std::uint32_t>) == leaf_bytes(4));
static_assert(sizeof(ExactLeaf<std::uint64_t>) == leaf_bytes(8));

template <typename Payload>
ImageHeader header_of(const Storage<ExactLeaf<Payload>>& storage) {
  HeaderFields fields;
  fields.payload_bytes = sizeof(Payload);
  fields.entry_count = storage.entry_count;
  fields.inner_count = static_cast<std::uint32_t>(storage.inner.size());
  fields.leaf_count = static_cast<std::uint32_t>(storage.leaves.size());
  fields.root = storage.root;
  fields.height = storage.height;
  fields.free_inner = storage.free_inner;
  fields.free_leaf = storage.free_leaf;
  for (std::size_t axis = 0; axis < 3; ++axis)
    fields.axes[axis] = {storage.frame.axes[axis].base, storage.frame.axes[axis].shift, 0};
  return std::bit_cast<ImageHeader>(fields);
}

template <typename T>
ImagePart part(const T* nodes, const NodeRange& range) {
  return {range.begin * sizeof(T), std::as_bytes(std::span(nodes + range.begin, range.end - range.begin))};
}

template <typename Payload>
ImageParts without_parts(const Storage<ExactLeaf<Payload>>& storage) {
  ImageParts result;
  result.header = header_of(storage);
  result.inner_bytes = storage.inner.size() * sizeof(InnerNode);
  result.leaves_bytes = storage.leaves.size() * sizeof(ExactLeaf<Payload>);
  return result;
}

template <typename... Args>
Error corrupt(fmt::format_string<Args...> format, Args&&... args) {
  return {ErrorCode::database_corrupt, "image of an R-tree: " + fmt::format(format, std::forward<Args>(args)...)};
}

Result<HeaderFields> read_header(Bytes bytes, std::size_t payload_bytes, std::size_t inner_bytes,
                                 std::size_t leaves_bytes) {
  HeaderFields fields;
  if (bytes.size() != kHeaderBytes) return corrupt("the header has {} bytes, not {}", bytes.size(), kHeaderBytes);
  std::memcpy(&fields, bytes.data(), kHeaderBytes);
  if (fields.magic != kMagic) return corrupt("wrong magic bytes");
  if (fields.version != kImageVersion || fields.byte_order != kByteOrder)
    return Error{ErrorCode::database_version,
                 "image of an R-tree: version or byte order are not those of this program"};
  if (fields.payload_bytes != payload_bytes || fields.slots != kFanOut)
    return corrupt("payloads of {} bytes and nodes of {} slots", fields.payload_bytes, fields.slots);
  for (const auto& [base, shift, zero] : fields.axes)
    if (!AxisFrame{base, shift}.is_valid() || zero != 0) return corrupt("keys with base {} and shift {}", base, shift);
  if (fields.height >= kMaxLevels) return corrupt("height {}", fields.height);
  const bool is_empty = fields.entry_count == 0;
  const std::uint32_t top_count = fields.height == 0 ? fields.leaf_count : fields.inner_count;
  if (is_empty ? fields.leaf_count != 0 || fields.inner_count != 0 || fields.height != 0 : fields.root >= top_count)
    return corrupt("root {} at height {} of {} inner nodes and {} leaves", fields.root, fields.height,
                   fields.inner_count, fields.leaf_count);
  if (fields.entry_count > std::uint64_t{kFanOut} * fields.leaf_count)
    return corrupt("{} entries in {} leaves", fields.entry_count, fields.leaf_count);
  if (leaves_bytes != fields.leaf_count * leaf_bytes(payload_bytes))
    return corrupt("{} bytes of {} leaves", leaves_bytes, fields.leaf_count);
  if (inner_bytes != fields.inner_count * kInnerBytes)
    return corrupt("{} bytes of {} inner nodes", inner_bytes, fields.inner_count);
  const auto is_node = [](NodeIndex node, std::uint32_t count) { return node == kNoNode || node < count; };
  if (!is_node(fields.free_inner, fields.inner_count) || !is_node(fields.free_leaf, fields.leaf_count))
    return corrupt("inner node {} and leaf {} are free", fields.free_inner, fields.free_leaf);
  return fields;
}

}  // namespace

template <typename Payload>
ImageParts RTree<Payload>::image() const {
  ImageParts result = without_parts(storage_);
  storage_.unread.need_all();
  const auto& leaves = storage_.leaves;
  if (!storage_.inner.empty()) result.inner.push_back(part(storage_.inner.data(), {0, storage_.inner.size()}));
  if (!leaves.empty()) result.leaves.push_back(part(leaves.data(), {0, leaves.size()}));
  return result;
}

template <typename Payload>
ImageParts RTree<Payload>::take_changes() {
  ImageParts result = is_stored_ ? without_parts(storage_) : image();
  if (is_stored_) {
    for (const NodeRange& range : storage_.changed_inner.ranges())
      result.inner.push_back(part(storage_.inner.data(), range));
    for (const NodeRange& range : storage_.changed_leaves.ranges())
      result.leaves.push_back(part(storage_.leaves.data(), range));
  }
  storage_.changed_inner.clear();
  storage_.changed_leaves.clear();
  is_stored_ = true;
  return result;
}

template <typename Payload>
Result<RTree<Payload>> RTree<Payload>::from_image(Bytes header, NodeReader inner, NodeReader leaves) {
  using Leaf = ExactLeaf<Payload>;
  A3D_ASSIGN(const HeaderFields fields, read_header(header, sizeof(Payload), inner.bytes, leaves.bytes));
  RTree tree;
  tree.is_stored_ = true;
  if (fields.entry_count == 0) return tree;
  Storage<Leaf>& storage = tree.storage_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    storage.frame.axes[axis] = {fields.axes[axis].base, fields.axes[axis].shift};
  storage.root = fields.root;
  storage.height = fields.height;
  storage.entry_count = fields.entry_count;
  storage.free_inner = fields.free_inner;
  storage.free_leaf = fields.free_leaf;
  const typename UnreadNodes<Leaf>::Tree top{storage.frame, storage.root, storage.height};
  storage.unread = UnreadPart<Leaf>(
      std::make_unique<UnreadNodes<Leaf>>(storage.inner, storage.leaves, std::move(inner), std::move(leaves), top));
  return tree;
}

template ImageParts RTree<std::uint32_t>::image() const;
template ImageParts RTree<std::uint64_t>::image() const;
template ImageParts RTree<std::uint32_t>::take_changes();
template ImageParts RTree<std::uint64_t>::take_changes();
template Result<RTree<std::uint32_t>> RTree<std::uint32_t>::from_image(Bytes, NodeReader, NodeReader);
template Result<RTree<std::uint64_t>> RTree<std::uint64_t>::from_image(Bytes, NodeReader, NodeReader);

}  // namespace rtree
