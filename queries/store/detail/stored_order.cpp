#include "queries/store/detail/stored_order.h"

#include <compare>

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

/// A key that outlives the row that it was read from.
class KeptKey {
 public:
  const Cell& cell() const { return cell_; }
  void keep(const Cell& cell) {
    cell_ = cell;
    text_.assign(cell.bytes);
    cell_.bytes = text_;
  }

 private:
  Cell cell_;
  std::string text_;
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
  ALGEBRA3D_RETURN_IF_ERROR(database_->check_statement(statement_));
  ALGEBRA3D_ASSIGN_OR_RETURN(
      const std::int64_t count,
      database_->connection().integer(fmt::format(
          "SELECT count({}) FROM {}", layout_->column(layout_->attributes()[attribute_].value), layout_->table())));
  return static_cast<std::size_t>(count);
}

Result<std::vector<TupleId>> StoredOrder::range(const std::optional<Value>& low,
                                                const std::optional<Value>& high) const {
  ALGEBRA3D_RETURN_IF_ERROR(database_->check_statement(statement_));
  const AttributeForm form = layout_->attributes()[attribute_].form;
  Bounds bounds;
  if (low) bounds.low = native_cell(form, *low);
  if (high) bounds.high = native_cell(form, *high);
  auto found = proved_range(bounds);
  if (found || found.error().code != ErrorCode::database_corrupt) return found;
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto tree, order_in_memory(database_, layout_, attribute_));
  return tree->range(low, high);
}

Result<std::vector<TupleId>> StoredOrder::proved_range(const Bounds& bounds) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(SqliteStatement found, entries(bounds.low && bounds.high ? "i.{0} >= ?1 AND i.{0} <= ?2"
                                                            : bounds.low              ? "i.{0} >= ?1"
                                                            : bounds.high             ? "i.{0} <= ?2"
                                                                                      : "i.{0} IS NOT NULL",
                                                            ""));
  if (bounds.low) found.bind(1, *bounds.low);
  if (bounds.high) found.bind(2, *bounds.high);
  std::vector<TupleId> ids;
  KeptKey last;
  while (true) {
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool has_row, found.step());
    if (!has_row) break;
    const Cell key = found.column(kKeyInIndex);
    const TupleId id = found.column(kTuple).integer;
    const auto from_last = order_of(last.cell(), key);
    const bool is_behind_last = ids.empty() || from_last < 0 || (from_last == 0 && ids.back() < id);
    const bool is_within =
        (!bounds.low || order_of(*bounds.low, key) <= 0) && (!bounds.high || order_of(key, *bounds.high) <= 0);
    if (!is_behind_last || !is_within || order_of(key, found.column(kKeyInRow)) != 0) return damaged();
    last.keep(key);
    ids.push_back(id);
  }
  if (bounds.low) ALGEBRA3D_RETURN_IF_ERROR(check_neighbour(bounds, true));
  if (bounds.high) ALGEBRA3D_RETURN_IF_ERROR(check_neighbour(bounds, false));
  return ids;
}

// A search that damage has led astray ends between entries of another place. An entry whose key has changed is found
// beside the place of its true key, since a search by halves takes all others for what they are.
Status StoredOrder::check_neighbour(const Bounds& bounds, bool is_below) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(SqliteStatement found,
                             is_below ? entries("i.{0} < ?1", " DESC") : entries("i.{0} > ?1", ""));
  const Cell& bound = is_below ? *bounds.low : *bounds.high;
  found.bind(1, bound);
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool has_row, found.step());
  if (!has_row) return check_nothing_beyond(bound, is_below);
  const Cell key = found.column(kKeyInIndex);
  const bool is_beyond = is_below ? order_of(key, bound) < 0 : order_of(key, bound) > 0;
  return is_beyond && order_of(key, found.column(kKeyInRow)) == 0 ? Status() : damaged();
}

// A key that has become NULL ends a search for the next one.
Status StoredOrder::check_nothing_beyond(const Cell& bound, bool is_below) const {
  ALGEBRA3D_ASSIGN_OR_RETURN(SqliteStatement outermost, entries("i.{0} IS NOT NULL", is_below ? "" : " DESC"));
  ALGEBRA3D_ASSIGN_OR_RETURN(const bool has_row, outermost.step());
  if (!has_row) return {};
  const Cell key = outermost.column(kKeyInIndex);
  const bool is_beyond = is_below ? !(order_of(key, bound) >= 0) : !(order_of(key, bound) <= 0);
  return !is_beyond && order_of(key, outermost.column(kKeyInRow)) == 0 ? Status() : damaged();
}

Result<bool> has_stored_order(SqliteConnection& connection, const RelationLayout& layout, std::size_t attribute) {
  ALGEBRA3D_ASSIGN_OR_RETURN(SqliteStatement statement,
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
    ALGEBRA3D_ASSIGN_OR_RETURN(const TuplePtr tuple, scan.next());
    if (tuple == nullptr) break;
    ALGEBRA3D_ASSIGN_OR_RETURN(Value key, tuple->attributes[attribute].loaded());
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
    ALGEBRA3D_ASSIGN_OR_RETURN(const bool is_stored, has_stored_order(database->connection(), *layout, attribute));
    if (is_stored) return std::shared_ptr<const OrderedEntries>(new StoredOrder(database, layout, attribute));
  }
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto tree, order_in_memory(database, layout, attribute));
  return std::shared_ptr<const OrderedEntries>(tree);
}

}  // namespace queries
