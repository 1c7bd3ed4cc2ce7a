/* What transactions keep and share, for relations over several servers (algebra3d_shards). */
#include "module.h"

#include <miscadmin.h>
#include <storage/lock.h>
#include <storage/proc.h>
#include <utils/builtins.h>
#include <utils/memutils.h>

/* kept_in_transaction(text): the text, not NULL, of the last call in this transaction; NULL if there was none. The
 * argument, if it is not NULL, is kept for the next one. */
PG_FUNCTION_INFO_V1(algebra3d_kept_in_transaction);
Datum algebra3d_kept_in_transaction(PG_FUNCTION_ARGS) {
  static LocalTransactionId transaction = InvalidLocalTransactionId;
  static char* kept;
  text* before;
  if (transaction != MyProc->lxid) {
    if (kept != NULL) pfree(kept);
    kept = NULL;
    transaction = MyProc->lxid;
  }
  before = kept == NULL ? NULL : cstring_to_text(kept);
  if (!PG_ARGISNULL(0)) {
    char* next = MemoryContextStrdup(TopMemoryContext, text_to_cstring(PG_GETARG_TEXT_PP(0)));
    if (kept != NULL) pfree(kept);
    kept = next;
  }
  if (before == NULL) PG_RETURN_NULL();
  PG_RETURN_TEXT_P(before);
}

/* Transactions that write hold this lock alone from before the first server commits until this one has; those that read
 * share it while they begin on all servers. An error releases it. */
static void tag_of_commits(LOCKTAG* tag) {
  SET_LOCKTAG_ADVISORY(*tag, MyDatabaseId, 0x61336473, 0, 2);
}

/* shard_take_commits(): waits. The end of the transaction releases it. */
PG_FUNCTION_INFO_V1(algebra3d_shard_take_commits);
Datum algebra3d_shard_take_commits(PG_FUNCTION_ARGS) {
  LOCKTAG tag;
  tag_of_commits(&tag);
  LockAcquire(&tag, ExclusiveLock, false, false);
  PG_RETURN_VOID();
}

/* shard_share_commits(): whether there was no need to wait. */
PG_FUNCTION_INFO_V1(algebra3d_shard_share_commits);
Datum algebra3d_shard_share_commits(PG_FUNCTION_ARGS) {
  LOCKTAG tag;
  tag_of_commits(&tag);
  PG_RETURN_BOOL(LockAcquire(&tag, ShareLock, false, true) != LOCKACQUIRE_NOT_AVAIL);
}

PG_FUNCTION_INFO_V1(algebra3d_shard_release_commits);
Datum algebra3d_shard_release_commits(PG_FUNCTION_ARGS) {
  LOCKTAG tag;
  tag_of_commits(&tag);
  LockRelease(&tag, ShareLock, false);
  PG_RETURN_VOID();
}
