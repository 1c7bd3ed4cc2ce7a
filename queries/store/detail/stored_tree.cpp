#include "queries/store/detail/stored_tree.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>

#include "algebra3d/values/types/binary_io.h"
#include "base/propagate.h"
#include "queries/store/detail/database.h"
#include "queries/store/detail/index_pages.h"
#include "queries/store/detail/relation_scan.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

using Tree = IndexCache::Tree;

constexpr std::size_t kLeafBytes = rtree::leaf_bytes(sizeof(std::uint64_t));

/// Where an array of a tree's image lies in the pages of an index: as many nodes on each as it takes.
struct PagedArray {
  std::uint32_t first_page, last_page;
  std::size_t node_bytes;

  constexpr std::size_t nodes_on_page() const { return kIndexPageBytes / node_bytes; }
  constexpr std::size_t page_bytes() const { return nodes_on_page() * node_bytes; }
  std::uint32_t page_count(std::size_t array_bytes) const {
    return static_cast<std::uint32_t>((array_bytes + page_bytes() - 1) / page_bytes());
  }
};
constexpr std::uint32_t kHeaderPage = 0;
constexpr std::uint32_t kMiddlePage = std::uint32_t{1} << 31;
constexpr PagedArray kInnerPages{kHeaderPage + 1, kMiddlePage, rtree::kInnerBytes};
constexpr PagedArray kLeafPages{kMiddlePage, UINT32_MAX, kLeafBytes};

struct TreeHeader {
  RelationState state;
  std::uint64_t inner_bytes = 0, leaves_bytes = 0;
  std::string image;
};

TreeHeader header_of(const RelationState& state, const rtree::ImageParts& parts) {
  TreeHeader header{state, parts.inner_bytes, parts.leaves_bytes, {}};
  for (const std::byte byte : parts.header) header.image += std::to_integer<char>(byte);
  return header;
}

std::string encode_header(const TreeHeader& header) {
  std::string bytes;
  algebra3d::ByteWriter writer(bytes);
  writer.u64(static_cast<std::uint64_t>(header.state.table_number));
  writer.u64(static_cast<std::uint64_t>(header.state.attribute));
  writer.u64(static_cast<std::uint64_t>(header.state.tuple_count));
  writer.u64(static_cast<std::uint64_t>(header.state.next_tuple));
  writer.u64(header.state.tuple_sum);
  writer.u64(header.inner_bytes);
  writer.u64(header.leaves_bytes);
  writer.raw(header.image);
  return bytes;
}

Result<TreeHeader> decode_header(std::string_view bytes) {
  algebra3d::ByteReader reader(bytes, "stored index");
  TreeHeader header;
  header.state.table_number = static_cast<std::int64_t>(reader.u64());
  header.state.attribute = static_cast<std::int64_t>(reader.u64());
  header.state.tuple_count = static_cast<std::int64_t>(reader.u64());
  header.state.next_tuple = static_cast<std::int64_t>(reader.u64());
  header.state.tuple_sum = reader.u64();
  header.inner_bytes = reader.u64();
  header.leaves_bytes = reader.u64();
  header.image = reader.raw(rtree::kHeaderBytes);
  A3D_TRY(reader.finish());
  const bool is_possible = header.inner_bytes / kInnerPages.node_bytes < kMiddlePage &&
                           header.leaves_bytes / kLeafPages.node_bytes < kMiddlePage;
  if (!is_possible) return Error{ErrorCode::database_corrupt, "stored index: too many nodes"};
  return header;
}

Result<std::optional<TreeHeader>> read_header(SqliteConnection& connection, std::int64_t owner) {
  A3D_ASSIGN(const auto page, read_index_page(connection, {owner, kHeaderPage}));
  if (!page) return std::optional<TreeHeader>();
  A3D_ASSIGN(TreeHeader header, decode_header(*page));
  return std::optional(std::move(header));
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Reads the pages of an array of a tree of `owner`, when its nodes are needed.
rtree::NodeReader reader_of(const std::shared_ptr<Database>& database, std::int64_t owner, const PagedArray& array,
                            std::size_t array_bytes) {
  const auto read = [weak = std::weak_ptr(database), owner, array](std::size_t begin, std::span<std::byte> bytes) {
    const auto own = weak.lock();
    Status status = own != nullptr ? own->check_reading()
                                   : Error{ErrorCode::internal, "a stored index was used after its database"};
    const auto number = static_cast<std::uint32_t>(array.first_page + begin / array.page_bytes());
    if (status) status = read_index_pages(own->connection(), {owner, number}, array.page_bytes(), bytes);
    if (!status) throw TreeReadError(status.error());
  };
  return {array_bytes, array.nodes_on_page(), read};
}

/// Writes the pages of an array that `parts` changes, and erases those behind its end. The rest of a page stays as it
/// is stored.
Status write_array(SqliteConnection& connection, std::int64_t owner, const PagedArray& array, std::size_t array_bytes,
                   const std::vector<rtree::ImagePart>& parts) {
  std::string page;
  std::optional<IndexPage> open;
  const auto close = [&] { return open ? write_index_page(connection, *open, page) : Status(); };
  for (const rtree::ImagePart& part : parts) {
    std::size_t done = 0;
    while (done < part.bytes.size()) {
      const std::size_t at = part.begin + done;
      const auto index = static_cast<std::uint32_t>(at / array.page_bytes());
      const std::size_t begin = std::size_t{index} * array.page_bytes();
      const std::size_t end = std::min(begin + array.page_bytes(), array_bytes);
      const std::size_t count = std::min(part.bytes.size() - done, end - at);
      const IndexPage wanted{owner, array.first_page + index};
      if (!open || open->number != wanted.number) {
        A3D_TRY(close());
        open = wanted;
        page.clear();
        if (count < end - begin) {
          A3D_ASSIGN(auto stored, read_index_page(connection, wanted));
          page = std::move(stored).value_or(std::string());
        }
        page.resize(end - begin);
      }
      std::memcpy(page.data() + (at - begin), part.bytes.data() + done, count);
      done += count;
    }
  }
  A3D_TRY(close());
  return erase_index_pages(connection, {owner, array.first_page + array.page_count(array_bytes)},
                           {owner, array.last_page});
}

}  // namespace

Result<bool> has_tree(SqliteConnection& connection, std::int64_t owner, const RelationState& state) {
  A3D_ASSIGN(const auto header, read_header(connection, owner));
  return header && header->state == state;
}

Result<std::shared_ptr<Tree>> load_tree(const std::shared_ptr<Database>& database, std::int64_t owner) {
  SqliteConnection& connection = database->connection();
  A3D_ASSIGN(const auto stored, read_header(connection, owner));
  if (!stored) return Error{ErrorCode::database_corrupt, "stored index: it is missing"};
  const TreeHeader& header = *stored;
  A3D_ASSIGN(Tree tree,
             Tree::from_image(bytes_of(header.image),
                              reader_of(database, owner, kInnerPages, static_cast<std::size_t>(header.inner_bytes)),
                              reader_of(database, owner, kLeafPages, static_cast<std::size_t>(header.leaves_bytes))));
  return std::make_shared<Tree>(std::move(tree));
}

Status store_tree(SqliteConnection& connection, std::int64_t owner, const RelationState& state, Tree& tree,
                  bool is_new) {
  // A new tree is marked as stored when it is: until then it may be needed as a whole again.
  const rtree::ImageParts parts = is_new ? tree.image() : tree.take_changes();
  if (is_new) A3D_TRY(erase_index_pages(connection, owner));
  A3D_TRY(write_index_page(connection, {owner, kHeaderPage}, encode_header(header_of(state, parts))));
  A3D_TRY(write_array(connection, owner, kInnerPages, parts.inner_bytes, parts.inner));
  A3D_TRY(write_array(connection, owner, kLeafPages, parts.leaves_bytes, parts.leaves));
  if (is_new) tree.take_changes();
  return {};
}

namespace {

/// Writes the state of the relation beside a tree that stays as it is.
Status store_state(SqliteConnection& connection, std::int64_t owner, const RelationState& state) {
  A3D_ASSIGN(auto header, read_header(connection, owner));
  if (!header) return Error{ErrorCode::database_corrupt, "stored index: it is missing"};
  header->state = state;
  return write_index_page(connection, {owner, kHeaderPage}, encode_header(*header));
}

/// Runs `work`, which writes, and undoes it if it fails.
Status within_savepoint(SqliteConnection& connection, const std::function<Status()>& work) {
  A3D_TRY(connection.execute("SAVEPOINT tree"));
  const auto done = reading_tree(work);
  Status status = done ? *done : Status(done.error());
  if (status) status = connection.execute("RELEASE tree");
  if (status || !connection.in_transaction()) return status;
  if (!(connection.execute("ROLLBACK TO tree") && connection.execute("RELEASE tree")))
    static_cast<void>(connection.execute("ROLLBACK"));
  return status;
}

}  // namespace

std::optional<std::int64_t> tree_owner(const Catalogue& catalogue, const RelationLayout& layout,
                                       std::size_t attribute) {
  std::optional<std::int64_t> owner;
  for (const auto& [name, entry] : catalogue.entries())
    if (entry.type.is("rtree3") && entry.index_relation == layout.relation() &&
        entry.index_attribute == layout.attributes()[attribute].name)
      owner = std::min(owner.value_or(entry.id), entry.id);
  return owner;
}

RelationState relation_state(const CatalogueEntry& relation, std::size_t attribute) {
  return {relation.table_number, static_cast<std::int64_t>(attribute), relation.tuple_count, relation.next_tuple,
          relation.tuple_sum};
}

namespace {

/// Finds the stored tree of an attribute if nobody has. Whatever keeps it from being read, it can be made of the rows.
void find_stored(const std::shared_ptr<Database>& database, const RelationLayout& layout, std::size_t attribute) {
  IndexCache& indexes = database->indexes();
  if (indexes.knows(layout.table_number(), attribute)) return;
  const CatalogueEntry* const relation = database->catalogue().find(layout.relation());
  const auto owner = tree_owner(database->catalogue(), layout, attribute);
  IndexCache::Open open;
  if (relation != nullptr && owner && database->catalogue().version() >= kFirstVersionWithIndexPages) {
    const auto found = has_tree(database->connection(), *owner, relation_state(*relation, attribute));
    if (found && *found)
      open = [weak = std::weak_ptr(database), owner = *owner]() -> std::shared_ptr<Tree> {
        const auto own = weak.lock();
        if (own == nullptr) return nullptr;
        auto tree = load_tree(own, owner);
        return tree ? *std::move(tree) : nullptr;
      };
  }
  indexes.add_stored(layout.table_number(), attribute, std::move(open));
}

}  // namespace

Result<std::shared_ptr<Tree>> spatial_tree(const std::shared_ptr<Database>& database,
                                           const std::shared_ptr<const RelationLayout>& layout, std::size_t attribute) {
  find_stored(database, *layout, attribute);
  if (auto tree = database->indexes().find(layout->table_number(), attribute)) return tree;
  return tree_of_rows(database, layout, attribute);
}

Result<std::shared_ptr<Tree>> tree_of_rows(const std::shared_ptr<Database>& database,
                                           const std::shared_ptr<const RelationLayout>& layout, std::size_t attribute) {
  std::vector<rtree::Entry<std::uint64_t>> entries;
  RelationScan scan(database, layout);
  while (true) {
    A3D_ASSIGN(const TuplePtr tuple, scan.next());
    if (tuple == nullptr) break;
    const Value& value = tuple->attributes[attribute];
    if (!value.is_defined()) continue;
    if (const auto box = value.header().box; !box.is_empty())
      entries.push_back({box, static_cast<std::uint64_t>(tuple->id)});
  }
  auto tree = std::make_shared<Tree>(Tree::bulk_load(entries, rtree::Filling::room_for_changes));
  database->indexes().add(layout->table_number(), attribute, tree);
  return tree;
}

void follow_changes(const std::shared_ptr<Database>& database, const std::shared_ptr<const RelationLayout>& layout) {
  if (!database->indexes().begins_to_follow(layout->table_number())) return;
  for (std::size_t attribute = 0; attribute < layout->attributes().size(); ++attribute)
    if (layout->attributes()[attribute].has_box() && tree_owner(database->catalogue(), *layout, attribute))
      find_stored(database, *layout, attribute);
}

// SQLite may answer a failure by rolling back the whole transaction; later changes would be committed at once.
Status store_trees(Database& database) {
  SqliteConnection& connection = database.connection();
  for (const IndexCache::Unstored& each : database.indexes().unstored()) {
    const auto relation = std::ranges::find_if(database.catalogue().entries(), [&](const auto& entry) {
      return entry.second.type.is_relation() && entry.second.table_number == each.place.table_number;
    });
    if (relation == database.catalogue().entries().end()) continue;
    const auto layout = database.layout_of(relation->second);
    const auto owner = layout ? tree_owner(database.catalogue(), **layout, each.place.attribute) : std::nullopt;
    if (!owner) continue;
    const RelationState state = relation_state(relation->second, each.place.attribute);
    Status status = within_savepoint(connection, [&] {
      if (each.tree == nullptr) return store_state(connection, *owner, state);
      return store_tree(connection, *owner, state, *each.tree, each.is_new);
    });
    if (status) {
      database.indexes().set_stored(each.place);
      continue;
    }
    if (!connection.in_transaction()) return status;
    database.indexes().set_unstorable(each.place);
  }
  return {};
}

}  // namespace queries
