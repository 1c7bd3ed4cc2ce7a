#include "queries/store/frozen_index.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "algebra3d/types/binary_io.h"
#include "queries/store/cell.h"

namespace queries {
namespace {

using Entry = rtree::Entry<std::uint64_t>;

constexpr std::string_view kMagic =
    "\x89"
    "A3I";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 24;
constexpr std::size_t kEntryBytes = 56;

std::vector<Entry> entries_of(const SpatialIndex::Tree& tree) {
  const auto& storage = tree.storage();
  std::vector<Entry> entries;
  entries.reserve(tree.size());
  std::vector<rtree::NodeIndex> stack;
  if (storage.root != rtree::kNoNode) stack.push_back(storage.root);
  while (!stack.empty()) {
    const rtree::NodeIndex node = stack.back();
    stack.pop_back();
    for (std::size_t slot = 0; slot < storage.infos[node].count; ++slot) {
      if (storage.infos[node].level == 0)
        entries.push_back(storage.nodes[node].entry(slot));
      else
        stack.push_back(storage.nodes[node].child(slot));
    }
  }
  // The order of a tree depends on how it grew.
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::tie(a.payload, a.box.min, a.box.max) < std::tie(b.payload, b.box.min, b.box.max);
  });
  return entries;
}

Error corrupt(std::string_view expectation) {
  return {ErrorCode::database_corrupt, "stored index: expected {}", expectation};
}

}  // namespace

std::string encode_tree(const SpatialIndex::Tree& tree) {
  const auto entries = entries_of(tree);
  std::string body;
  body.reserve(entries.size() * kEntryBytes);
  algebra3d::ByteWriter writer(body);
  for (const Entry& entry : entries) {
    for (std::size_t axis = 0; axis < 3; ++axis) writer.f64(entry.box.min[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) writer.f64(entry.box.max[axis]);
    writer.u64(entry.payload);
  }
  std::string bytes;
  bytes.reserve(kHeaderBytes + body.size());
  algebra3d::ByteWriter header(bytes);
  header.raw(kMagic);
  header.u32(kVersion);
  header.u64(entries.size());
  header.u64(checksum_of(body));
  header.raw(body);
  return bytes;
}

Result<std::shared_ptr<SpatialIndex::Tree>> decode_tree(std::string_view bytes) {
  algebra3d::ByteReader reader(bytes, "stored index");
  if (bytes.size() < kHeaderBytes || reader.raw(kMagic.size()) != kMagic) return corrupt("the bytes 89 41 33 49");
  if (const std::uint32_t version = reader.u32(); version != kVersion)
    return Error{version > kVersion ? ErrorCode::database_version : ErrorCode::database_corrupt,
                 "stored index: format version {}, this program reads version {}", version, kVersion};
  const std::uint64_t count = reader.u64();
  const std::uint64_t checksum = reader.u64();
  const std::string_view body = bytes.substr(kHeaderBytes);
  if (body.size() % kEntryBytes != 0 || body.size() / kEntryBytes != count || checksum_of(body) != checksum)
    return corrupt("the checksum of these bytes; they were changed");
  std::vector<Entry> entries(static_cast<std::size_t>(count));
  for (Entry& entry : entries) {
    for (std::size_t axis = 0; axis < 3; ++axis) entry.box.min[axis] = reader.f64();
    for (std::size_t axis = 0; axis < 3; ++axis) entry.box.max[axis] = reader.f64();
    entry.payload = reader.u64();
    if (entry.box.is_empty()) return corrupt("boxes that are not empty");
  }
  return std::make_shared<SpatialIndex::Tree>(SpatialIndex::Tree::bulk_load(entries));
}

}  // namespace queries
