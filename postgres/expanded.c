/* Results of calls as expanded objects: a call that takes one finds the value itself, and the binary form is made only
 * when the value is stored or sent. */
#include "module.h"

#include <utils/expandeddatum.h>
#include <utils/memutils.h>

#define MAGIC 1094926180 /* tells ours from those of others */

typedef struct ExpandedValue {
  ExpandedObjectHeader header;
  int magic;
  a3d_value* value;
  a3d_bytes flat; /* the binary form, once it was asked for */
  MemoryContextCallback callback;
} ExpandedValue;

typedef struct Encoding {
  a3d_session* session;
  const a3d_value* value;
  a3d_bytes* result;
} Encoding;

static a3d_status encode(void* given) {
  Encoding* e = given;
  return a3d_encode(e->session, e->value, e->result);
}

/* What is stored can be written as base64, which is a text of 1 GB at most. */
#define MOST_BYTES ((MaxAllocSize - 1) / 4 * 3 - VARHDRSZ)

/* Values with more points or triangles are encoded aside. */
#define MOST_ELEMENTS_AT_ONCE 5000

static Size flat_size(ExpandedObjectHeader* header) {
  ExpandedValue* self = (ExpandedValue*)header;
  if (self->flat.owner == NULL) {
    Encoding encoding = {backend_session(), self->value, &self->flat};
    check_status(element_count(self->value) > MOST_ELEMENTS_AT_ONCE ? run_aside(encode, &encoding) : encode(&encoding));
  }
  if (self->flat.size > MOST_BYTES)
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
            errmsg("a value of %zu bytes cannot be stored, at most %zu", self->flat.size, MOST_BYTES),
            errhint("Its base64 would be longer than a text can be."));
  return self->flat.size + VARHDRSZ;
}

static void flatten(ExpandedObjectHeader* header, void* place, Size size) {
  ExpandedValue* self = (ExpandedValue*)header;
  Assert(size == self->flat.size + VARHDRSZ);
  SET_VARSIZE(place, size);
  memcpy(VARDATA(place), self->flat.data, self->flat.size);
}

static const ExpandedObjectMethods methods = {flat_size, flatten};

static void release(void* given) {
  ExpandedValue* self = given;
  a3d_release(self->value);
  if (self->flat.owner != NULL) a3d_free_bytes(&self->flat);
}

Datum expanded_datum(a3d_value* value) {
  MemoryContext own = AllocSetContextCreate(CurrentMemoryContext, "algebra3d value", ALLOCSET_SMALL_SIZES);
  ExpandedValue* self = MemoryContextAllocZero(own, sizeof *self);
  EOH_init_header(&self->header, &methods, own);
  self->magic = MAGIC;
  self->value = a3d_retain(value);
  self->callback.func = release;
  self->callback.arg = self;
  MemoryContextRegisterResetCallback(own, &self->callback);
  return EOHPGetRWDatum(&self->header);
}

a3d_value* expanded_value(Datum datum) {
  ExpandedValue* self;
  if (!VARATT_IS_EXTERNAL_EXPANDED(DatumGetPointer(datum))) return NULL;
  self = (ExpandedValue*)DatumGetEOHP(datum);
  return self->header.eoh_methods == &methods && self->magic == MAGIC ? self->value : NULL;
}
