/* Functions of SQL that are functions of the library. */
#include "module.h"

#include <math.h>

#include <access/detoast.h>
#include <funcapi.h>
#include <miscadmin.h>
#include <utils/memutils.h>
#include <utils/tuplestore.h>

typedef struct Call {
  a3d_session* session;
  const a3d_function* function;
  a3d_value* arguments[8];
  size_t count;
  a3d_value* result;
  a3d_rows* rows;
  a3d_value** cells;
} Call;

static a3d_status call(void* given) {
  Call* c = given;
  return a3d_call(c->session, c->function, c->arguments, c->count, &c->result);
}

static a3d_status open_rows(void* given) {
  Call* c = given;
  return a3d_open_rows(c->session, c->function, c->arguments, c->count, &c->rows);
}

static a3d_status next_row(void* given) {
  Call* c = given;
  return a3d_next_row(c->session, c->rows, c->cells);
}

/* The function of the library, found at the first call of a query. */
static const a3d_function* function_of(FunctionCallInfo fcinfo, const FunctionKey* key) {
  const a3d_function* function = fcinfo->flinfo->fn_extra;
  if (function == NULL) {
    check_status(a3d_find(backend_session(), key->name, key->types, key->parameter_count, &function));
    fcinfo->flinfo->fn_extra = (void*)function;
  }
  return function;
}

/* Arguments of more points and triangles together make a call of linear cost long. */
#define MOST_ELEMENTS_AT_ONCE 1000

/* The most elements that an argument may ask for: a number of corners n makes some n * n triangles, n steps of a
 * subdivision make 4 to the power of n of each face. */
static double elements_asked_for(int64 number, size_t given) {
  if (number <= 0) return 0;
  return Max((double)number * (double)number, ldexp((double)given, (int)Min(2 * number, 1000)));
}

/* Texts and bytes that take more than about a millisecond to read. */
static bool is_long_text(Datum datum, const char* type) {
  const bool is_text = strcmp(type, "text") == 0 || strcmp(type, "string") == 0 || strcmp(type, "bytes") == 0;
  return is_text && toast_raw_datum_size(datum) > 16384;
}

/* Types whose values are decoded with some effort. */
static bool has_stored_form(const char* type) {
  return strcmp(type, "volume3d") == 0 || strcmp(type, "surface3d") == 0 || strcmp(type, "mesh3d") == 0 ||
         strcmp(type, "points3d") == 0 || strcmp(type, "region") == 0;
}

/* Fills in the arguments; whether the call may take long. */
static bool prepare(Call* c, FunctionCallInfo fcinfo, const FunctionKey* key) {
  size_t elements = 0;
  int64 greatest = 0;
  bool is_long_by_text = false;
  const bool is_of_pair = key->parameter_count > 1 && has_stored_form(key->types[0]) && has_stored_form(key->types[1]);
  c->session = backend_session();
  c->function = function_of(fcinfo, key);
  c->count = key->parameter_count;
  for (int i = 0; i < key->parameter_count; ++i) {
    if (PG_ARGISNULL(i)) {
      a3d_value* undefined = NULL;
      check_status(a3d_make_undefined(c->session, key->types[i], &undefined));
      c->arguments[i] = owned_value(undefined);
      continue;
    }
    c->arguments[i] = (is_of_pair ? value_of_pair : value_of_datum)(PG_GETARG_DATUM(i), key->types[i]);
    if (is_long_text(PG_GETARG_DATUM(i), key->types[i])) is_long_by_text = true;
    if (strcmp(key->types[i], "int") == 0) greatest = Max(greatest, DatumGetInt64(PG_GETARG_DATUM(i)));
    elements += element_count(c->arguments[i]);
  }
  return c->function->cost > A3D_LINEAR ||
         (c->function->cost == A3D_LINEAR &&
          (is_long_by_text || (double)elements + elements_asked_for(greatest, elements) > MOST_ELEMENTS_AT_ONCE));
}

/* size, is_empty and bbox of a stored value are in its first bytes. */
static bool is_answered_by_header(FunctionCallInfo fcinfo, const FunctionKey* key, Datum* result) {
  a3d_header header;
  const bool is_size = strcmp(key->name, "size") == 0;
  const bool is_emptiness = strcmp(key->name, "is_empty") == 0 || strcmp(key->name, "isempty") == 0;
  const bool is_box = strcmp(key->name, "bbox") == 0;
  if (key->parameter_count != 1 || !(is_size || is_emptiness || is_box)) return false;
  if (strcmp(key->types[0], "points3d") != 0 && strcmp(key->types[0], "surface3d") != 0 &&
      strcmp(key->types[0], "volume3d") != 0 && strcmp(key->types[0], "mesh3d") != 0)
    return false;
  if (PG_ARGISNULL(0) || expanded_value(PG_GETARG_DATUM(0)) != NULL) return false;
  header = header_of_datum(PG_GETARG_DATUM(0), key->types[0]);
  if (is_box) {
    if (header.min[0] > header.max[0]) return false; /* undefined, with a reason */
    *result = datum_of_box(&header);
  } else {
    *result = is_size ? Int64GetDatum(header.count) : BoolGetDatum(header.count == 0);
  }
  return true;
}

Datum call_scalar(FunctionCallInfo fcinfo, const FunctionKey* key) {
  Call c = {0};
  a3d_status status;
  Datum answered;
  CHECK_FOR_INTERRUPTS();
  if (is_answered_by_header(fcinfo, key, &answered)) return answered;
  status = prepare(&c, fcinfo, key) ? run_aside(call, &c) : call(&c);
  check_status(status);
  owned_value(c.result);
  show_notices();
  if (!a3d_is_defined(c.result)) PG_RETURN_NULL();
  return datum_of_value(c.result);
}

static void close_rows(void* rows) {
  a3d_close_rows(rows);
}

Datum call_table(FunctionCallInfo fcinfo, const FunctionKey* key) {
  ReturnSetInfo* result;
  Call c = {0};
  bool is_long;
  MemoryContext row_memory, before;
  MemoryContextCallback* closing;
  Datum* values;
  bool* nulls;
  /* Rows of plain values have no composite type. */
  InitMaterializedSRF(fcinfo, MAT_SRF_USE_EXPECTED_DESC);
  result = (ReturnSetInfo*)fcinfo->resultinfo;
  is_long = prepare(&c, fcinfo, key);
  closing = palloc0(sizeof *closing);
  closing->func = close_rows;
  values = palloc(c.function->column_count * sizeof *values);
  nulls = palloc(c.function->column_count * sizeof *nulls);
  c.cells = palloc(c.function->column_count * sizeof *c.cells);
  row_memory = AllocSetContextCreate(CurrentMemoryContext, "algebra3d row", ALLOCSET_DEFAULT_SIZES);
  check_status(is_long ? run_aside(open_rows, &c) : open_rows(&c));
  closing->arg = c.rows;
  MemoryContextRegisterResetCallback(CurrentMemoryContext, closing);
  for (;;) {
    a3d_status status;
    CHECK_FOR_INTERRUPTS();
    status = is_long ? run_aside(next_row, &c) : next_row(&c);
    if (status == A3D_END) break;
    check_status(status);
    before = MemoryContextSwitchTo(row_memory);
    for (size_t i = 0; i < c.function->column_count; ++i) owned_value(c.cells[i]);
    for (size_t i = 0; i < c.function->column_count; ++i) {
      nulls[i] = !a3d_is_defined(c.cells[i]);
      values[i] = nulls[i] ? (Datum)0 : datum_of_value(c.cells[i]);
    }
    MemoryContextSwitchTo(before);
    tuplestore_putvalues(result->setResult, result->setDesc, values, nulls);
    MemoryContextReset(row_memory);
  }
  show_notices();
  return (Datum)0;
}

/* ---- Aggregates ---- */

typedef struct State {
  const a3d_function* function;
  a3d_aggregate* aggregate;
  a3d_session* session;
  a3d_value* value;
  a3d_value* result;
  size_t held; /* bytes of the values that the run holds, about */
  void* room;  /* stands for them */
  size_t room_size;
} State;

static void close_aggregate(void* aggregate) {
  a3d_close_aggregate(aggregate);
}

static a3d_status finish(void* given) {
  State* s = given;
  return a3d_finish(s->session, s->aggregate, &s->result);
}

/* The memory of a running aggregate. */
static MemoryContext memory_of_aggregate(FunctionCallInfo fcinfo) {
  MemoryContext memory;
  if (!AggCheckCallContext(fcinfo, &memory))
    ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED),
            errmsg("a function of an aggregate was called outside of one"));
  return memory;
}

/* A state without a run, and the callback that will close its run. */
static State* new_state(MemoryContext memory, MemoryContextCallback** closing) {
  State* state = MemoryContextAllocZero(memory, sizeof *state);
  *closing = MemoryContextAllocZero(memory, sizeof **closing);
  (*closing)->func = close_aggregate;
  state->session = backend_session();
  return state;
}

static void owns_run(MemoryContext memory, State* state, MemoryContextCallback* closing) {
  closing->arg = state->aggregate;
  MemoryContextRegisterResetCallback(memory, closing);
}

static State* opened_state(MemoryContext memory, const a3d_function* function) {
  MemoryContextCallback* closing;
  State* state = new_state(memory, &closing);
  state->function = function;
  check_status(a3d_open_aggregate(state->session, function, &state->aggregate));
  owns_run(memory, state, closing);
  return state;
}

#define BYTES_OF_ELEMENT 64
#define BYTES_OF_VALUE 512

/* Whether the result may take long. */
static bool is_long(const State* state) {
  return state->held > BYTES_OF_ELEMENT * MOST_ELEMENTS_AT_ONCE;
}

/* HashAggregate goes on in temporary files when its memory context has grown enough. What the library holds is not in
 * there, so room for it, which is never touched, stands for it. */
static void account_for(State* state, MemoryContext memory, const a3d_value* value) {
  if (state->function->keeps_values == 0) return;
  state->held += BYTES_OF_VALUE + BYTES_OF_ELEMENT * element_count(value);
  if (state->held <= state->room_size) return;
  state->room_size = Max(state->held, 2 * state->room_size);
  state->room = state->room == NULL ? MemoryContextAllocHuge(memory, state->room_size)
                                    : repalloc_huge(state->room, state->room_size);
}

Datum step_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key) {
  MemoryContext memory = memory_of_aggregate(fcinfo);
  State* state = PG_ARGISNULL(0) ? NULL : (State*)PG_GETARG_POINTER(0);
  if (state == NULL) state = opened_state(memory, function_of(fcinfo, key));
  if (!PG_ARGISNULL(1)) {
    a3d_value* value = value_of_datum(PG_GETARG_DATUM(1), key->types[0]);
    check_status(a3d_step(backend_session(), state->aggregate, value));
    account_for(state, memory, value);
  }
  PG_RETURN_POINTER(state);
}

/* Of no rows the result is that of no values, such as the empty solid. */
Datum finish_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key) {
  State* state = PG_ARGISNULL(0) ? opened_state(memory_of_aggregate(fcinfo), function_of(fcinfo, key))
                                 : (State*)PG_GETARG_POINTER(0);
  state->session = backend_session();
  check_status(is_long(state) ? run_aside(finish, state) : finish(state));
  owned_value(state->result);
  show_notices();
  if (!a3d_is_defined(state->result)) PG_RETURN_NULL();
  return datum_of_value(state->result);
}

/* ---- Aggregates in parts: parallel workers send what they have to the leader ---- */

PG_FUNCTION_INFO_V1(algebra3d_combine_aggregates);
Datum algebra3d_combine_aggregates(PG_FUNCTION_ARGS);
Datum algebra3d_combine_aggregates(PG_FUNCTION_ARGS) {
  MemoryContext memory = memory_of_aggregate(fcinfo);
  State* state = PG_ARGISNULL(0) ? NULL : (State*)PG_GETARG_POINTER(0);
  State* later = PG_ARGISNULL(1) ? NULL : (State*)PG_GETARG_POINTER(1);
  if (later == NULL) {
    if (state == NULL) PG_RETURN_NULL();
    PG_RETURN_POINTER(state);
  }
  if (state == NULL) state = opened_state(memory, later->function);
  check_status(a3d_combine(backend_session(), state->aggregate, later->aggregate));
  PG_RETURN_POINTER(state);
}

typedef struct Saving {
  State* state;
  a3d_bytes bytes;
} Saving;

static a3d_status save(void* given) {
  Saving* s = given;
  return a3d_save_aggregate(s->state->session, s->state->aggregate, &s->bytes);
}

PG_FUNCTION_INFO_V1(algebra3d_save_aggregate);
Datum algebra3d_save_aggregate(PG_FUNCTION_ARGS);
Datum algebra3d_save_aggregate(PG_FUNCTION_ARGS) {
  Saving saving = {(State*)PG_GETARG_POINTER(0), {0}};
  memory_of_aggregate(fcinfo);
  saving.state->session = backend_session();
  check_status(is_long(saving.state) ? run_aside(save, &saving) : save(&saving));
  return varlena_of_bytes(&saving.bytes);
}

typedef struct Restoring {
  State* state;
  const char* bytes;
  size_t size;
} Restoring;

static a3d_status restore(void* given) {
  Restoring* r = given;
  return a3d_restore_aggregate(r->state->session, r->state->function, r->bytes, r->size, &r->state->aggregate);
}

Datum restore_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key) {
  MemoryContext memory = memory_of_aggregate(fcinfo);
  MemoryContextCallback* closing;
  struct varlena* bytes = PG_GETARG_VARLENA_PP(0);
  State* state = new_state(memory, &closing);
  Restoring restoring = {state, VARDATA_ANY(bytes), VARSIZE_ANY_EXHDR(bytes)};
  state->function = function_of(fcinfo, key);
  check_status(run_aside(restore, &restoring));
  owns_run(memory, state, closing);
  PG_RETURN_POINTER(state);
}
