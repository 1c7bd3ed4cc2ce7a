/* What a transaction saw first, for relations over several servers (algebra3d_shards). */
#include "module.h"

#include <storage/proc.h>

/* first_in_transaction(n): the argument of the first call in this transaction. */
PG_FUNCTION_INFO_V1(algebra3d_first_in_transaction);
Datum algebra3d_first_in_transaction(PG_FUNCTION_ARGS) {
  static LocalTransactionId transaction = InvalidLocalTransactionId;
  static int64 first;
  if (transaction != MyProc->lxid) {
    transaction = MyProc->lxid;
    first = PG_GETARG_INT64(0);
  }
  PG_RETURN_INT64(first);
}
