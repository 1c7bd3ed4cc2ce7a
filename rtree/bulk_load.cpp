#include <cassert>

#include "rtree/detail/packing.h"

namespace rtree {
namespace {

bool is_ordered(const Vec3& a, const Vec3& b) {
  return a < b;
}

template <typename Payload>
bool comes_before(const Entry<Payload>& a, const Entry<Payload>& b) {
  if (a.payload != b.payload) return a.payload < b.payload;
  return is_ordered(a.box.min, b.box.min) || (a.box.min == b.box.min && is_ordered(a.box.max, b.box.max));
}

template <typename Payload>
struct EntrySource {
  const Entry<Payload>* entries;

  const Box3& box(std::size_t i) const { return entries[i].box; }
  Payload payload(std::size_t i) const { return entries[i].payload; }
};

struct BoxSource {
  const Box3* boxes;

  const Box3& box(std::size_t i) const { return boxes[i]; }
  std::uint32_t payload(std::size_t i) const { return static_cast<std::uint32_t>(i); }
};

}  // namespace

// Ties are broken by the place in the input; ordered by payload, the input gives the same tree in whatever order it
// came.
template <typename Payload>
void bulk_load(Storage<ExactLeaf<Payload>>& storage, std::span<const Entry<Payload>> entries, std::size_t fill) {
  assert(storage.empty());
  if (std::is_sorted(entries.begin(), entries.end(), comes_before<Payload>)) {
    Packing(storage, EntrySource<Payload>{entries.data()}, fill).load(entries.size());
    return;
  }
  std::vector<Entry<Payload>> ordered(entries.begin(), entries.end());
  std::sort(ordered.begin(), ordered.end(), comes_before<Payload>);
  Packing(storage, EntrySource<Payload>{ordered.data()}, fill).load(ordered.size());
}

void bulk_load(Storage<IndexLeaf>& storage, std::span<const Box3> boxes) {
  assert(storage.empty());
  Packing(storage, BoxSource{boxes.data()}, kFanOut).load(boxes.size());
}

template void bulk_load(Storage<ExactLeaf<std::uint32_t>>&, std::span<const Entry<std::uint32_t>>, std::size_t);
template void bulk_load(Storage<ExactLeaf<std::uint64_t>>&, std::span<const Entry<std::uint64_t>>, std::size_t);

}  // namespace rtree
