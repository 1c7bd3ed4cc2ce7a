#include "queries/store/detail/index_cache.h"

#include <cstdint>

namespace queries {

std::shared_ptr<IndexCache::Tree> IndexCache::find(std::int64_t table_number, std::size_t attribute) const {
  const auto found = trees_.find({table_number, attribute});
  return found == trees_.end() ? nullptr : found->second;
}

void IndexCache::add(std::int64_t table_number, std::size_t attribute, std::shared_ptr<Tree> tree) {
  trees_.insert_or_assign({table_number, attribute}, std::move(tree));
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

std::shared_ptr<OrderedTree> IndexCache::find_ordered(std::int64_t table_number, std::size_t attribute) const {
  const auto found = ordered_.find({table_number, attribute});
  return found == ordered_.end() ? nullptr : found->second;
}

void IndexCache::add_ordered(std::int64_t table_number, std::size_t attribute, std::shared_ptr<OrderedTree> tree) {
  ordered_.insert_or_assign({table_number, attribute}, std::move(tree));
}

std::vector<std::size_t> IndexCache::ordered_attributes(std::int64_t table_number) const {
  std::vector<std::size_t> result;
  for (auto entry = ordered_.lower_bound({table_number, 0});
       entry != ordered_.end() && entry->first.first == table_number; ++entry)
    result.push_back(entry->first.second);
  return result;
}

OrderedTree& IndexCache::own(std::int64_t table_number, std::size_t attribute) {
  auto& tree = ordered_.at({table_number, attribute});
  if (tree.use_count() > 1) tree = std::make_shared<OrderedTree>(*tree);
  return *tree;
}

void IndexCache::insert_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple) {
  own(table_number, attribute).insert(key, tuple);
}

void IndexCache::erase_key(std::int64_t table_number, std::size_t attribute, const Value& key, TupleId tuple) {
  own(table_number, attribute).erase(key, tuple);
}

void IndexCache::drop_table(std::int64_t table_number) {
  const Key first{table_number, 0};
  const Key last{table_number, SIZE_MAX};
  trees_.erase(trees_.lower_bound(first), trees_.upper_bound(last));
  ordered_.erase(ordered_.lower_bound(first), ordered_.upper_bound(last));
}

void IndexCache::clear() {
  trees_.clear();
  ordered_.clear();
}

}  // namespace queries
