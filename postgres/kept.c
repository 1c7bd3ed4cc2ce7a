/* Decoded values that the running statement may read again. */
#include "module.h"

#include <access/detoast.h>
#include <access/htup_details.h>
#include <access/xact.h>
#include <common/hashfn.h>
#include <funcapi.h>
#include <lib/ilist.h>
#include <utils/memutils.h>
#include <utils/timestamp.h>

uint64 decoded_count, found_count;

/* A decoded value, and how its datum is known again: values in a TOAST table by their numbers there, which do not
 * change as long as a statement can see them; others by their bytes. */
typedef struct KeptValue {
  dlist_node by_use;      /* in one of the lists below */
  struct KeptValue* next; /* of the same bucket */
  a3d_value* value;
  const char* type; /* a literal */
  Oid toast_table, toast_value;
  uint32 hash;
  bool is_of_pair;
  size_t size;
  uint64 memory; /* that decoding took, with the bytes */
  char bytes[FLEXIBLE_ARRAY_MEMBER];
} KeptValue;

/* Values of calls with one value are few: the row that a statement is at has them. Calls with two are conditions of
 * joins, too, in which the values of both sides come again and again: of these as many are kept as memory allows. */
#define MOST_SINGLE_VALUES 8
#define BUCKETS 32768
static KeptValue* buckets[BUCKETS];
static dlist_head singles = DLIST_STATIC_INIT(singles), of_pairs = DLIST_STATIC_INIT(of_pairs); /* used last: first */
static int single_count;
static uint64 memory_of_all;
static TimestampTz statement;

static void release(KeptValue* kept) {
  KeptValue** place = &buckets[kept->hash % BUCKETS];
  while (*place != kept) place = &(*place)->next;
  *place = kept->next;
  dlist_delete(&kept->by_use);
  if (!kept->is_of_pair) --single_count;
  memory_of_all -= kept->memory;
  a3d_release(kept->value);
  pfree(kept);
}

/* That was not used for the longest time; null if there is none. */
static KeptValue* oldest(dlist_head* list) {
  return dlist_is_empty(list) ? NULL : dlist_tail_element(KeptValue, by_use, list);
}

void release_kept_values(void) {
  while (oldest(&singles) != NULL) release(oldest(&singles));
  while (oldest(&of_pairs) != NULL) release(oldest(&of_pairs));
}

static void at_end_of_transaction(XactEvent event, void* given) {
  release_kept_values();
}

/* Values are kept within a statement: later ones may see others under the same numbers. */
static void begin_statement(void) {
  static bool is_registered;
  TimestampTz now = GetCurrentStatementStartTimestamp();
  if (!is_registered) {
    RegisterXactCallback(at_end_of_transaction, NULL);
    is_registered = true;
  }
  if (now != statement) release_kept_values();
  statement = now;
}

/* How a datum is known again. */
typedef struct KeyOfDatum {
  const char* type;
  Oid toast_table, toast_value;
  const char* bytes;
  size_t size;
  uint32 hash;
} KeyOfDatum;

/* Of the beginning of a value, which has a checksum of the rest. */
#define HASHED_BYTES 112

static KeyOfDatum key_of(struct varlena* datum, const char* type) {
  KeyOfDatum key = {.type = type};
  if (VARATT_IS_EXTERNAL_ONDISK(datum)) {
    struct varatt_external pointer;
    VARATT_EXTERNAL_GET_POINTER(pointer, datum);
    key.toast_table = pointer.va_toastrelid;
    key.toast_value = pointer.va_valueid;
    key.hash = hash_bytes_uint32(pointer.va_valueid);
  } else {
    struct varlena* bytes = PG_DETOAST_DATUM_PACKED(PointerGetDatum(datum));
    key.bytes = VARDATA_ANY(bytes);
    key.size = VARSIZE_ANY_EXHDR(bytes);
    key.hash = hash_bytes((const unsigned char*)key.bytes, Min(key.size, HASHED_BYTES));
  }
  return key;
}

static bool is_same(const KeptValue* kept, const KeyOfDatum* key) {
  return kept->hash == key->hash && kept->toast_value == key->toast_value && kept->toast_table == key->toast_table &&
         kept->size == key->size && strcmp(kept->type, key->type) == 0 &&
         (key->size == 0 || memcmp(kept->bytes, key->bytes, key->size) == 0);
}

static KeptValue* found(const KeyOfDatum* key) {
  KeptValue* kept = buckets[key->hash % BUCKETS];
  while (kept != NULL && !is_same(kept, key)) kept = kept->next;
  return kept;
}

static void keep(const KeyOfDatum* key, a3d_value* value, uint64 memory, bool is_of_pair) {
  const uint64 most = memory_limit() / 4, needed = memory + key->size + sizeof(KeptValue);
  dlist_head* list = is_of_pair ? &of_pairs : &singles;
  KeptValue* kept;
  if (needed > most) return;
  /* What operators attach to a value is not in `memory`; all that the library holds leaves half to the statement. */
  while (!dlist_is_empty(&of_pairs) || !dlist_is_empty(&singles)) {
    if (memory_of_all + needed <= most && a3d_memory_used(backend_session()) <= memory_limit() / 2) break;
    release(oldest(&singles) != NULL ? oldest(&singles) : oldest(&of_pairs));
  }
  if (!is_of_pair && single_count == MOST_SINGLE_VALUES) release(oldest(&singles));
  kept = MemoryContextAllocExtended(TopMemoryContext, sizeof(KeptValue) + key->size,
                                    MCXT_ALLOC_NO_OOM | MCXT_ALLOC_HUGE | MCXT_ALLOC_ZERO);
  if (kept == NULL) return;
  if (key->size > 0) memcpy(kept->bytes, key->bytes, key->size);
  kept->value = a3d_retain(value);
  kept->type = key->type;
  kept->toast_table = key->toast_table;
  kept->toast_value = key->toast_value;
  kept->hash = key->hash;
  kept->is_of_pair = is_of_pair;
  kept->size = key->size;
  kept->memory = needed;
  kept->next = buckets[key->hash % BUCKETS];
  buckets[key->hash % BUCKETS] = kept;
  dlist_push_head(list, &kept->by_use);
  memory_of_all += needed;
  if (!is_of_pair) ++single_count;
}

a3d_value* kept_value(Datum datum, const char* type, bool is_of_pair) {
  struct varlena* bytes;
  KeyOfDatum key;
  KeptValue* kept;
  a3d_value* value;
  uint64 before, after;
  if (is_stored_short(type)) {
    bytes = PG_DETOAST_DATUM_PACKED(datum);
    return value_of_bytes(type, VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes));
  }
  begin_statement();
  key = key_of((struct varlena*)DatumGetPointer(datum), type);
  kept = found(&key);
  if (kept != NULL) {
    ++found_count;
    dlist_move_head(kept->is_of_pair ? &of_pairs : &singles, &kept->by_use);
    return owned_value(a3d_retain(kept->value));
  }
  before = a3d_memory_used(backend_session());
  if (key.bytes != NULL) {
    value = value_of_bytes(type, key.bytes, key.size);
  } else {
    bytes = PG_DETOAST_DATUM_PACKED(datum);
    value = value_of_bytes(type, VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes));
    pfree(bytes);
  }
  after = a3d_memory_used(backend_session());
  keep(&key, value, after > before ? after - before : 0, is_of_pair);
  return value;
}

/* (decoded, found, memory): values that this backend has decoded, values that it found decoded, and the bytes that the
 * library holds now. */
PG_FUNCTION_INFO_V1(algebra3d_statistics);
Datum algebra3d_statistics(PG_FUNCTION_ARGS);
Datum algebra3d_statistics(PG_FUNCTION_ARGS) {
  a3d_session* session;
  TupleDesc description;
  Datum values[3];
  bool nulls[3] = {false, false, false};
  if (get_call_result_type(fcinfo, NULL, &description) != TYPEFUNC_COMPOSITE)
    ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED), errmsg("algebra3d_statistics gives a row"));
  session = backend_session();
  count_heap(true);
  values[0] = Int64GetDatum(decoded_count);
  values[1] = Int64GetDatum(found_count);
  values[2] = Int64GetDatum(a3d_memory_used(session));
  return HeapTupleGetDatum(heap_form_tuple(BlessTupleDesc(description), values, nulls));
}
