#pragma once

/*
 * The extension of PostgreSQL, in C: it sees PostgreSQL's headers and algebra3d/c.h, and nothing else of the project.
 *
 * A function of PostgreSQL that reports an error leaves by a jump, over everything that is called in between. So values
 * of the library are owned by memory contexts from the moment they exist (owned_value), and no function of the library
 * is running when one of PostgreSQL is called.
 */

#include <postgres.h>

#include <fmgr.h>

#include "algebra3d/c.h"

/* The session of this backend, made at its first use. Its notices are shown by show_notices. */
a3d_session* backend_session(void);

/* The most memory of the session, in bytes. */
uint64 memory_limit(void);
/* Sets the session's count of memory right, if that was not done just before. */
void count_heap(bool in_any_case);

/* ereport(ERROR) with the last error of the session, unless the status is A3D_OK or A3D_END. */
void check_status(a3d_status status);
/* The same for bytes that come from a client, as an error of the given SQL state. */
void check_given(a3d_status status, int sql_state);
/* The same for arguments of a function, whose invalid values are errors 22023. */
void check_arguments(a3d_status status);

/* The notices of the session as NOTICEs, as many as algebra3d.notices allows in a statement. */
void show_notices(void);

/* Makes the current memory context the owner of a value. */
a3d_value* owned_value(a3d_value* value);

/* Work of the library that may take long: on a thread of its own, while this one waits for it and serves interrupts.
 * A cancelled statement and a backend that is to end stop the work, and are reported. `work` must not call PostgreSQL.
 */
a3d_status run_aside(a3d_status (*work)(void*), void* argument);

/* The name that the library has for a type of the extension. */
const char* name_of_type(Oid type, MemoryContext memory);
/* Whether values of a type are stored as the body of the binary form alone: they are small, and have no header. */
bool is_stored_short(const char* type);
/* The value that stored bytes have, which are trusted. Owned by the current memory context. */
a3d_value* value_of_bytes(const char* type, const char* bytes, size_t size);

/* Decoded values of the running statement: what it reads again, such as one side of a join or a constant, is decoded
 * once. They take a quarter of the memory of the backend at most. */
/* The value in a stored datum, decoded or kept. Owned by the current memory context. `is_of_pair`: the call has another
 * value, so it may be a condition of a join. */
a3d_value* kept_value(Datum datum, const char* type, bool is_of_pair);
/* At the end of a transaction, and when memory is short. */
void release_kept_values(void);
/* How many values were decoded, and how many were found decoded, since the backend began. */
extern uint64 decoded_count, found_count;

/* Points or triangles of a defined value; 0 for types of one point and for those that are not spatial. */
size_t element_count(const a3d_value* value);

/* The value in a datum of a type of the library, or of bigint, float8, boolean, text: named by the library's name. */
a3d_value* value_of_datum(Datum datum, const char* type);
/* The same for one of two or more values of a call. */
a3d_value* value_of_pair(Datum datum, const char* type);
/* The datum of a defined value, which may be an expanded object. */
Datum datum_of_value(a3d_value* value);
/* Bytes of the library as a varlena; frees them. */
Datum varlena_of_bytes(a3d_bytes* bytes);
/* The box and the number of elements of a value of a type with a box. Of a stored value its first bytes are read. */
a3d_header header_of_datum(Datum datum, const char* type);
/* A box that is not empty, as a rect3. */
Datum datum_of_box(const a3d_header* header);
/* A value as an expanded object, which owns it too; and the value of such a datum, null for another. */
Datum expanded_datum(a3d_value* value);
a3d_value* expanded_value(Datum datum);

/* What a function of SQL calls: a function of the library by its name and the types of its parameters. */
typedef struct FunctionKey {
  const char* name;
  int parameter_count;
  const char* types[8];
} FunctionKey;

Datum call_scalar(FunctionCallInfo fcinfo, const FunctionKey* key);
Datum call_table(FunctionCallInfo fcinfo, const FunctionKey* key);
Datum step_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key);
Datum finish_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key);
Datum restore_aggregate(FunctionCallInfo fcinfo, const FunctionKey* key);
/* Of mesh3d, surface3d and volume3d. */
Datum vertex_array(FunctionCallInfo fcinfo, const char* type);
Datum face_array(FunctionCallInfo fcinfo, const char* type);
Datum degree_array(FunctionCallInfo fcinfo, const char* type);
/* Of the index on space (index.c, support.c). */
Datum compress_value(FunctionCallInfo fcinfo, const char* type);
Datum is_consistent(FunctionCallInfo fcinfo, const char* type);
Datum distance_of_key(FunctionCallInfo fcinfo, const char* type);
Datum box_around(FunctionCallInfo fcinfo, const char* type);
Datum analyze_boxes(FunctionCallInfo fcinfo, const char* type);
Datum boxes_meet(FunctionCallInfo fcinfo, const char* type_a, const char* type_b);

Datum read_value(FunctionCallInfo fcinfo, const char* type);
Datum write_value(FunctionCallInfo fcinfo, const char* type);
Datum receive_value(FunctionCallInfo fcinfo, const char* type);
Datum send_value(FunctionCallInfo fcinfo, const char* type);
Datum text_of_value(FunctionCallInfo fcinfo, const char* type);
Datum compare_values(FunctionCallInfo fcinfo, const char* type);
Datum compare_equal(FunctionCallInfo fcinfo, const char* type);
Datum compare_not_equal(FunctionCallInfo fcinfo, const char* type);
Datum compare_less(FunctionCallInfo fcinfo, const char* type);
Datum compare_not_greater(FunctionCallInfo fcinfo, const char* type);
Datum compare_greater(FunctionCallInfo fcinfo, const char* type);
Datum compare_not_less(FunctionCallInfo fcinfo, const char* type);
Datum hash_value(FunctionCallInfo fcinfo, const char* type);
Datum hash_value_extended(FunctionCallInfo fcinfo, const char* type);
