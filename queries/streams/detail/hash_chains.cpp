#include "queries/streams/detail/hash_chains.h"

#include <bit>
#include <utility>

namespace queries {

void HashChains::link(std::size_t entry) {
  std::uint32_t& last = buckets_[bucket_of(links_[entry].hash)];
  links_[entry].before = std::exchange(last, static_cast<std::uint32_t>(entry));
}

void HashChains::add(std::size_t hash) {
  links_.push_back({hash, kNone});
  if (links_.size() <= buckets_.size()) return link(links_.size() - 1);
  buckets_.assign(std::bit_ceil(2 * links_.size()), kNone);
  for (std::size_t entry = 0; entry < links_.size(); ++entry) link(entry);
}

void HashChains::clear() {
  links_.clear();
  buckets_.clear();
}

}  // namespace queries
