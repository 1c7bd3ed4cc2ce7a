#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "queries/store/detail/stored_rows.h"
#include "queries/streams/relation.h"

namespace queries {

/// A relation in the database, for one statement. Of large attributes a tuple has box and size; the geometry is read on
/// demand. At its end a scan checks that no tuple was missing.
class StoredRelation final : public Relation {
 public:
  StoredRelation(std::shared_ptr<Database> database, std::shared_ptr<const RelationLayout> layout)
      : database_(std::move(database)), layout_(std::move(layout)), statement_(database_->statement()) {}

  const TypeExpr& tuple_type() const override { return layout_->tuple_type(); }
  std::string name() const override { return layout_->relation(); }
  Result<std::int64_t> count() const override;
  Result<TupleStreamPtr> scan() override;
  Result<TupleStreamPtr> scan_columns(std::vector<bool> read, std::vector<AttributeBounds> bounds) override;
  Result<TuplePtr> fetch(TupleId id) override;
  Result<std::unique_ptr<TuplesById>> by_id(std::vector<bool> read) override;
  bool keeps(TupleId id) const override;

  Result<TupleId> insert(const Tuple& tuple) override;
  Result<TupleStreamPtr> insert_all(TupleStream& tuples, const algebra3d::Context& context) override;
  Status erase(TupleId id) override;
  Status update(TupleId id, const Tuple& tuple) override;
  Status erase_all(std::span<const TupleId> ids, const algebra3d::Context& context) override;
  bool changes_in_columns() const override { return database_->makes_row_groups(*layout_); }
  Status update_all(std::span<const TupleId> ids, std::span<const std::size_t> attributes, TupleStream& values,
                    const algebra3d::Context& context) override;

 private:
  using Keys = std::vector<std::pair<std::size_t, Value>>;  // by attribute

  Result<const CatalogueEntry*> entry() const;
  Result<Keys> keys(const std::function<Result<Value>(std::size_t)>& value_of) const;
  struct OldRow;
  Result<std::unique_ptr<OldRow>> read_row(TupleId id) const;
  Status write(CatalogueEntry& entry, RowWriter& writer, TupleId id);
  Status erase_place(CatalogueEntry& entry, const OldRow& old, TupleId id);
  Status index_group(const RowGroup& group);
  Status erase_row(CatalogueEntry& entry, TupleId id);
  Status update_row(TupleId id, std::span<const std::size_t> attributes, const Tuple& values);
  Status overwrite(CatalogueEntry& entry, const OldRow& old, RowWriter& writer, TupleId id);
  void change_keys(const Keys& old_keys, const Keys& new_keys, TupleId id);

  std::shared_ptr<Database> database_;
  std::shared_ptr<const RelationLayout> layout_;
  std::uint64_t statement_;
};

/// Fills the new table of `layout` with the tuples of `source`; sets count, sum and next id in `entry`.
Status fill_relation(Database& database, const std::shared_ptr<const RelationLayout>& layout, CatalogueEntry& entry,
                     TupleStream& source, const algebra3d::Context& context);

}  // namespace queries
