/* Meshes from arrays of numbers, and back. */
#include "module.h"

#include <catalog/pg_type.h>
#include <utils/array.h>
#include <utils/builtins.h>
#include <utils/memutils.h>

/* ---- Arrays in ---- */

typedef struct Numbers {
  const void* data;
  size_t count;
} Numbers;

/* The elements of an array of one or two dimensions; of two with rows of `width`, or of any width if that is 0. */
static Numbers numbers_of(FunctionCallInfo fcinfo, int argument, const char* name, int width) {
  ArrayType* array = PG_GETARG_ARRAYTYPE_P(argument);
  Numbers result = {ARR_DATA_PTR(array), ArrayGetNItems(ARR_NDIM(array), ARR_DIMS(array))};
  if (array_contains_nulls(array))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("%s: an element is NULL", name),
            errhint("array_position(%s, NULL) is its place.", name));
  if (ARR_NDIM(array) > 2 || (ARR_NDIM(array) == 2 && width != 0 && ARR_DIMS(array)[1] != width))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("%s: expected an array of one dimension%s, found %d dimensions%s", name,
                   width == 3 ? ", or rows of 3" : "", ARR_NDIM(array),
                   ARR_NDIM(array) == 2 ? psprintf(" with rows of %d", ARR_DIMS(array)[1]) : ""));
  if (width != 0 && result.count % width != 0)
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("%s: %zu elements, expected a multiple of %d", name, result.count, width));
  return result;
}

/* int4 has the same bytes for numbers that are not negative. */
static const uint32_t* unsigned_of(Numbers numbers, const char* name) {
  const int32* all = numbers.data;
  for (size_t i = 0; i < numbers.count; ++i)
    if (all[i] < 0)
      ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
              errmsg("%s: element %zu is %d, expected a number from 0", name, i + 1, all[i]));
  return (const uint32_t*)all;
}

typedef struct Making {
  a3d_session* session;
  Numbers coordinates, corners, degrees;
  bool has_degrees;
  a3d_value* result;
} Making;

static a3d_status make(void* given) {
  Making* m = given;
  return a3d_make_mesh(m->session, m->coordinates.data, m->coordinates.count / 3, m->corners.data, m->corners.count,
                       m->has_degrees ? m->degrees.data : NULL,
                       m->has_degrees ? m->degrees.count : m->corners.count / 3, &m->result);
}

#define MOST_NUMBERS_AT_ONCE 5000

/* vertices float8[], faces int[] and perhaps degrees int[]. */
PG_FUNCTION_INFO_V1(algebra3d_mesh_of_arrays);
Datum algebra3d_mesh_of_arrays(PG_FUNCTION_ARGS);
Datum algebra3d_mesh_of_arrays(PG_FUNCTION_ARGS) {
  Making making = {0};
  making.session = backend_session();
  making.has_degrees = PG_NARGS() > 2;
  making.coordinates = numbers_of(fcinfo, 0, "vertices", 3);
  making.corners = numbers_of(fcinfo, 1, "faces", making.has_degrees ? 0 : 3);
  unsigned_of(making.corners, "faces");
  if (making.has_degrees) {
    making.degrees = numbers_of(fcinfo, 2, "degrees", 0);
    unsigned_of(making.degrees, "degrees");
  }
  check_arguments(making.coordinates.count + making.corners.count > MOST_NUMBERS_AT_ONCE ? run_aside(make, &making)
                                                                                         : make(&making));
  return datum_of_value(owned_value(making.result));
}

/* ---- Arrays out ---- */

typedef struct Showing {
  a3d_session* session;
  const a3d_value* value;
  a3d_mesh mesh;
} Showing;

static a3d_status show(void* given) {
  Showing* s = given;
  return a3d_mesh_of(s->session, s->value, &s->mesh);
}

static void release_mesh(void* mesh) {
  a3d_release_mesh(mesh);
}

/* The arrays of an argument, which live as long as the current memory context. */
static a3d_mesh* shown(FunctionCallInfo fcinfo, const char* type) {
  MemoryContextCallback* closing = palloc0(sizeof *closing);
  Showing* showing = palloc0(sizeof *showing);
  showing->session = backend_session();
  showing->value = value_of_datum(PG_GETARG_DATUM(0), type);
  check_status(run_aside(show, showing));
  closing->func = release_mesh;
  closing->arg = &showing->mesh;
  MemoryContextRegisterResetCallback(CurrentMemoryContext, closing);
  return &showing->mesh;
}

/* An array of numbers of `size` bytes each, in rows of 3 if `is_in_rows`. */
static Datum array_of(const void* numbers, size_t count, size_t size, Oid type, bool is_in_rows) {
  const int dimensions = is_in_rows ? 2 : 1;
  const size_t bytes = ARR_OVERHEAD_NONULLS(dimensions) + count * size;
  ArrayType* result;
  if (count == 0) PG_RETURN_ARRAYTYPE_P(construct_empty_array(type));
  if (bytes > MaxAllocSize || count > MaxArraySize)
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED), errmsg("an array of %zu numbers is too long", count));
  result = palloc0(bytes);
  SET_VARSIZE(result, bytes);
  result->ndim = dimensions;
  result->dataoffset = 0;
  result->elemtype = type;
  ARR_DIMS(result)[0] = (int)(is_in_rows ? count / 3 : count);
  ARR_LBOUND(result)[0] = 1;
  if (is_in_rows) {
    ARR_DIMS(result)[1] = 3;
    ARR_LBOUND(result)[1] = 1;
  }
  memcpy(ARR_DATA_PTR(result), numbers, count * size);
  PG_RETURN_ARRAYTYPE_P(result);
}

Datum vertex_array(FunctionCallInfo fcinfo, const char* type) {
  const a3d_mesh* mesh = shown(fcinfo, type);
  return array_of(mesh->coordinates, 3 * mesh->point_count, sizeof(double), FLOAT8OID, true);
}

Datum face_array(FunctionCallInfo fcinfo, const char* type) {
  const a3d_mesh* mesh = shown(fcinfo, type);
  return array_of(mesh->corners, mesh->corner_count, sizeof(int32), INT4OID, mesh->degrees == NULL);
}

Datum degree_array(FunctionCallInfo fcinfo, const char* type) {
  const a3d_mesh* mesh = shown(fcinfo, type);
  int32* threes;
  if (mesh->degrees != NULL) return array_of(mesh->degrees, mesh->face_count, sizeof(int32), INT4OID, false);
  threes = palloc_extended(Max(1, mesh->face_count) * sizeof *threes, MCXT_ALLOC_HUGE);
  for (size_t f = 0; f < mesh->face_count; ++f) threes[f] = 3;
  return array_of(threes, mesh->face_count, sizeof(int32), INT4OID, false);
}
