#include "queries/store/detail/index_cache.h"

#include <cstdint>
#include <utility>

namespace queries {

bool IndexCache::Spatial::ensure_open() {
  if (open != nullptr) tree = std::exchange(open, nullptr)();
  return tree != nullptr;
}

std::shared_ptr<IndexCache::Tree> IndexCache::find(std::int64_t table_number, std::size_t attribute) {
  const auto found = trees_.find({table_number, attribute});
  return found != trees_.end() && found->second.ensure_open() ? found->second.tree : nullptr;
}

void IndexCache::add(std::int64_t table_number, std::size_t attribute, std::shared_ptr<Tree> tree) {
  trees_.insert_or_assign({table_number, attribute},
                          Spatial{.tree = std::move(tree), .is_new = true, .is_changed = true});
}

void IndexCache::add_stored(std::int64_t table_number, std::size_t attribute, Open open) {
  trees_.insert_or_assign({table_number, attribute}, Spatial{.open = std::move(open)});
}

std::vector<IndexCache::Unstored> IndexCache::unstored() const {
  std::vector<Unstored> result;
  for (const auto& [place, entry] : trees_)
    if (entry.is_changed && entry.is_known()) result.push_back({place, entry.tree, entry.is_new});
  return result;
}

void IndexCache::set_stored(const Place& place) {
  Spatial& entry = trees_.at(place);
  entry.is_new = entry.is_changed = false;
}

void IndexCache::set_unstorable(const Place& place) {
  Spatial& entry = trees_.at(place);
  if (entry.tree == nullptr) entry = {};
  entry.is_new = true;
  entry.is_changed = false;
}

template <typename Change>
void IndexCache::change(std::int64_t table_number, std::span<const algebra3d::Box3> boxes, Change apply) {
  for (auto each = trees_.lower_bound({table_number, 0});
       each != trees_.end() && each->first.table_number == table_number; ++each) {
    const algebra3d::Box3& box = boxes[each->first.attribute];
    Spatial& entry = each->second;
    if (!entry.is_known()) continue;
    // Also if the boxes stay: the stored tree names the state of the relation.
    entry.is_changed = true;
    if (box.is_empty() || !entry.ensure_open()) continue;
    // A stored tree that is damaged where the change is made is no longer followed, and so not up to date.
    const auto changed = reading_tree([&] {
      if (entry.tree.use_count() > 1) entry.tree = std::make_shared<Tree>(*entry.tree);
      apply(*entry.tree, box);
      return true;
    });
    if (!changed) entry = {};
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
       entry != ordered_.end() && entry->first.table_number == table_number; ++entry)
    result.push_back(entry->first.attribute);
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
  const Place first{table_number, 0};
  const Place last{table_number, SIZE_MAX};
  trees_.erase(trees_.lower_bound(first), trees_.upper_bound(last));
  followed_.erase(table_number);
  ordered_.erase(ordered_.lower_bound(first), ordered_.upper_bound(last));
}

void IndexCache::clear() {
  trees_.clear();
  followed_.clear();
  ordered_.clear();
}

}  // namespace queries
