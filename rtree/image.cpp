#include "rtree/image.h"

#include <cstring>

#include "algebra3d/base/scheduler.h"
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
  std::array<std::uint64_t, 4> zeros{};
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

Result<HeaderFields> read_header(Bytes bytes, std::size_t payload_bytes, std::size_t leaves_bytes) {
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
  return fields;
}

// Walks over the inner nodes of an image. What they have is followed only after it was found sound.
class InnerNodes {
 public:
  InnerNodes(const LargeVector<InnerNode>& inner, std::size_t leaf_count)
      : inner_(inner), leaf_count_(leaf_count), reached_inner_(inner.size()), reached_leaves_(leaf_count) {}

  /// Each node is to be named once, by a sound node that is one level above.
  Status check(NodeIndex root, std::uint32_t height) {
    std::vector<Step> steps;
    visit({root, height}, steps);
    while (!steps.empty()) {
      const Step step = steps.back();
      steps.pop_back();
      const InnerNode& node = inner_[step.node];
      if (!node.is_sound(step.level == height ? 2 : kMinFill)) return corrupt("inner node {} is damaged", step.node);
      const std::size_t count = node.count();
      for (std::size_t slot = 0; slot < count; ++slot)
        if (!visit({node.reference[slot], step.level - 1}, steps))
          return corrupt("inner node {} names node {}", step.node, node.reference[slot]);
    }
    return {};
  }

  std::vector<NodeIndex> free_inner() const { return reached_inner_.missing(inner_.size()); }
  std::vector<NodeIndex> free_leaves() const { return reached_leaves_.missing(leaf_count_); }

 private:
  struct Step {
    NodeIndex node;
    std::uint32_t level;
  };

  bool visit(const Step& step, std::vector<Step>& steps) {
    if (step.level == 0) return step.node < leaf_count_ && reached_leaves_.insert(step.node);
    if (step.node >= inner_.size() || !reached_inner_.insert(step.node)) return false;
    steps.push_back(step);
    return true;
  }

  const LargeVector<InnerNode>& inner_;
  std::size_t leaf_count_;
  NodeSet reached_inner_, reached_leaves_;
};

// All but the leaves.
template <typename Payload>
Result<Storage<ExactLeaf<Payload>>> read_inner(const HeaderFields& fields, Bytes inner) {
  Storage<ExactLeaf<Payload>> storage;
  if (inner.size() != fields.inner_count * sizeof(InnerNode))
    return corrupt("{} bytes of {} inner nodes", inner.size(), fields.inner_count);
  storage.inner.resize(fields.inner_count);
  if (!inner.empty()) std::memcpy(storage.inner.data(), inner.data(), inner.size());
  for (std::size_t axis = 0; axis < 3; ++axis)
    storage.frame.axes[axis] = {fields.axes[axis].base, fields.axes[axis].shift};
  storage.root = fields.root;
  storage.height = fields.height;
  storage.entry_count = fields.entry_count;
  if (storage.empty()) return storage;
  InnerNodes nodes(storage.inner, fields.leaf_count);
  ALGEBRA3D_RETURN_IF_ERROR(nodes.check(storage.root, storage.height));
  storage.free_inner = nodes.free_inner();
  storage.free_leaves = nodes.free_leaves();
  return storage;
}

template <typename Payload>
LeafRules rules_of(const Storage<ExactLeaf<Payload>>& storage) {
  LeafRules rules{storage.frame, storage.height == 0 ? 1 : kMinFill, {}};
  for (const NodeIndex leaf : storage.free_leaves) rules.free.insert(leaf);
  return rules;
}

template <typename Payload>
Status copy_leaves(Storage<ExactLeaf<Payload>>& storage, Bytes bytes) {
  const LeafRules rules = rules_of(storage);
  const std::size_t count = bytes.size() / sizeof(ExactLeaf<Payload>);
  storage.leaves.resize(count);
  std::atomic<bool> is_sound = true;
  algebra3d::parallel_for(count, 256, [&](std::size_t i) {
    ExactLeaf<Payload>& leaf = storage.leaves[i];
    std::memcpy(&leaf, bytes.data() + i * sizeof(leaf), sizeof(leaf));
    if (!accept(leaf, rules.free.has(static_cast<NodeIndex>(i)), rules)) is_sound = false;
  });
  return is_sound ? Status() : corrupt("damaged leaves");
}

}  // namespace

template <typename Payload>
ImageParts RTree<Payload>::image() const {
  ImageParts result = without_parts(storage_);
  const auto& leaves = storage_.leaves.all();
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
Result<RTree<Payload>> RTree<Payload>::from_image(Bytes header, Bytes inner, LeafReader leaves) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const HeaderFields fields, read_header(header, sizeof(Payload), leaves.bytes));
  RTree tree;
  ALGEBRA3D_ASSIGN_OR_RETURN(tree.storage_, read_inner<Payload>(fields, inner));
  tree.storage_.leaves = LeafArray<ExactLeaf<Payload>>(fields.leaf_count, std::move(leaves), rules_of(tree.storage_));
  tree.is_stored_ = true;
  return tree;
}

template <typename Payload>
Result<RTree<Payload>> RTree<Payload>::from_image(Bytes header, Bytes inner, Bytes leaves) {
  ALGEBRA3D_ASSIGN_OR_RETURN(const HeaderFields fields, read_header(header, sizeof(Payload), leaves.size()));
  RTree tree;
  ALGEBRA3D_ASSIGN_OR_RETURN(tree.storage_, read_inner<Payload>(fields, inner));
  ALGEBRA3D_RETURN_IF_ERROR(copy_leaves(tree.storage_, leaves));
  tree.is_stored_ = true;
  return tree;
}

template ImageParts RTree<std::uint32_t>::image() const;
template ImageParts RTree<std::uint64_t>::image() const;
template ImageParts RTree<std::uint32_t>::take_changes();
template ImageParts RTree<std::uint64_t>::take_changes();
template Result<RTree<std::uint32_t>> RTree<std::uint32_t>::from_image(Bytes, Bytes, LeafReader);
template Result<RTree<std::uint64_t>> RTree<std::uint64_t>::from_image(Bytes, Bytes, LeafReader);
template Result<RTree<std::uint32_t>> RTree<std::uint32_t>::from_image(Bytes, Bytes, Bytes);
template Result<RTree<std::uint64_t>> RTree<std::uint64_t>::from_image(Bytes, Bytes, Bytes);

}  // namespace rtree
