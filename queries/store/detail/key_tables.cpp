#include "queries/store/detail/key_tables.h"

#include "base/propagate.h"
#include "queries/store/detail/relation_scan.h"

namespace queries {
namespace {

Cell key_of(const AttributeColumns& attribute, const Value& value) {
  return value.is_defined() ? native_cell(attribute.form, value) : Cell();
}

Status insert_key(Database& database, const RelationLayout& layout, std::size_t attribute, TupleId id,
                  const Value& value) {
  A3D_ASSIGN(SqliteStatement statement, database.connection().use(layout.insert_key_sql(attribute)));
  return statement.bind(1, id).bind(2, key_of(layout.attributes()[attribute], value)).run();
}

}  // namespace

// The index is made last: SQLite then sorts its entries at once.
Status make_order(const std::shared_ptr<Database>& database, const std::shared_ptr<const RelationLayout>& layout,
                  std::size_t attribute) {
  if (!layout->has_columns() || !database->has_row_groups())
    return database->connection().execute(layout->create_order_sql(attribute, RelationLayout::OrderOn::table));
  A3D_TRY(database->connection().execute(layout->create_keys_sql(attribute)));
  std::vector<bool> read(layout->attributes().size(), false);
  read[attribute] = true;
  RelationScan scan(database, layout, std::move(read));
  while (true) {
    A3D_ASSIGN(const Batch* batch, scan.next_batch(kBatchTuples));
    if (batch == nullptr) break;
    for (std::size_t i = 0; i < batch->rows.count; ++i) {
      const std::size_t row = batch->rows[i];
      A3D_TRY(insert_key(*database, *layout, attribute, batch->ids[row], batch->columns[attribute]->value(row)));
    }
  }
  database->forget_key_attributes(layout->table_number());
  return database->connection().execute(layout->create_order_sql(attribute, RelationLayout::OrderOn::keys));
}

Status drop_order(Database& database, const RelationLayout& layout, std::size_t attribute) {
  if (!layout.has_columns()) return database.connection().execute(layout.drop_order_sql(attribute));
  database.forget_key_attributes(layout.table_number());
  A3D_TRY(database.connection().execute(layout.drop_order_sql(attribute)));
  return database.connection().execute(layout.drop_keys_sql(attribute));
}

Status move_orders(Database& database, const RelationLayout& layout) {
  SqliteConnection& connection = database.connection();
  for (std::size_t attribute = 0; attribute < layout.attributes().size(); ++attribute) {
    if (!layout.attributes()[attribute].has_native_order()) continue;
    bool is_there = false;
    {
      A3D_ASSIGN(SqliteStatement statement,
                 connection.use("SELECT 1 FROM sqlite_schema WHERE type = 'index' AND name = ? AND tbl_name = ? "
                                "COLLATE NOCASE"));
      const std::string name = layout.order_name(attribute);
      A3D_ASSIGN(is_there, statement.bind(1, std::string_view(name)).bind(2, std::string_view(layout.table())).step());
    }
    if (!is_there) continue;
    A3D_TRY(connection.execute(layout.drop_order_sql(attribute)));
    A3D_TRY(connection.execute(layout.create_keys_sql(attribute)));
    A3D_TRY(connection.execute(layout.fill_keys_sql(attribute)));
    A3D_TRY(connection.execute(layout.create_order_sql(attribute, RelationLayout::OrderOn::keys)));
  }
  database.forget_key_attributes(layout.table_number());
  return {};
}

Status insert_keys(Database& database, const RelationLayout& layout, TupleId id, const std::vector<Value>& values) {
  A3D_ASSIGN(const std::vector<std::size_t>* attributes, database.key_attributes(layout));
  for (const std::size_t attribute : *attributes)
    A3D_TRY(insert_key(database, layout, attribute, id, values[attribute]));
  return {};
}

Status update_keys(Database& database, const RelationLayout& layout, const RowReader& old, const RowWriter& writer) {
  A3D_ASSIGN(const std::vector<std::size_t>* attributes, database.key_attributes(layout));
  for (const std::size_t attribute : *attributes) {
    const AttributeColumns& columns = layout.attributes()[attribute];
    const Cell key = key_of(columns, writer.value(attribute));
    if (are_same(key, old.cells()[columns.value])) continue;
    A3D_ASSIGN(SqliteStatement statement, database.connection().use(layout.update_key_sql(attribute)));
    A3D_TRY(statement.bind(1, key).bind(2, old.id()).run());
  }
  return {};
}

Status update_key(Database& database, const RelationLayout& layout, std::size_t attribute, TupleId id,
                  const Value& value) {
  A3D_ASSIGN(SqliteStatement statement, database.connection().use(layout.update_key_sql(attribute)));
  return statement.bind(1, key_of(layout.attributes()[attribute], value)).bind(2, id).run();
}

Status erase_keys(Database& database, const RelationLayout& layout, TupleId id) {
  A3D_ASSIGN(const std::vector<std::size_t>* attributes, database.key_attributes(layout));
  for (const std::size_t attribute : *attributes) {
    A3D_ASSIGN(SqliteStatement statement, database.connection().use(layout.erase_key_sql(attribute)));
    A3D_TRY(statement.bind(1, id).run());
  }
  return {};
}

}  // namespace queries
