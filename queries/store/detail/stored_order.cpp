#include "queries/store/detail/stored_order.h"

#include <compare>

#include "base/propagate.h"
#include "queries/store/detail/relation_scan.h"

namespace queries {
namespace {

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

}  // namespace

Error StoredOrder::damaged() const {
  return {ErrorCode::database_corrupt, "{}: the index of '{}' does not have the values of the relation",
          layout_->relation(), layout_->attributes()[attribute_].name};
}

// The key comes from the index, which has it besides the id; the row is found by the id.
Result<SqliteStatement> StoredOrder::entries(std::string_view condition, std::string_view order) const {
  const std::string& column = layout_->column(layout_->attributes()[attribute_].value);
  return database_->connection().use(
      fmt::format("SELECT i.{0}, i.id, r.{0} FROM {1} AS i INDEXED BY {2} LEFT JOIN {1} AS r ON r.id = i.id WHERE {3} "
                  "ORDER BY i.{0}{4}, i.id{4}",
                  column, layout_->table(), layout_->order_name(attribute_),
                  fmt::vformat(condition, fmt::make_format_args(column)), order));
}

Result<std::size_t> StoredOrder::size() const {
  A3D_TRY(database_->check_statement(statement_));
  A3D_ASSIGN(
      const std::int64_t count,
      database_->connection().integer(fmt::format(
          "SELECT count({}) FROM {}", layout_->column(layout_->attributes()[attribute_].value), layout_->table())));
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

Result<bool> has_stored_order(SqliteConnection& connection, const RelationLayout& layout, std::size_t attribute) {
  A3D_ASSIGN(SqliteStatement statement,
             connection.use("SELECT 1 FROM sqlite_schema WHERE type = 'index' AND name = ? AND "
                            "tbl_name = ? COLLATE NOCASE"));
  const std::string name = layout.order_name(attribute);
  return statement.bind(1, std::string_view(name)).bind(2, std::string_view(layout.table())).step();
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

Result<std::shared_ptr<const OrderedEntries>> ordered_entries(const std::shared_ptr<Database>& database,
                                                              const std::shared_ptr<const RelationLayout>& layout,
                                                              std::size_t attribute) {
  const bool is_in_memory = database->indexes().find_ordered(layout->table_number(), attribute) != nullptr;
  if (!is_in_memory && layout->attributes()[attribute].has_native_order()) {
    A3D_ASSIGN(const bool is_stored, has_stored_order(database->connection(), *layout, attribute));
    if (is_stored) return std::shared_ptr<const OrderedEntries>(new StoredOrder(database, layout, attribute));
  }
  A3D_ASSIGN(const auto tree, order_in_memory(database, layout, attribute));
  return std::shared_ptr<const OrderedEntries>(tree);
}

}  // namespace queries
