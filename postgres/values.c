/* Values of the library as data of PostgreSQL: the binary form in a varlena, base64 or a value list as text. */
#include "module.h"

#include <access/htup_details.h>
#include <catalog/pg_type.h>
#include <common/base64.h>
#include <common/hashfn.h>
#include <libpq/pqformat.h>
#include <mb/pg_wchar.h>
#include <miscadmin.h>
#include <utils/builtins.h>
#include <utils/memutils.h>
#include <utils/syscache.h>

#include "settings.h"

/* ---- The binary form ---- */

bool is_stored_short(const char* type) {
  return strcmp(type, "point3d") == 0 || strcmp(type, "vector3d") == 0 || strcmp(type, "plane3d") == 0 ||
         strcmp(type, "rect3") == 0;
}

typedef struct Decoding {
  a3d_session* session;
  const char* type;
  const char* bytes;
  size_t size;
  int is_trusted;
  a3d_value* result;
} Decoding;

static a3d_status decode(void* given) {
  Decoding* d = given;
  return a3d_decode(d->session, d->type, d->bytes, d->size, d->is_trusted, &d->result);
}

/* What is decoded in less than a millisecond needs no thread of its own. */
#define MOST_BYTES_AT_ONCE 65536

/* Bytes of a client, whose errors have a SQL state of their own, are proved; those of the server (state 0) are not. */
static a3d_value* decoded(const char* type, const char* bytes, size_t size, int sql_state) {
  Decoding decoding = {backend_session(), type, bytes, size, sql_state == 0, NULL};
  const size_t most = sql_state == 0 ? MOST_BYTES_AT_ONCE : MOST_BYTES_AT_ONCE / 16;
  a3d_status status = size <= most ? decode(&decoding) : run_aside(decode, &decoding);
  if (sql_state == 0)
    check_status(status);
  else
    check_given(status, sql_state);
  ++decoded_count;
  return owned_value(decoding.result);
}

a3d_value* value_of_bytes(const char* type, const char* bytes, size_t size) {
  a3d_value* result = NULL;
  if (!is_stored_short(type)) return decoded(type, bytes, size, 0);
  check_status(a3d_decode_body(backend_session(), type, bytes, size, 1, &result));
  return owned_value(result);
}

const char* name_of_type(Oid type, MemoryContext memory) {
  HeapTuple tuple = SearchSysCache1(TYPEOID, ObjectIdGetDatum(type));
  char* name;
  if (!HeapTupleIsValid(tuple)) elog(ERROR, "there is no type %u", type);
  name = MemoryContextStrdup(memory, NameStr(((Form_pg_type)GETSTRUCT(tuple))->typname));
  ReleaseSysCache(tuple);
  return name;
}

size_t element_count(const a3d_value* value) {
  static const char* const types[] = {"points3d", "region", "surface3d", "volume3d", "mesh3d"};
  const char* type = a3d_type_of(value);
  a3d_header header;
  for (size_t i = 0; i < lengthof(types); ++i)
    if (strcmp(type, types[i]) == 0)
      return a3d_header_of(backend_session(), value, &header) == A3D_OK ? header.count : 0;
  return 0;
}

/* Whether reading, printing or comparing the value may take more than some milliseconds. */
static bool is_large(const a3d_value* value) {
  return element_count(value) > 1000;
}

/* ---- Plain values ---- */

static a3d_value* argument(Datum datum, const char* type, bool is_of_pair) {
  a3d_session* session = backend_session();
  a3d_value* result = NULL;
  if (strcmp(type, "int") == 0) {
    check_status(a3d_make_int(session, DatumGetInt64(datum), &result));
  } else if (strcmp(type, "real") == 0) {
    check_arguments(a3d_make_real(session, DatumGetFloat8(datum), &result));
  } else if (strcmp(type, "bool") == 0) {
    check_status(a3d_make_bool(session, DatumGetBool(datum), &result));
  } else if (strcmp(type, "text") == 0 || strcmp(type, "string") == 0) {
    text* given = DatumGetTextPP(datum);
    char* utf8 = pg_server_to_any(VARDATA_ANY(given), VARSIZE_ANY_EXHDR(given), PG_UTF8);
    size_t size = utf8 == VARDATA_ANY(given) ? VARSIZE_ANY_EXHDR(given) : strlen(utf8);
    check_status(a3d_make_text(session, type, utf8, size, &result));
  } else if (strcmp(type, "bytes") == 0) {
    bytea* given = DatumGetByteaPP(datum);
    check_status(a3d_make_bytes(session, VARDATA_ANY(given), VARSIZE_ANY_EXHDR(given), &result));
  } else {
    result = expanded_value(datum);
    return result != NULL ? result : kept_value(datum, type, is_of_pair);
  }
  return owned_value(result);
}

a3d_value* value_of_datum(Datum datum, const char* type) {
  return argument(datum, type, false);
}

a3d_value* value_of_pair(Datum datum, const char* type) {
  return argument(datum, type, true);
}

/* A copy of bytes that the library made, which are freed, behind so many bytes of room. */
static char* taken_bytes(a3d_bytes* bytes, size_t room) {
  char* result =
      MemoryContextAllocExtended(CurrentMemoryContext, room + bytes->size + 1, MCXT_ALLOC_NO_OOM | MCXT_ALLOC_HUGE);
  if (result != NULL) memcpy(result + room, bytes->data, bytes->size + 1);
  a3d_free_bytes(bytes);
  if (result == NULL) ereport(ERROR, errcode(ERRCODE_OUT_OF_MEMORY), errmsg("out of memory"));
  return result;
}

Datum varlena_of_bytes(a3d_bytes* bytes) {
  size_t size = VARHDRSZ + bytes->size;
  char* result;
  if (size > MaxAllocSize) {
    a3d_free_bytes(bytes);
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
            errmsg("%zu bytes cannot be stored, at most %zu", size - VARHDRSZ, MaxAllocSize - VARHDRSZ));
  }
  result = taken_bytes(bytes, VARHDRSZ);
  SET_VARSIZE(result, size);
  return PointerGetDatum(result);
}

static Datum short_datum(a3d_value* value) {
  a3d_bytes bytes;
  check_status(a3d_encode_body(backend_session(), value, &bytes));
  return varlena_of_bytes(&bytes);
}

Datum datum_of_value(a3d_value* value) {
  const char* type = a3d_type_of(value);
  if (strcmp(type, "int") == 0) return Int64GetDatum(a3d_int_of(value));
  if (strcmp(type, "real") == 0) return Float8GetDatum(a3d_real_of(value));
  if (strcmp(type, "bool") == 0) return BoolGetDatum(a3d_bool_of(value));
  if (strcmp(type, "text") == 0 || strcmp(type, "string") == 0) {
    size_t size;
    const char* characters = a3d_text_of(value, &size);
    char* converted = pg_any_to_server(characters, size, PG_UTF8);
    return PointerGetDatum(converted == characters ? cstring_to_text_with_len(characters, size)
                                                   : cstring_to_text(converted));
  }
  if (strcmp(type, "bytes") == 0) {
    size_t size;
    const char* bytes = a3d_bytes_of(value, &size);
    if (size > MaxAllocSize - VARHDRSZ)
      ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED), errmsg("%zu bytes are more than a bytea can have", size));
    /* A bytea is a varlena like a text. */
    return PointerGetDatum(cstring_to_text_with_len(bytes, size));
  }
  return is_stored_short(type) ? short_datum(value) : expanded_datum(value);
}

/* ---- Text and messages ---- */

typedef struct Parsing {
  a3d_session* session;
  const char* type;
  const char* text;
  size_t size;
  a3d_value* result;
} Parsing;

static a3d_status parse(void* given) {
  Parsing* p = given;
  return a3d_parse(p->session, p->type, p->text, p->size, &p->result);
}

static a3d_value* parsed(const char* type, const char* given) {
  size_t size = strlen(given);
  char* utf8 = pg_server_to_any(given, size, PG_UTF8);
  Parsing parsing = {backend_session(), type, utf8, utf8 == given ? size : strlen(utf8), NULL};
  check_status(parsing.size > MOST_BYTES_AT_ONCE / 4 ? run_aside(parse, &parsing) : parse(&parsing));
  return owned_value(parsing.result);
}

/* Bytes that were proved to be a value are stored as they came. */
static Datum datum_of_proved(a3d_value* value, const char* type, const char* bytes, size_t size) {
  char* result;
  if (is_stored_short(type)) return datum_of_value(value);
  if (size > MaxAllocSize - VARHDRSZ)
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED), errmsg("%zu bytes are too many for a value", size));
  result = palloc(VARHDRSZ + size);
  SET_VARSIZE(result, VARHDRSZ + size);
  memcpy(VARDATA(result), bytes, size);
  return PointerGetDatum(result);
}

Datum read_value(FunctionCallInfo fcinfo, const char* type) {
  const char* given = PG_GETARG_CSTRING(0);
  char* bytes = NULL;
  int size = 0;
  a3d_value* value;
  /* The server has copied a large text without a look at them. */
  CHECK_FOR_INTERRUPTS();
  while (*given == ' ' || *given == '\n' || *given == '\t' || *given == '\r') ++given;
  if (*given == '(') {
    value = parsed(type, given);
  } else {
    size = pg_b64_dec_len(strlen(given));
    bytes = palloc(size);
    size = pg_b64_decode(given, strlen(given), bytes, size);
    if (size < 0)
      ereport(ERROR, errcode(ERRCODE_INVALID_TEXT_REPRESENTATION), errmsg("invalid text for type %s", type),
              errhint("Expected a value list, which begins with a parenthesis, or base64; a missing value is NULL."));
    value = decoded(type, bytes, size, ERRCODE_INVALID_TEXT_REPRESENTATION);
  }
  if (!a3d_is_defined(value)) {
    const char* reason = a3d_reason(backend_session());
    char* detail = pg_any_to_server(pstrdup(reason), strlen(reason), PG_UTF8);
    a3d_clear_notices(backend_session());
    ereport(ERROR, errcode(ERRCODE_INVALID_TEXT_REPRESENTATION), errmsg("invalid value for type %s", type),
            *detail != '\0' ? errdetail("%s", detail) : 0, errhint("A missing value is NULL."));
  }
  show_notices();
  return bytes != NULL ? datum_of_proved(value, type, bytes, size) : datum_of_value(value);
}

typedef struct Printing {
  a3d_session* session;
  const a3d_value* value;
  a3d_bytes bytes;
} Printing;

static a3d_status print(void* given) {
  Printing* p = given;
  return a3d_print(p->session, p->value, &p->bytes);
}

static a3d_bytes printed(a3d_value* value) {
  Printing printing = {backend_session(), value, {0}};
  check_status(is_large(value) ? run_aside(print, &printing) : print(&printing));
  if (printing.bytes.size >= MaxAllocSize - VARHDRSZ) {
    a3d_free_bytes(&printing.bytes);
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED), errmsg("a value list of 1 GB or more is no text"),
            errhint("Set algebra3d.output to codec."));
  }
  return printing.bytes;
}

static char* list_text(a3d_value* value) {
  a3d_bytes bytes = printed(value);
  size_t size = bytes.size;
  return pg_any_to_server(taken_bytes(&bytes, 0), size, PG_UTF8);
}

/* The binary form of a datum, with header and checksum also for types that are stored without. */
static struct varlena* framed_bytes(Datum datum, const char* type) {
  a3d_bytes bytes;
  if (!is_stored_short(type)) return PG_DETOAST_DATUM_PACKED(datum);
  check_status(a3d_encode(backend_session(), value_of_datum(datum, type), &bytes));
  return (struct varlena*)DatumGetPointer(varlena_of_bytes(&bytes));
}

Datum write_value(FunctionCallInfo fcinfo, const char* type) {
  struct varlena* bytes;
  char* result;
  int size;
  if (setting_output == OUTPUT_LIST) PG_RETURN_CSTRING(list_text(value_of_datum(PG_GETARG_DATUM(0), type)));
  bytes = framed_bytes(PG_GETARG_DATUM(0), type);
  size = pg_b64_enc_len(VARSIZE_ANY_EXHDR(bytes));
  result = palloc(size + 1);
  size = pg_b64_encode(VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes), result, size);
  result[size] = '\0';
  PG_RETURN_CSTRING(result);
}

Datum receive_value(FunctionCallInfo fcinfo, const char* type) {
  StringInfo message = (StringInfo)PG_GETARG_POINTER(0);
  int size = message->len - message->cursor;
  const char* bytes = pq_getmsgbytes(message, size);
  a3d_value* value = decoded(type, bytes, size, ERRCODE_INVALID_BINARY_REPRESENTATION);
  if (!a3d_is_defined(value))
    ereport(ERROR, errcode(ERRCODE_INVALID_BINARY_REPRESENTATION), errmsg("the bytes are an undefined %s", type),
            errhint("A missing value is NULL."));
  return datum_of_proved(value, type, bytes, size);
}

Datum send_value(FunctionCallInfo fcinfo, const char* type) {
  struct varlena* bytes = framed_bytes(PG_GETARG_DATUM(0), type);
  StringInfoData message;
  pq_begintypsend(&message);
  pq_sendbytes(&message, VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes));
  PG_RETURN_BYTEA_P(pq_endtypsend(&message));
}

Datum text_of_value(FunctionCallInfo fcinfo, const char* type) {
  a3d_value* value = value_of_datum(PG_GETARG_DATUM(0), type);
  a3d_bytes bytes;
  /* A large text is copied once. */
  if (GetDatabaseEncoding() != PG_UTF8) PG_RETURN_TEXT_P(cstring_to_text(list_text(value)));
  bytes = printed(value);
  return varlena_of_bytes(&bytes);
}

/* ---- Boxes ---- */

/* A box, or a point of doubles (docs/file_format.md), without making a value of it. */
static bool is_plain_box(Datum datum, const char* type, a3d_header* result) {
  struct varlena* bytes;
  double numbers[6];
  const bool is_box = strcmp(type, "rect3") == 0;
  if (!is_box && strcmp(type, "point3d") != 0) return false;
  bytes = PG_DETOAST_DATUM_PACKED(datum);
  if (VARSIZE_ANY_EXHDR(bytes) != (is_box ? 6 : 3) * sizeof(double) + (is_box ? 0 : 1)) return false;
  if (!is_box && *VARDATA_ANY(bytes) != 0) return false;
  memcpy(numbers, VARDATA_ANY(bytes) + (is_box ? 0 : 1), (is_box ? 6 : 3) * sizeof(double));
  for (int axis = 0; axis < 3; ++axis) {
    result->min[axis] = numbers[is_box ? 2 * axis : axis];
    result->max[axis] = numbers[is_box ? 2 * axis + 1 : axis];
  }
  result->count = 1;
  return true;
}

a3d_header header_of_datum(Datum datum, const char* type) {
  a3d_header result;
  const a3d_value* value;
  if (is_plain_box(datum, type, &result)) return result;
  value = is_stored_short(type) ? value_of_datum(datum, type) : expanded_value(datum);
  if (value != NULL) {
    check_status(a3d_header_of(backend_session(), value, &result));
  } else {
    /* The beginning alone is read. */
    struct varlena* bytes = PG_DETOAST_DATUM_SLICE(datum, 0, A3D_HEADER_BYTES);
    check_status(a3d_header_of_bytes(backend_session(), VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes), &result));
  }
  return result;
}

/* The body of the binary form is six doubles (docs/file_format.md). */
Datum datum_of_box(const a3d_header* header) {
  double bounds[6];
  char* result = palloc(VARHDRSZ + sizeof bounds);
  for (int axis = 0; axis < 3; ++axis) {
    bounds[2 * axis] = header->min[axis];
    bounds[2 * axis + 1] = header->max[axis];
  }
  SET_VARSIZE(result, VARHDRSZ + sizeof bounds);
  memcpy(VARDATA(result), bounds, sizeof bounds);
  return PointerGetDatum(result);
}

Datum boxes_meet(FunctionCallInfo fcinfo, const char* type_a, const char* type_b) {
  a3d_header a = header_of_datum(PG_GETARG_DATUM(0), type_a), b = header_of_datum(PG_GETARG_DATUM(1), type_b);
  bool meet = true;
  for (int axis = 0; axis < 3; ++axis) meet = meet && a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis];
  PG_RETURN_BOOL(meet);
}

/* ---- Order ---- */

/* Sorting and hashing call these functions again and again in one memory context, so what they take is released by
 * them: it is allocated between enter_scratch and leave_scratch. After an error the next call releases it. */
static MemoryContext scratch;

static MemoryContext enter_scratch(void) {
  if (scratch == NULL)
    scratch = AllocSetContextCreate(TopMemoryContext, "algebra3d comparison", ALLOCSET_DEFAULT_SIZES);
  MemoryContextReset(scratch);
  return MemoryContextSwitchTo(scratch);
}

static void leave_scratch(MemoryContext before) {
  MemoryContextSwitchTo(before);
  MemoryContextReset(scratch);
}

typedef struct Comparing {
  a3d_session* session;
  const a3d_value *a, *b;
  int order;
  uint64_t hash;
} Comparing;

static a3d_status compare(void* given) {
  Comparing* c = given;
  return a3d_compare(c->session, c->a, c->b, &c->order);
}

static a3d_status hash(void* given) {
  Comparing* c = given;
  return a3d_hash(c->session, c->a, &c->hash);
}

static int compared(FunctionCallInfo fcinfo, const char* type) {
  MemoryContext before = enter_scratch();
  Comparing comparing = {0};
  comparing.a = value_of_pair(PG_GETARG_DATUM(0), type);
  comparing.b = value_of_pair(PG_GETARG_DATUM(1), type);
  comparing.session = backend_session();
  check_status(is_large(comparing.a) && is_large(comparing.b) ? run_aside(compare, &comparing) : compare(&comparing));
  leave_scratch(before);
  return comparing.order;
}

Datum compare_values(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_INT32(compared(fcinfo, type));
}

/* Different boxes are found without the rest of the values. Equal solids may have different numbers of triangles. */
static bool have_equal_boxes(FunctionCallInfo fcinfo, const char* type) {
  MemoryContext before = enter_scratch();
  a3d_header a = header_of_datum(PG_GETARG_DATUM(0), type), b = header_of_datum(PG_GETARG_DATUM(1), type);
  bool are_equal = true;
  for (int axis = 0; axis < 3; ++axis)
    are_equal = are_equal && a.min[axis] == b.min[axis] && a.max[axis] == b.max[axis];
  leave_scratch(before);
  return are_equal;
}

static bool are_equal(FunctionCallInfo fcinfo, const char* type) {
  return (is_stored_short(type) || have_equal_boxes(fcinfo, type)) && compared(fcinfo, type) == 0;
}

Datum compare_equal(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(are_equal(fcinfo, type));
}

Datum compare_not_equal(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(!are_equal(fcinfo, type));
}

Datum compare_less(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(compared(fcinfo, type) < 0);
}

Datum compare_not_greater(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(compared(fcinfo, type) <= 0);
}

Datum compare_greater(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(compared(fcinfo, type) > 0);
}

Datum compare_not_less(FunctionCallInfo fcinfo, const char* type) {
  PG_RETURN_BOOL(compared(fcinfo, type) >= 0);
}

Datum hash_value(FunctionCallInfo fcinfo, const char* type) {
  MemoryContext before = enter_scratch();
  Comparing comparing = {0};
  comparing.a = value_of_datum(PG_GETARG_DATUM(0), type);
  comparing.session = backend_session();
  check_status(is_large(comparing.a) ? run_aside(hash, &comparing) : hash(&comparing));
  leave_scratch(before);
  PG_RETURN_INT32((int32)(comparing.hash ^ (comparing.hash >> 32)));
}

/* For partitions by hash. Its lower half is that of hash_value if the seed is 0. */
Datum hash_value_extended(FunctionCallInfo fcinfo, const char* type) {
  const uint64 seed = PG_GETARG_INT64(1);
  const uint32 hashed = DatumGetUInt32(hash_value(fcinfo, type));
  PG_RETURN_UINT64(seed == 0 ? hashed : DatumGetUInt64(hash_uint32_extended(hashed, seed)));
}
