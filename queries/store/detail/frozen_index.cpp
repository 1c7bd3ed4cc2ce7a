#include "queries/store/detail/frozen_index.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "algebra3d/values/types/binary_io.h"
#include "base/propagate.h"
#include "queries/store/detail/index_frame.h"

namespace queries {
namespace {

using Entry = rtree::Entry<std::uint64_t>;

constexpr IndexFrame kTreeFrame = {
    "\x89"
    "A3I",
    1};
constexpr std::size_t kEntryBytes = 56;

std::vector<Entry> entries_of(const SpatialIndex::Tree& tree) {
  std::vector<Entry> entries = tree.entries();
  // The order of a tree depends on how it grew.
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::tie(a.payload, a.box.min, a.box.max) < std::tie(b.payload, b.box.min, b.box.max);
  });
  return entries;
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
  return framed(kTreeFrame, entries.size(), body);
}

Result<std::shared_ptr<SpatialIndex::Tree>> decode_tree(std::string_view bytes) {
  A3D_ASSIGN(const FramedEntries framed, unframed(kTreeFrame, bytes));
  if (framed.body.size() % kEntryBytes != 0 || framed.body.size() / kEntryBytes != framed.count) return changed_index();
  algebra3d::ByteReader reader(framed.body, "stored index");
  std::vector<Entry> entries(static_cast<std::size_t>(framed.count));
  for (Entry& entry : entries) {
    for (std::size_t axis = 0; axis < 3; ++axis) entry.box.min[axis] = reader.f64();
    for (std::size_t axis = 0; axis < 3; ++axis) entry.box.max[axis] = reader.f64();
    entry.payload = reader.u64();
    if (entry.box.is_empty()) return corrupt_index("boxes that are not empty");
  }
  return std::make_shared<SpatialIndex::Tree>(SpatialIndex::Tree::bulk_load(entries));
}

}  // namespace queries
