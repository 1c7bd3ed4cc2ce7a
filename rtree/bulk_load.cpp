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
void bulk_load(Storage<ExactLeaf<Payload>>& storage, const Entry<Payload>* entries, std::size_t count) {
  assert(storage.empty());
  if (std::is_sorted(entries, entries + count, comes_before<Payload>)) {
    Packing(storage, EntrySource<Payload>{entries}).load(count);
    return;
  }
  std::vector<Entry<Payload>> ordered(entries, entries + count);
  std::sort(ordered.begin(), ordered.end(), comes_before<Payload>);
  Packing(storage, EntrySource<Payload>{ordered.data()}).load(count);
}

void bulk_load(Storage<IndexLeaf>& storage, const Box3* boxes, std::size_t count) {
  assert(storage.empty());
  Packing(storage, BoxSource{boxes}).load(count);
}

template void bulk_load(Storage<ExactLeaf<std::uint32_t>>&, const Entry<std::uint32_t>*, std::size_t);
template void bulk_load(Storage<ExactLeaf<std::uint64_t>>&, const Entry<std::uint64_t>*, std::size_t);

}  // namespace rtree
