// The part of the integrity check that reads relations.
#include <algorithm>
#include <tuple>

#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/frozen_order.h"
#include "queries/store/detail/index_pages.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/integrity_walk.h"
#include "queries/store/detail/stored_tree.h"
#include "queries/store/detail/stored_value.h"
#include "queries/store/detail/tables.h"

namespace queries {
namespace {

constexpr TupleId kEndless = INT64_MAX;

std::string range_text(TupleId first, TupleId last) {
  if (last == kEndless) return fmt::format("tuple {} and those that follow", first);
  return first == last ? fmt::format("tuple {}", first) : fmt::format("tuples {} to {}", first, last);
}

bool entry_before(const rtree::Entry<std::uint64_t>& a, const rtree::Entry<std::uint64_t>& b) {
  return std::tie(a.payload, a.box.min, a.box.max) < std::tie(b.payload, b.box.min, b.box.max);
}

}  // namespace

Status IntegrityCheck::check_relation(const CatalogueEntry& entry) {
  const auto layout = database_->layout_of(entry);
  if (!layout) return add({.object = entry.name}, layout.error());
  layouts_.emplace(entry.table_number, *layout);
  Walk walk{entry, *layout};
  for (std::size_t i = 0; i < (*layout)->attributes().size(); ++i) {
    const bool is_open = database_->indexes().find(entry.table_number, i) != nullptr;
    if (is_open || tree_owner(database_->catalogue(), **layout, i)) walk.boxes[i] = {};
  }
  for (const std::size_t attribute : database_->indexes().ordered_attributes(entry.table_number))
    walk.keys[attribute] = {};
  A3D_ASSIGN(const std::vector<std::size_t>* key_attributes, database_->key_attributes(**layout));
  for (const std::size_t attribute : *key_attributes) walk.key_sums[attribute] = {};
  // Those may be pages of an index of SQLite alone.
  const bool has_damaged_pages = finding_counts_.contains(entry.name);
  A3D_TRY(check_rows(walk));
  A3D_TRY(check_groups(walk));
  if (!walk.gaps.empty() || has_damaged_pages) add_readable(walk);
  if (!walk.gaps.empty()) return {};
  check_totals(walk);
  if (!walk.are_rows_sound || walk.sum != entry.tuple_sum) return {};
  A3D_TRY(check_key_tables(walk));
  check_trees(walk);
  return {};
}

// A page that cannot be read takes the tuples on it away, and not those behind it: these are found by their numbers.
Status IntegrityCheck::check_rows(Walk& walk) {
  TupleId from = INT64_MIN;
  walk.last = INT64_MIN;
  while (true) {
    const auto read = read_rows(walk, from);
    if (read) return {};
    const TupleId first = std::max<TupleId>(walk.last, 0) + 1;
    const TupleId next = first_readable(walk, first);
    const TupleId last = next == kEndless ? kEndless : next - 1;
    walk.gaps.push_back({first, last});
    Finding gap{.object = walk.entry.name, .tuple = first};
    gap.message = fmt::format("{} cannot be read: ", range_text(first, last));
    A3D_TRY(add(std::move(gap), read.error()));
    if (next == kEndless) return {};
    from = next;
  }
}

/// Reads the rows from a tuple on, to the end or to the first that cannot be read, which is an error.
Result<bool> IntegrityCheck::read_rows(Walk& walk, TupleId from) {
  A3D_ASSIGN(SqliteStatement rows, database_->connection().use(walk.layout->tail_sql()));
  constexpr std::int64_t kAllRows = -1;
  rows.bind(1, from).bind(2, kAllRows);
  while (true) {
    A3D_ASSIGN(const bool has_row, rows.step());
    if (!has_row) return true;
    A3D_TRY(advance(walk.entry.name));
    const TupleId id = rows.column(0).integer;
    // A damaged tree could lead round in circles.
    if (id <= walk.last || id < from)
      return Error{ErrorCode::database_corrupt, "the tuples are not in order: tuple {} comes next", id};
    walk.last = id;
    A3D_TRY(check_row(walk, rows));
  }
}

/// The first tuple from `from` on, if it can be read; behind the last one, `from` itself.
std::optional<TupleId> IntegrityCheck::readable_from(const Walk& walk, TupleId from) {
  auto rows = database_->connection().use(walk.layout->tail_sql());
  if (!rows) return std::nullopt;
  rows->bind(1, from).bind(2, 1);
  const auto has_row = rows->step();
  if (!has_row) return std::nullopt;
  const TupleId found = *has_row ? rows->column(0).integer : from;
  const bool is_right = *has_row ? found >= from : from >= walk.entry.next_tuple;
  return is_right ? std::optional(found) : std::nullopt;
}

// One by one as far as a page may reach, then in steps that double, and back to the first of the readable ones.
TupleId IntegrityCheck::first_readable(const Walk& walk, TupleId from) {
  constexpr TupleId kOneByOne = 1000;
  const TupleId end = walk.entry.next_tuple;
  for (TupleId id = from + 1; id < std::min(from + kOneByOne, end); ++id)
    if (const auto found = readable_from(walk, id)) return *found;
  TupleId unreadable = std::min(from + kOneByOne, end) - 1;
  for (TupleId step = 1; unreadable + step < end; step *= 2) {
    if (!readable_from(walk, unreadable + step)) {
      unreadable += step;
      continue;
    }
    TupleId readable = unreadable + step;
    while (readable - unreadable > 1) {
      const TupleId middle = unreadable + (readable - unreadable) / 2;
      (readable_from(walk, middle) ? readable : unreadable) = middle;
    }
    return readable_from(walk, readable).value_or(kEndless);
  }
  return kEndless;
}

void IntegrityCheck::add_readable(const Walk& walk) {
  std::string ranges;
  TupleId begin = 1;
  const auto add_range = [&](TupleId first, TupleId last) {
    if (first > last) return;
    ranges += (ranges.empty() ? "" : ", ") + range_text(first, last);
  };
  for (const Walk::Gap& gap : walk.gaps) {
    add_range(begin, gap.first - 1);
    begin = gap.last == kEndless ? kEndless : gap.last + 1;
  }
  if (begin != kEndless) add_range(begin, walk.last);
  add({.object = walk.entry.name,
       .message = fmt::format("{} of {} tuples can still be read{}{}", walk.count, walk.entry.tuple_count,
                              ranges.empty() ? "" : ": ", ranges)});
}

Status IntegrityCheck::check_row(Walk& walk, const SqliteStatement& row) {
  RowReader reader(database_, walk.layout, database_->changes().now());
  const Status taken = reader.take(row);
  ++walk.count;
  walk.sum += reader.checksum();
  if (!taken) {
    walk.are_rows_sound = false;
    add({.object = walk.entry.name, .tuple = reader.id(), .message = "the row is not what was written"});
    return {};
  }
  for (std::size_t i = 0; i < walk.layout->attributes().size(); ++i) A3D_TRY(check_attribute(walk, reader, i));
  for (auto& [attribute, boxes] : walk.boxes)
    if (const auto box = reader.box(attribute); !box.is_empty())
      boxes.push_back({box, static_cast<std::uint64_t>(reader.id())});
  for (auto& [attribute, sum] : walk.key_sums)
    sum.add(reader.id(), reader.cells()[walk.layout->attributes()[attribute].value]);
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
  A3D_ASSIGN(const std::string bytes, static_cast<const StoredValue&>(*deferred).encoded());
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

// A tree that is stored with another state of the relation or by another version is made anew when it is needed, and no
// damage. Damage to a stored tree is that of the index, and not of its relation.
void IntegrityCheck::check_trees(Walk& walk) {
  for (auto& [attribute, boxes] : walk.boxes) {
    std::ranges::sort(boxes, entry_before);
    const std::string& name = walk.layout->attributes()[attribute].name;
    // Parts of it that cannot be read are reported for the stored index.
    if (const auto open = database_->indexes().find(walk.entry.table_number, attribute))
      static_cast<void>(
          check_tree(boxes, *open, {.object = walk.entry.name, .attribute = name, .message = "the index in memory"}));
    const auto owner = tree_owner(database_->catalogue(), *walk.layout, attribute);
    if (!owner || database_->catalogue().version() < kFirstVersionWithIndexPages) continue;
    const auto is_stored = has_tree(database_->connection(), *owner, relation_state(walk.entry, attribute));
    const auto index = std::ranges::find_if(database_->catalogue().entries(),
                                            [&](const auto& each) { return each.second.id == *owner; });
    const Finding place{.object = index->first, .message = "the stored index"};
    if (is_stored && !*is_stored) {
      if (is_lost_tree(walk.entry, attribute, *owner))
        add({.object = place.object,
             .message = place.message + " is not there: another program has erased it; it is made anew when it is next "
                                        "used"});
      continue;
    }
    const auto stored =
        is_stored ? load_tree(database_, *owner) : Result<std::shared_ptr<SpatialIndex::Tree>>(is_stored.error());
    if (!stored && stored.error().code == ErrorCode::database_version) continue;
    Status status = stored ? check_tree(boxes, **stored, place) : Status(stored.error());
    if (!status) add({.object = place.object, .message = std::move(status).error().about(place.message).text()});
  }
  for (auto& [attribute, keys] : walk.keys) {
    const auto tree = database_->indexes().find_ordered(walk.entry.table_number, attribute);
    if (encode_order(*tree) != encode_order(OrderedTree::bulk_load(std::move(keys))))
      add({.object = walk.entry.name,
           .attribute = walk.layout->attributes()[attribute].name,
           .message = "the ordered index in memory does not have the values of the relation"});
  }
}

/// Whether a tree that was stored when its index was made has no pages at all. Files of older versions may have none
/// yet, and one that the running transaction has made is not written yet.
bool IntegrityCheck::is_lost_tree(const CatalogueEntry& relation, std::size_t attribute, std::int64_t owner) {
  if (database_->catalogue().version() <= kLastVersionWithoutPageSums) return false;
  const auto unstored = database_->indexes().unstored();
  const IndexCache::Place place{relation.table_number, attribute};
  if (std::ranges::any_of(unstored, [&](const auto& each) { return each.place == place; })) return false;
  const auto header = read_index_page(database_->connection(), {owner, 0});
  return header && !*header;
}

/// Compares a tree with the sorted boxes of the rows. Errors: those of reading the tree.
Status IntegrityCheck::check_tree(const Entries& boxes, const SpatialIndex::Tree& tree, const Finding& place) {
  const auto finding = [&](std::string_view fault) {
    Finding found = place;
    found.message += fault;
    add(std::move(found));
  };
  const auto read = reading_tree([&] {
    const auto faults = rtree::audit(tree);
    for (const std::string& fault : faults) finding(": " + fault);
    if (!faults.empty()) return true;
    Entries entries = tree.entries();
    std::ranges::sort(entries, entry_before);
    if (entries != boxes) finding(" does not have the boxes of the relation");
    return true;
  });
  return read ? Status() : Status(read.error());
}

}  // namespace queries
