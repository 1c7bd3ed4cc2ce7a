// The parts of the store that deal with indexes.

#include <compare>
#include <memory>
#include <utility>
#include <vector>

#include "base/propagate.h"
#include "queries/store/detail/database.h"
#include "queries/store/detail/frozen_index.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/index_pages.h"
#include "queries/store/detail/key_tables.h"
#include "queries/store/detail/relation_scan.h"
#include "queries/store/detail/sqlite_store.h"
#include "queries/store/detail/stored_object.h"
#include "queries/store/detail/stored_tree.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

/// The ordered index of an attribute with a native order (AttributeColumns::has_native_order): an index of SQLite on
/// the relation's table or on a key table. It shows the relation as it is when it is asked, in the statement that made
/// this object.
///
/// SQLite does not notice changed bytes in an index. So each entry that is found, and its neighbours in the index, are
/// compared with the rows that they name, and with each other. Where they are wrong, or cannot be read, the answer
/// comes from a tree in memory that is made of the rows, and the index is made anew after the statement.
class StoredOrder final : public OrderedEntries {
 public:
  StoredOrder(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, std::size_t attribute,
              RelationLayout::OrderOn on)
      : database_(std::move(database)),
        layout_(std::move(layout)),
        attribute_(attribute),
        on_(on),
        statement_(database_->statement()) {}

  Result<std::size_t> size() const override;
  Result<std::vector<TupleId>> range(const std::optional<Value>& low, const std::optional<Value>& high) const override;

 private:
  struct Bounds {
    std::optional<Cell> low, high;
  };
  Result<std::vector<TupleId>> proved_range(const Bounds& bounds) const;
  Status check_before(const Bounds& bounds) const;
  Status check_beginning(const Bounds& bounds) const;
  Result<SqliteStatement> entries(std::string_view condition, std::string_view order) const;
  Error damaged() const;

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::size_t attribute_;
  RelationLayout::OrderOn on_;
  std::uint64_t statement_;
};

/// The ordered index of an attribute in memory: the one that is there, or one made of the rows. It follows the changes
/// of its relation until it is dropped. Cost: that of reading and sorting all rows.
Result<std::shared_ptr<OrderedTree>> order_in_memory(const std::shared_ptr<Database>& database,
                                                     const std::shared_ptr<const RelationLayout>& layout,
                                                     std::size_t attribute);

/// Columns of a row of `StoredOrder::entries`.
constexpr int kKeyInIndex = 0;
constexpr int kTuple = 1;
constexpr int kKeyInRow = 2;

/// The order of two keys of one column, as SQLite and the language have it. Unordered: the kinds differ.
std::partial_ordering order_of(const Cell& a, const Cell& b) {
  if (a.kind != b.kind) return std::partial_ordering::unordered;
  switch (a.kind) {
    case Cell::Kind::integer:
      return a.integer <=> b.integer;
    case Cell::Kind::real:
      return a.real <=> b.real;
    case Cell::Kind::text:
    case Cell::Kind::blob:
      return a.bytes <=> b.bytes;
    case Cell::Kind::null:
      break;
  }
  return std::partial_ordering::equivalent;
}

/// Entries that are looked at on each side of a range.
constexpr int kNeighbours = 2;

/// Whether entries come in strict order.
class Walk {
 public:
  enum class Direction : std::uint8_t { up, down };
  explicit Walk(Direction direction) : direction_(direction) {}

  /// False if the entry does not come behind the last one.
  bool pass(const Cell& key, TupleId id) {
    const auto order = order_of(key_, key);
    const bool is_up = order < 0 || (order == 0 && id_ < id);
    const bool is_down = order > 0 || (order == 0 && id_ > id);
    const bool is_right = is_first_ || (direction_ == Direction::up ? is_up : is_down);
    is_first_ = false;
    key_ = key;
    text_.assign(key.bytes);
    key_.bytes = text_;
    id_ = id;
    return is_right;
  }

 private:
  Direction direction_;
  bool is_first_ = true;
  Cell key_;
  std::string text_;  // the key's, which outlives the row
  TupleId id_ = 0;
};

Error StoredOrder::damaged() const {
  return Error{ErrorCode::database_corrupt, "the index of '{}' does not have the values of the relation",
               layout_->attributes()[attribute_].name}
      .about(layout_->relation());
}

// The key comes from the index, which has it besides the id; the row is found by the id.
Result<SqliteStatement> StoredOrder::entries(std::string_view condition, std::string_view order) const {
  const std::string& column = layout_->order_column(attribute_, on_);
  return database_->connection().use(
      fmt::format("SELECT i.{0}, i.id, r.{0} FROM {1} AS i INDEXED BY {2} LEFT JOIN {1} AS r ON r.id = i.id WHERE {3} "
                  "ORDER BY i.{0}{4}, i.id{4}",
                  column, layout_->order_table(attribute_, on_), layout_->order_name(attribute_),
                  fmt::vformat(condition, fmt::make_format_args(column)), order));
}

Result<std::size_t> StoredOrder::size() const {
  A3D_TRY(database_->check_statement(statement_));
  A3D_ASSIGN(const std::int64_t count, database_->connection().integer(fmt::format(
                                           "SELECT count({}) FROM {}", layout_->order_column(attribute_, on_),
                                           layout_->order_table(attribute_, on_))));
  return static_cast<std::size_t>(count);
}

Result<std::vector<TupleId>> StoredOrder::range(const std::optional<Value>& low,
                                                const std::optional<Value>& high) const {
  A3D_TRY(database_->check_statement(statement_));
  const AttributeForm form = layout_->attributes()[attribute_].form;
  Bounds bounds;
  if (low) bounds.low = native_cell(form, *low);
  if (high) bounds.high = native_cell(form, *high);
  auto found = proved_range(bounds);
  if (found || found.error().code != ErrorCode::database_corrupt) return found;
  A3D_ASSIGN(const auto tree, order_in_memory(database_, layout_, attribute_));
  return tree->range(low, high);
}

// The entries are walked through as they lie: two before the range, those of the range, two behind it. An entry with a
// wrong key leads a search astray only to a place next to it; one from another place stands out from its neighbours.
Result<std::vector<TupleId>> StoredOrder::proved_range(const Bounds& bounds) const {
  A3D_TRY(check_before(bounds));
  A3D_ASSIGN(SqliteStatement found, entries(bounds.low ? "i.{0} >= ?1" : "i.{0} IS NOT NULL", ""));
  if (bounds.low) found.bind(1, *bounds.low);
  std::vector<TupleId> ids;
  Walk walk(Walk::Direction::up);
  for (int behind = 0; behind < kNeighbours;) {
    A3D_ASSIGN(const bool has_row, found.step());
    if (!has_row) break;
    const Cell key = found.column(kKeyInIndex);
    const TupleId id = found.column(kTuple).integer;
    const bool is_right = walk.pass(key, id) && order_of(key, found.column(kKeyInRow)) == 0 &&
                          (!bounds.low || order_of(*bounds.low, key) <= 0);
    if (!is_right) return damaged();
    if (bounds.high && order_of(key, *bounds.high) > 0)
      ++behind;
    else
      ids.push_back(id);
  }
  return ids;
}

Status StoredOrder::check_before(const Bounds& bounds) const {
  int count = 0;
  if (bounds.low) {
    A3D_ASSIGN(SqliteStatement found, entries("i.{0} < ?1", " DESC"));
    found.bind(1, *bounds.low);
    Walk walk(Walk::Direction::down);
    for (; count < kNeighbours; ++count) {
      A3D_ASSIGN(const bool has_row, found.step());
      if (!has_row) break;
      const Cell key = found.column(kKeyInIndex);
      const bool is_right = walk.pass(key, found.column(kTuple).integer) && order_of(key, *bounds.low) < 0 &&
                            order_of(key, found.column(kKeyInRow)) == 0;
      if (!is_right) return damaged();
    }
  }
  return count == 0 ? check_beginning(bounds) : Status();
}

// A key that has become NULL ends the way down, or stands at the end of those that are.
Status StoredOrder::check_beginning(const Bounds& bounds) const {
  if (bounds.low) {
    A3D_ASSIGN(SqliteStatement least, entries("i.{0} IS NOT NULL", ""));
    A3D_ASSIGN(const bool has_row, least.step());
    if (has_row && !(order_of(least.column(kKeyInIndex), *bounds.low) >= 0)) return damaged();
  }
  A3D_ASSIGN(SqliteStatement undefined, entries("i.{0} IS NULL", " DESC"));
  A3D_ASSIGN(const bool has_row, undefined.step());
  return has_row && !undefined.column(kKeyInRow).is_null() ? Status(damaged()) : Status();
}

/// Where the file has SQLite's index of the attribute; none: it has none that has all tuples. Cost: that of reading the
/// names of all tables.
Result<std::optional<RelationLayout::OrderOn>> stored_order(Database& database, const RelationLayout& layout,
                                                            std::size_t attribute) {
  A3D_ASSIGN(const GroupListPtr groups, database.row_groups().list(layout));
  for (const auto on : {RelationLayout::OrderOn::keys, RelationLayout::OrderOn::table}) {
    if (on == RelationLayout::OrderOn::table && !groups->is_empty()) continue;
    A3D_ASSIGN(SqliteStatement statement,
               database.connection().use("SELECT 1 FROM sqlite_schema WHERE type = 'index' AND name = ? AND "
                                         "tbl_name = ? COLLATE NOCASE"));
    const std::string name = layout.order_name(attribute);
    statement.bind(1, std::string_view(name)).bind(2, std::string_view(layout.order_table(attribute, on)));
    A3D_ASSIGN(const bool is_there, statement.step());
    if (is_there) return std::optional(on);
  }
  return std::optional<RelationLayout::OrderOn>();
}

Result<std::shared_ptr<OrderedTree>> order_in_memory(const std::shared_ptr<Database>& database,
                                                     const std::shared_ptr<const RelationLayout>& layout,
                                                     std::size_t attribute) {
  if (auto known = database->indexes().find_ordered(layout->table_number(), attribute)) return known;
  std::vector<OrderedTree::Entry> entries;
  RelationScan scan(database, layout);
  while (true) {
    A3D_ASSIGN(const TuplePtr tuple, scan.next());
    if (tuple == nullptr) break;
    A3D_ASSIGN(Value key, tuple->attributes[attribute].loaded());
    if (key.is_defined()) entries.push_back({std::move(key), tuple->id});
  }
  auto tree = std::make_shared<OrderedTree>(OrderedTree::bulk_load(std::move(entries)));
  database->indexes().add_ordered(layout->table_number(), attribute, tree);
  if (layout->attributes()[attribute].has_native_order()) database->restore_order_later({layout, attribute});
  return tree;
}

/// The ordered index of an attribute: SQLite's if there is one, else one in memory. One that is missing is made after
/// the statement.
Result<std::shared_ptr<const OrderedEntries>> ordered_entries(const std::shared_ptr<Database>& database,
                                                              const std::shared_ptr<const RelationLayout>& layout,
                                                              std::size_t attribute) {
  const bool is_in_memory = database->indexes().find_ordered(layout->table_number(), attribute) != nullptr;
  if (!is_in_memory && layout->attributes()[attribute].has_native_order()) {
    A3D_ASSIGN(const auto on, stored_order(*database, *layout, attribute));
    if (on) return std::shared_ptr<const OrderedEntries>(new StoredOrder(database, layout, attribute, *on));
  }
  A3D_ASSIGN(const auto tree, order_in_memory(database, layout, attribute));
  return std::shared_ptr<const OrderedEntries>(tree);
}

Result<std::string> frozen(const SpatialIndex& index) {
  return index.ask(encode_tree);
}

Result<std::string> frozen(const OrderedIndex& index) {
  return encode_order(index.frozen());
}

}  // namespace

template <typename Index>
Status SqliteStore::assign_index(CatalogueEntry& entry, const Index& index) {
  A3D_TRY(drop_stored_index(entry));
  entry.index_relation.clear();
  entry.index_attribute = index.attribute();
  if (!index.is_definition()) {
    A3D_ASSIGN(const std::string bytes, frozen(index));
    return write_object_bytes(*database_, entry, bytes);
  }
  const CatalogueEntry* const relation = database_->catalogue().find(index.relation());
  if (relation == nullptr || !relation->type.is_relation())
    return Error{ErrorCode::unknown_name, "there is no relation '{}' for the index", index.relation()}.about(
        entry.name);
  entry.index_relation = index.relation();
  entry.has_value = true;
  return make_stored_index(entry, *relation);
}

template Status SqliteStore::assign_index(CatalogueEntry& entry, const SpatialIndex& index);
template Status SqliteStore::assign_index(CatalogueEntry& entry, const OrderedIndex& index);

Status SqliteStore::make_stored_index(const CatalogueEntry& index, const CatalogueEntry& relation) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t attribute = layout->find(index.index_attribute);
  if (index.type.is("rtree3")) {
    A3D_ASSIGN(const IndexPlace place, spatial_place(relation, index.index_attribute));
    A3D_TRY(spatial_tree(database_, place.layout, place.attribute));
    return {};
  }
  if (attribute == layout->attributes().size() || !layout->attributes()[attribute].has_native_order()) return {};
  A3D_ASSIGN(const auto on, stored_order(*database_, *layout, attribute));
  return on ? Status() : make_order(database_, layout, attribute);
}

// Several objects may be the same index. With its relation an ordered index goes at the end of the statement.
Status SqliteStore::drop_stored_index(const CatalogueEntry& index) {
  if (index.index_relation.empty()) return {};
  const CatalogueEntry* const relation = database_->catalogue().find(index.index_relation);
  if (index.type.is("rtree3")) {
    const auto place = relation != nullptr ? spatial_place(*relation, index.index_attribute) : Result<IndexPlace>({});
    if (place && place->layout != nullptr)
      database_->indexes().forget({place->layout->table_number(), place->attribute});
    // Pages that cannot be erased belong to no object, as `check database` says; unless SQLite has undone everything.
    Status status = erase_index_pages(database_->connection(), index.id);
    return database_->connection().in_transaction() ? Status() : status;
  }
  if (!index.type.is("btree") || relation == nullptr || relation->table_number == 0) return {};
  for (const auto& [name, other] : database_->catalogue().entries())
    if (other.id != index.id && other.type.is("btree") && other.index_relation == index.index_relation &&
        other.index_attribute == index.index_attribute)
      return {};
  A3D_ASSIGN(const auto layout, database_->layout_of(*relation));
  const std::size_t attribute = layout->find(index.index_attribute);
  if (attribute == layout->attributes().size()) return {};
  database_->indexes().drop_ordered(layout->table_number(), attribute);
  return drop_order(*database_, *layout, attribute);
}

Status SqliteStore::make_stored_indexes(const CatalogueEntry& relation) {
  for (const auto& [name, index] : database_->catalogue().entries())
    if (index.index_relation == relation.name) A3D_TRY(make_stored_index(index, relation));
  return {};
}

Result<const CatalogueEntry*> SqliteStore::indexed_relation(const CatalogueEntry& index) {
  const CatalogueEntry* const relation = database_->catalogue().find(index.index_relation);
  if (relation != nullptr && relation->type.is_relation()) return relation;
  return Error{ErrorCode::database_corrupt, "the index is on the relation '{}', which is not there",
               index.index_relation}
      .about(index.name);
}

Result<Datum> SqliteStore::read_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_tree(bytes);
    if (!tree) return std::move(tree).error().about(entry.name);
    return Datum{std::make_shared<SpatialIndex>("", entry.index_attribute, *std::move(tree))};
  }
  A3D_ASSIGN(const CatalogueEntry* relation, indexed_relation(entry));
  A3D_ASSIGN(const IndexPlace place, spatial_place(*relation, entry.index_attribute));
  SpatialIndex::Source source;
  source.tree = [database = database_, place] { return spatial_tree(database, place.layout, place.attribute); };
  source.remade_tree = [database = database_, place] { return tree_of_rows(database, place.layout, place.attribute); };
  return Datum{std::make_shared<SpatialIndex>(entry.index_relation, entry.index_attribute, std::move(source))};
}

Result<Datum> SqliteStore::read_ordered_index(const CatalogueEntry& entry) {
  if (entry.index_relation.empty()) {
    const algebra3d::Type* const key_type = ordered_key_type(database_->registry(), entry.type);
    if (key_type == nullptr)
      return Error{ErrorCode::database_corrupt, "the type {} is not known", entry.type.text()}.about(entry.name);
    A3D_ASSIGN(const std::string bytes, read_object_bytes(*database_, entry));
    auto tree = decode_order(*key_type, bytes);
    if (!tree) return std::move(tree).error().about(entry.name);
    return Datum{std::make_shared<OrderedIndex>(entry.index_attribute, *std::move(tree))};
  }
  A3D_ASSIGN(const CatalogueEntry* relation, indexed_relation(entry));
  A3D_ASSIGN(auto entries, ordered_entries_of(*relation, entry.index_attribute));
  return Datum{std::make_shared<OrderedIndex>(entry.index_relation, entry.index_attribute, std::move(entries))};
}

Result<IndexPlace> SqliteStore::spatial_place(const CatalogueEntry& relation, const std::string& attribute) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size() || !layout->attributes()[position].has_box())
    return Error{ErrorCode::database_corrupt, "there is no spatial attribute '{}' for an index", attribute}.about(
        relation.name);
  return IndexPlace{layout, position};
}

Result<std::shared_ptr<const OrderedEntries>> SqliteStore::ordered_entries_of(const CatalogueEntry& relation,
                                                                              const std::string& attribute) {
  A3D_ASSIGN(const auto layout, database_->layout_of(relation));
  const std::size_t position = layout->find(attribute);
  if (position == layout->attributes().size())
    return Error{ErrorCode::database_corrupt, "there is no attribute '{}' for an index", attribute}.about(
        relation.name);
  return ordered_entries(database_, layout, position);
}

}  // namespace queries
