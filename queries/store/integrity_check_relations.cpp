// The part of the integrity check that reads relations.
#include "algebra3d/types/codec.h"
#include "queries/store/frozen_index.h"
#include "queries/store/frozen_order.h"
#include "queries/store/integrity_check.h"
#include "queries/store/stored_value.h"

namespace queries {

struct IntegrityCheck::Walk {
  const CatalogueEntry& entry;
  std::shared_ptr<const RelationLayout> layout;
  std::int64_t count = 0;
  std::uint64_t sum = 0;
  TupleId last = 0;
  bool is_complete = false;  ///< all rows could be read
  // By attribute, of those that have a tree in memory.
  std::map<std::size_t, Entries> boxes = {};
  std::map<std::size_t, std::vector<OrderedTree::Entry>> keys = {};
};

Status IntegrityCheck::check_relation(const CatalogueEntry& entry) {
  const auto layout = database_->layout_of(entry);
  if (!layout) return add({.object = entry.name}, layout.error());
  layouts_.emplace(entry.table_number, *layout);
  Walk walk{entry, *layout};
  for (std::size_t i = 0; i < (*layout)->attributes().size(); ++i)
    if (database_->indexes().find(entry.table_number, i) != nullptr) walk.boxes[i] = {};
  for (const std::size_t attribute : database_->indexes().ordered_attributes(entry.table_number))
    walk.keys[attribute] = {};
  RETURN_IF_ERROR(check_rows(walk));
  if (!walk.is_complete) return {};
  check_totals(walk);
  check_trees(walk);
  return {};
}

Status IntegrityCheck::check_rows(Walk& walk) {
  const std::string& name = walk.entry.name;
  auto rows = database_->connection().use(walk.layout->page_sql());
  if (!rows) return add({.object = name}, rows.error());
  constexpr std::int64_t kAllRows = -1;
  rows->bind(1, INT64_MIN).bind(2, INT64_MAX).bind(3, kAllRows);
  walk.last = INT64_MIN;
  while (true) {
    const auto has_row = rows->step();
    if (!has_row)
      return add({.object = name,
                  .tuple = std::max<TupleId>(walk.last, 0),
                  .message = "the tuples that follow cannot be read: "},
                 has_row.error());
    if (!*has_row) break;
    RETURN_IF_ERROR(advance(name));
    const TupleId id = rows->column(0).integer;
    // A damaged tree could lead round in circles.
    if (id <= walk.last) {
      add({.object = name, .tuple = id, .message = "the tuples are not in order"});
      return {};
    }
    walk.last = id;
    RETURN_IF_ERROR(check_row(walk, *rows));
  }
  walk.is_complete = true;
  return {};
}

Status IntegrityCheck::check_row(Walk& walk, const SqliteStatement& row) {
  RowReader reader(database_, walk.layout, database_->changes().now());
  const Status taken = reader.take(row);
  ++walk.count;
  walk.sum += reader.checksum();
  if (!taken) {
    add({.object = walk.entry.name, .tuple = reader.id(), .message = "the row is not what was written"});
    return {};
  }
  for (std::size_t i = 0; i < walk.layout->attributes().size(); ++i) RETURN_IF_ERROR(check_attribute(walk, reader, i));
  for (auto& [attribute, boxes] : walk.boxes)
    if (const auto box = reader.box(attribute); !box.is_empty())
      boxes.push_back({box, static_cast<std::uint64_t>(reader.id())});
  return {};
}

Status IntegrityCheck::check_attribute(Walk& walk, const RowReader& reader, std::size_t attribute) {
  const AttributeColumns& columns = walk.layout->attributes()[attribute];
  const Finding place{.object = walk.entry.name, .tuple = reader.id(), .attribute = columns.name, .message = ""};
  auto value = reader.value(attribute);
  if (value && value->is_defined()) value = proved(*value);
  if (!value) return add(place, value.error());
  if (const auto keys = walk.keys.find(attribute); keys != walk.keys.end() && value->is_defined())
    keys->second.push_back({*value, reader.id()});
  if (!columns.has_box() || !value->is_defined()) return {};
  const auto header = value->header();
  Finding wrong = place;
  if (!(header.box == reader.box(attribute))) {
    wrong.message = "the box in the columns is not that of the value";
    add(wrong);
  }
  if (header.size != reader.size(attribute)) {
    wrong.message =
        fmt::format("the size in the columns is {}, that of the value {}", reader.size(attribute), header.size);
    add(wrong);
  }
  return {};
}

/// A large value is read, its checksum compared, and its validity proved as if it came from elsewhere.
Result<Value> IntegrityCheck::proved(const Value& value) {
  const auto deferred = value.deferred();
  if (deferred == nullptr) return value;
  ASSIGN_OR_RETURN(const std::string bytes, static_cast<const StoredValue&>(*deferred).encoded());
  return algebra3d::decode(value.type(), bytes, algebra3d::Origin::elsewhere);
}

void IntegrityCheck::check_totals(const Walk& walk) {
  const CatalogueEntry& entry = walk.entry;
  const auto wrong = [&](std::string message) { add({.object = entry.name, .message = std::move(message)}); };
  if (walk.count != entry.tuple_count)
    wrong(fmt::format("there are {} tuples, {} were written", walk.count, entry.tuple_count));
  else if (walk.sum != entry.tuple_sum)
    wrong("the tuples are not those that were written");
  if (walk.count > 0 && walk.last >= entry.next_tuple)
    wrong(fmt::format("there is a tuple {}, the next one is to be {}", walk.last, entry.next_tuple));
}

// The same entries give the same bytes.
void IntegrityCheck::check_trees(Walk& walk) {
  for (const auto& [attribute, boxes] : walk.boxes) {
    const auto tree = database_->indexes().find(walk.entry.table_number, attribute);
    const std::string& name = walk.layout->attributes()[attribute].name;
    const auto faults = rtree::audit(*tree);
    for (const std::string& fault : faults)
      add({.object = walk.entry.name, .attribute = name, .message = "the index in memory: " + fault});
    if (faults.empty() && encode_tree(*tree) != encode_tree(SpatialIndex::Tree::bulk_load(boxes)))
      add({.object = walk.entry.name,
           .attribute = name,
           .message = "the index in memory does not have the boxes of the relation"});
  }
  for (auto& [attribute, keys] : walk.keys) {
    const auto tree = database_->indexes().find_ordered(walk.entry.table_number, attribute);
    if (encode_order(*tree) != encode_order(OrderedTree::bulk_load(std::move(keys))))
      add({.object = walk.entry.name,
           .attribute = walk.layout->attributes()[attribute].name,
           .message = "the ordered index in memory does not have the values of the relation"});
  }
}

}  // namespace queries
