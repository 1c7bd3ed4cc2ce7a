#pragma once

#include <memory>

#include "queries/store/detail/database.h"

namespace queries {

/// The implementation of Store by the catalogue, the tables and the caches of a Database.
class SqliteStore final : public Store {
 public:
  explicit SqliteStore(std::shared_ptr<Database> database) : database_(std::move(database)) {}
  ~SqliteStore() override { database_->close(); }
  SqliteStore(const SqliteStore&) = delete;
  SqliteStore& operator=(const SqliteStore&) = delete;

  const std::filesystem::path& file() const override { return database_->file(); }

  const std::string& opening_notice() const override { return database_->opening_notice(); }

  void end_waiting_when(const std::atomic<bool>* cancel) override { database_->end_waiting_when(cancel); }
  Result<bool> empty_log(int milliseconds) override { return database_->empty_log(milliseconds); }
  Status begin_transaction() override { return database_->begin_transaction(); }
  Status commit_transaction() override { return database_->commit_transaction(); }
  Status abort_transaction() override { return database_->abort_transaction(); }
  bool is_in_explicit_transaction() const override { return database_->is_in_explicit_transaction(); }
  Status begin(bool writes) override { return database_->begin(writes); }
  Status commit() override { return database_->commit(); }
  void rollback() override { database_->rollback(); }
  bool has_written() const override { return database_->has_written(); }

  Result<std::vector<ObjectInfo>> objects() override;
  Result<std::optional<ObjectInfo>> find(const std::string& name) override;
  Status create(const std::string& name, const TypeExpr& type) override;
  Status create_derived(const std::string& name, const TypeExpr& type, const std::string& text) override;
  Status create_function(const std::string& name, const TypeExpr& type, const std::string& text) override;
  Status assign(const std::string& name, const Datum& value, const algebra3d::Context& context) override;
  Result<Datum> read(const std::string& name) override;
  Status remove(const std::string& name) override;
  Status kill(const std::string& name) override;
  Status rename(const std::string& from, const std::string& to) override;
  Result<std::vector<NamedType>> types() override;
  Result<std::optional<TypeExpr>> find_type(const std::string& name) override;
  Status create_type(const std::string& name, const TypeExpr& type) override;
  Status remove_type(const std::string& name) override;
  Result<std::vector<Finding>> check(const algebra3d::Context& context,
                                     const std::function<void(const CheckProgress&)>& progress) override;

  ChangeCounts change_counts() const override { return database_->change_counts(); }
  std::uint64_t geometry_loads() const override { return database_->geometry_loads(); }
  std::uint64_t faces_in_blocks() const override { return database_->faces_in_blocks(); }
  Result<bool> is_imported(const std::string& relation, const ImportedFile& file) override;
  Status remember_imported(const std::string& relation, const ImportedFile& file) override;
  Status forget_imported(const std::string& relation, const std::string& path) override;
  Result<std::vector<PulledTable>> pulled_tables(const std::string& relation) override;
  Status remember_pulled(const std::string& relation, const PulledTable& table) override;
  Status forget_pulled(const std::string& relation) override;

 private:
  Result<const CatalogueEntry*> required(const std::string& name);
  Status check_free(const std::string& name) const;
  Status add(CatalogueEntry entry);
  Status check_storable(const std::string& name, const TypeExpr& type) const;

  Result<Datum> read_relation(const CatalogueEntry& entry);
  Result<Datum> read_index(const CatalogueEntry& entry);
  Result<Datum> read_ordered_index(const CatalogueEntry& entry);
  Result<const CatalogueEntry*> indexed_relation(const CatalogueEntry& index);
  Result<IndexPlace> spatial_place(const CatalogueEntry& relation, const std::string& attribute);

  Status assign_relation(CatalogueEntry& entry, const Datum& value, const algebra3d::Context& context);
  Result<std::shared_ptr<const OrderedEntries>> ordered_entries_of(const CatalogueEntry& relation,
                                                                   const std::string& attribute);
  Status make_stored_index(const CatalogueEntry& index, const CatalogueEntry& relation);
  /// Makes the stored indexes on a relation that was filled.
  Status make_stored_indexes(const CatalogueEntry& relation);
  Status drop_stored_index(const CatalogueEntry& index);
  template <typename Index>
  Status assign_index(CatalogueEntry& entry, const Index& index);
  Status assign_value(CatalogueEntry& entry, const Value& value);
  Status drop_table(const CatalogueEntry& entry);
  Status remove_entry(const CatalogueEntry& entry);
  Result<bool> is_sound(const CatalogueEntry& entry);
  Status abandon(const CatalogueEntry& entry);
  std::vector<std::string> with_indexes(const CatalogueEntry& entry) const;

  std::shared_ptr<Database> database_;
};

}  // namespace queries
