/* Decoded values that the running statement may read again. */
#include "module.h"

#include <access/detoast.h>
#include <access/htup_details.h>
#include <access/xact.h>
#include <funcapi.h>
#include <utils/memutils.h>
#include <utils/timestamp.h>

uint64 decoded_count, found_count;

/* A decoded value, and how its datum is known again: values in a TOAST table by their numbers there, which do not
 * change as long as a statement can see them; others by their bytes. */
typedef struct KeptValue {
  a3d_value* value; /* null: the place is free */
  const char* type; /* a literal */
  Oid toast_table, toast_value;
  char* bytes;
  size_t size;
  uint64 memory; /* that decoding took */
  uint64 used;   /* greater for later uses */
} KeptValue;

#define PLACES 8
static KeptValue kept[PLACES];
static uint64 uses;
static TimestampTz statement;

static void release(KeptValue* place) {
  a3d_release(place->value);
  if (place->bytes != NULL) pfree(place->bytes);
  memset(place, 0, sizeof *place);
}

void release_kept_values(void) {
  for (int i = 0; i < PLACES; ++i) release(&kept[i]);
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

/* How a datum is known again, without a value. */
static KeptValue key_of(struct varlena* datum, const char* type) {
  KeptValue key = {0};
  key.type = type;
  if (VARATT_IS_EXTERNAL_ONDISK(datum)) {
    struct varatt_external pointer;
    VARATT_EXTERNAL_GET_POINTER(pointer, datum);
    key.toast_table = pointer.va_toastrelid;
    key.toast_value = pointer.va_valueid;
  }
  return key;
}

static bool is_same(const KeptValue* place, const KeptValue* key) {
  if (place->value == NULL || strcmp(place->type, key->type) != 0) return false;
  if (key->toast_value != InvalidOid)
    return place->toast_value == key->toast_value && place->toast_table == key->toast_table;
  return place->toast_value == InvalidOid && place->size == key->size &&
         memcmp(place->bytes, key->bytes, key->size) == 0;
}

static KeptValue* found(const KeptValue* key) {
  for (int i = 0; i < PLACES; ++i)
    if (is_same(&kept[i], key)) return &kept[i];
  return NULL;
}

/* A free place; null if there is none. */
static KeptValue* free_place(void) {
  for (int i = 0; i < PLACES; ++i)
    if (kept[i].value == NULL) return &kept[i];
  return NULL;
}

/* The place of the value that was not used for the longest time; null if there are no values. */
static KeptValue* oldest(void) {
  KeptValue* result = NULL;
  for (int i = 0; i < PLACES; ++i)
    if (kept[i].value != NULL && (result == NULL || kept[i].used < result->used)) result = &kept[i];
  return result;
}

static uint64 memory_of_all(void) {
  uint64 sum = 0;
  for (int i = 0; i < PLACES; ++i) sum += kept[i].memory;
  return sum;
}

static void keep(KeptValue key, a3d_value* value) {
  const uint64 most = memory_limit() / 4;
  KeptValue* place;
  char* copy = NULL;
  if (key.memory + key.size > most) return;
  if (key.toast_value == InvalidOid) {
    copy = MemoryContextAllocExtended(TopMemoryContext, key.size + 1, MCXT_ALLOC_NO_OOM | MCXT_ALLOC_HUGE);
    if (copy == NULL) return;
    memcpy(copy, key.bytes, key.size);
    key.memory += key.size;
  }
  key.bytes = copy;
  while ((place = oldest()) != NULL && (free_place() == NULL || memory_of_all() + key.memory > most)) release(place);
  place = free_place();
  key.value = a3d_retain(value);
  key.used = ++uses;
  *place = key;
}

a3d_value* kept_value(Datum datum, const char* type) {
  struct varlena* given = (struct varlena*)DatumGetPointer(datum);
  struct varlena* bytes = NULL;
  KeptValue key;
  KeptValue* place;
  a3d_value* value;
  uint64 before, after;
  begin_statement();
  key = key_of(given, type);
  if (key.toast_value == InvalidOid) {
    bytes = PG_DETOAST_DATUM_PACKED(datum);
    key.bytes = VARDATA_ANY(bytes);
    key.size = VARSIZE_ANY_EXHDR(bytes);
    if (is_stored_short(type)) return value_of_bytes(type, key.bytes, key.size);
  }
  place = found(&key);
  if (place != NULL) {
    ++found_count;
    place->used = ++uses;
    return owned_value(a3d_retain(place->value));
  }
  if (bytes == NULL) bytes = PG_DETOAST_DATUM_PACKED(datum);
  before = a3d_memory_used(backend_session());
  value = value_of_bytes(type, VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes));
  after = a3d_memory_used(backend_session());
  key.memory = after > before ? after - before : 0;
  keep(key, value);
  if ((Pointer)bytes != DatumGetPointer(datum)) pfree(bytes);
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
