#pragma once

#include <memory>
#include <vector>

#include "queries/store/detail/stored_rows.h"

namespace queries {

// Ordered indexes of relations whose tuples may stand in row groups. An index of SQLite needs rows: so each indexed
// attribute has a table of its own, the key table, with the id and the key of each tuple, and the index is on that.

/// Makes SQLite's index of an attribute with a native order: on a key table if the file has row groups and the
/// relation's types allow them, else on the relation's table.
Status make_order(const std::shared_ptr<Database>& database, const std::shared_ptr<const RelationLayout>& layout,
                  std::size_t attribute);
/// Drops the index of an attribute, and its key table if there is one.
Status drop_order(Database& database, const RelationLayout& layout, std::size_t attribute);
/// Puts key tables in place of the indexes on a relation's table, before it gets its first row group.
Status move_orders(Database& database, const RelationLayout& layout);

/// The tuple comes into the key tables of its relation, gets other keys there, or leaves them.
Status insert_keys(Database& database, const RelationLayout& layout, TupleId id, const std::vector<Value>& values);
Status update_keys(Database& database, const RelationLayout& layout, const RowReader& old, const RowWriter& writer);
/// The tuple gets another key in the key table of one attribute.
Status update_key(Database& database, const RelationLayout& layout, std::size_t attribute, TupleId id,
                  const Value& value);
Status erase_keys(Database& database, const RelationLayout& layout, TupleId id);

}  // namespace queries
