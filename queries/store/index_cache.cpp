#include "queries/store/index_cache.h"

#include <cstdint>

namespace queries {

std::shared_ptr<IndexCache::Tree> IndexCache::find(std::int64_t table_number, std::size_t attribute) const {
  const auto found = trees_.find({table_number, attribute});
  return found == trees_.end() ? nullptr : found->second;
}

void IndexCache::add(std::int64_t table_number, std::size_t attribute, std::shared_ptr<Tree> tree) {
  trees_.insert_or_assign({table_number, attribute}, std::move(tree));
}

bool IndexCache::has_trees(std::int64_t table_number) const {
  const auto first = trees_.lower_bound({table_number, 0});
  return first != trees_.end() && first->first.first == table_number;
}

template <typename Change>
void IndexCache::change(std::int64_t table_number, std::span<const algebra3d::Box3> boxes, Change apply) {
  for (auto entry = trees_.lower_bound({table_number, 0}); entry != trees_.end() && entry->first.first == table_number;
       ++entry) {
    const algebra3d::Box3& box = boxes[entry->first.second];
    if (box.is_empty()) continue;
    if (entry->second.use_count() > 1) entry->second = std::make_shared<Tree>(*entry->second);
    apply(*entry->second, box);
  }
}

void IndexCache::insert(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes) {
  change(table_number, boxes,
         [&](Tree& tree, const algebra3d::Box3& box) { tree.insert(box, static_cast<std::uint64_t>(tuple)); });
}

void IndexCache::erase(std::int64_t table_number, std::int64_t tuple, std::span<const algebra3d::Box3> boxes) {
  change(table_number, boxes,
         [&](Tree& tree, const algebra3d::Box3& box) { tree.erase(box, static_cast<std::uint64_t>(tuple)); });
}

void IndexCache::drop_table(std::int64_t table_number) {
  trees_.erase(trees_.lower_bound({table_number, 0}), trees_.upper_bound({table_number, SIZE_MAX}));
}

}  // namespace queries
