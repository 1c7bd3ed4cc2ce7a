#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "queries/store/detail/stored_rows.h"

namespace queries {

/// Prefix of findings about the catalogue.
inline constexpr const char* kCatalogueFinding = "the catalogue: ";

/// Implements Store::check: reads the whole database within a statement and lists the damage as findings. An error
/// means that the check itself could not continue. For one run.
class IntegrityCheck {
 public:
  using Progress = std::function<void(const CheckProgress&)>;

  IntegrityCheck(std::shared_ptr<Database> database, const algebra3d::Context& context, Progress progress)
      : database_(std::move(database)), context_(context), progress_(std::move(progress)) {}

  Result<std::vector<Finding>> run();

 private:
  using Entries = std::vector<rtree::Entry<std::uint64_t>>;
  struct Walk;  // a relation that is being read

  // integrity_check_tables.cpp
  Status check_pages();
  Result<bool> check_pages_of(std::string_view sql, const Finding& place);
  Status check_schema();
  bool is_stored_order(const std::string& name) const;
  Status check_stored_orders();
  Status check_stored_order(const RelationLayout& layout, std::size_t attribute);
  const CatalogueEntry* order_definition(const RelationLayout& layout, std::size_t attribute) const;
  Status check_columns();
  Status check_columns_of(SqliteConnection& model, const std::string& table, const Finding& place);
  Status check_meta();
  Status check_indexes(SqliteConnection& model);
  Status check_abandoned();
  Result<bool> has_rows(std::int64_t number);
  void add_page_faults();
  void add_page_finding(const Finding& place, std::string_view line);
  std::vector<std::pair<std::string, Finding>> tables();

  Status check_catalogue();
  Status check_object(const CatalogueEntry& entry);
  Status check_value(const CatalogueEntry& entry);
  Status check_definition(const CatalogueEntry& entry);

  Status check_relation(const CatalogueEntry& entry);
  Status check_rows(Walk& walk);
  Result<bool> read_rows(Walk& walk, TupleId from);
  TupleId first_readable(const Walk& walk, TupleId from);
  std::optional<TupleId> readable_from(const Walk& walk, TupleId from);
  void add_readable(const Walk& walk);
  void add_readable_objects();
  Status check_row(Walk& walk, const SqliteStatement& row);
  Status check_attribute(Walk& walk, const RowReader& reader, std::size_t attribute);
  Result<Value> proved(const Value& value);
  // integrity_check_groups.cpp
  Status check_groups(Walk& walk);
  Status check_group(Walk& walk, const RowGroup& group);
  Status check_beside(Walk& walk, const RowGroup& group);
  Status walk_values(Walk& walk, TupleId id, const std::function<Result<Value>(std::size_t)>& value_of);
  Status check_key_tables(Walk& walk);
  Status check_group_tables();

  void check_totals(const Walk& walk);
  void check_trees(Walk& walk);
  bool is_lost_tree(const CatalogueEntry& relation, std::size_t attribute, std::int64_t owner);
  Status check_tree(const Entries& boxes, const SpatialIndex::Tree& tree, const Finding& place);

  Status check_numbers(std::string_view table, std::string_view column);
  Status check_chunks();
  Status check_index_pages();
  Status check_levels();
  Result<bool> has_chunks(std::int64_t owner, std::int64_t tuple, std::int64_t attribute);

  void add(Finding finding);
  /// Adds a finding if the error means damaged data; else returns the error.
  Status add(Finding finding, const Error& error);
  Status advance(const std::string& object);

  std::shared_ptr<Database> database_;
  const algebra3d::Context& context_;
  Progress progress_;
  CheckProgress done_;
  std::vector<Finding> findings_;
  std::map<std::string, std::size_t> finding_counts_;  // by object
  std::set<std::int64_t> abandoned_;
  std::map<std::int64_t, std::shared_ptr<const RelationLayout>> layouts_;  // by table number
};

}  // namespace queries
