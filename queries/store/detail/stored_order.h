#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "queries/store/detail/database.h"
#include "queries/streams/ordered_index.h"

namespace queries {

/// The ordered index of an attribute with a native order (AttributeColumns::has_native_order): an index of SQLite on
/// the relation's table. It shows the relation as it is when it is asked, in the statement that made this object.
///
/// SQLite does not notice changed bytes in an index. So each entry that is found, and its neighbours in the index, are
/// compared with the rows that they name, and with each other. Where they are wrong, or cannot be read, the answer
/// comes from a tree in memory that is made of the rows, and the index is made anew after the statement.
class StoredOrder final : public OrderedEntries {
 public:
  StoredOrder(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout, std::size_t attribute)
      : database_(std::move(database)),
        layout_(std::move(layout)),
        attribute_(attribute),
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
  std::uint64_t statement_;
};

/// Whether the file has SQLite's index of the attribute. Cost: that of reading the names of all tables.
Result<bool> has_stored_order(SqliteConnection& connection, const RelationLayout& layout, std::size_t attribute);

/// The ordered index of an attribute in memory: the one that is there, or one made of the rows. It follows the changes
/// of its relation until it is dropped. Cost: that of reading and sorting all rows.
Result<std::shared_ptr<OrderedTree>> order_in_memory(const std::shared_ptr<Database>& database,
                                                     const std::shared_ptr<const RelationLayout>& layout,
                                                     std::size_t attribute);

/// The ordered index of an attribute: SQLite's if there is one, else one in memory. One that is missing is made after
/// the statement.
Result<std::shared_ptr<const OrderedEntries>> ordered_entries(const std::shared_ptr<Database>& database,
                                                              const std::shared_ptr<const RelationLayout>& layout,
                                                              std::size_t attribute);

}  // namespace queries
