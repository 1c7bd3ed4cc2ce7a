#include "queries/transfer/detail/pushed_tuples.h"

#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace queries {

Result<RelationPtr> relation_to_push(Store& store, const TransferOptions& options) {
  A3D_ASSIGN(const auto found, store.find(options.relation));
  if (!found)
    return Error{ErrorCode::unknown_name, "there is no relation '{}' in {}", options.relation,
                 options.database.string()};
  if (!found->type.is_relation())
    return Error{ErrorCode::type_error, "'{}' is of type {}, expected a relation", options.relation,
                 found->type.text()};
  A3D_ASSIGN(const Datum datum, store.read(options.relation));
  return datum.relation();
}

Result<RowDigest> skip_pushed_tuples(TupleStream& tuples, TuplePtr& next, const MovedColumns& columns,
                                     std::int64_t last_tuple, const std::function<void()>& report) {
  RowDigest digest;
  while (true) {
    algebra3d::poll_interruption();
    A3D_ASSIGN(next, tuples.next());
    if (next == nullptr || next->id > last_tuple) return digest;
    A3D_ASSIGN(const MovedColumns::Row row, columns.row_of(*next));
    digest = digest + row.digest;
    report();
  }
}

}  // namespace queries
