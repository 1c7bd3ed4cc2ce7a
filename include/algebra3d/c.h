#pragma once

/*
 * The types and operators of algebra3d for programs in C, and for languages that call C: values, operators by the names
 * that other hosts use (docs/operators.md), errors as plain data, cancelling, limits of memory and threads. There are
 * no databases and no query language here.
 *
 * No function throws, jumps or ends the process. A function that returns a3d_status writes its result only if that is
 * A3D_OK or A3D_END; otherwise a3d_last_error of the session says what was wrong. Pointers must not be null unless that
 * is said. Texts are UTF-8; those that go in need not end with a zero where their size is given.
 *
 * A session is used by one thread at a time; different sessions may be used at the same time, and values belong to no
 * session: they are immutable and may be shared between threads. Calls of one process share nothing else.
 *
 * Functions and fields are only added, fields at the end of a struct, as long as A3D_INTERFACE is the same.
 */

/* NOLINTBEGIN(modernize-deprecated-headers,modernize-use-using,readability-identifier-naming): this is C. */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define A3D_INTERFACE 1

/* A3D_INTERFACE of the library, and its version as text, such as "1.0.0". */
uint32_t a3d_interface(void);
const char* a3d_version(void);

typedef enum a3d_status {
  A3D_OK = 0,
  A3D_ERROR = 1,
  A3D_END = 2 /* there is no further row */
} a3d_status;

/* What went wrong. Texts end with a zero, and are cut where they would be longer. */
typedef struct a3d_error {
  char sql_state[6];  /* five characters, as PostgreSQL has them */
  char name[32];      /* the kind: "invalid_value", "interrupted" */
  char message[301];  /* what was found, where, and what was expected; numbers, but no whole value */
  const char* remedy; /* what the user can do, a sentence; lives as long as the library */
  char place[40];     /* in a text that was parsed: "line 1, column 7"; else empty */
} a3d_error;

/* ---- The process: for hosts that are programs, not for libraries ---- */

/* GMP, by which exact numbers are computed, ends the process when memory is exhausted. After this call it ends the
 * running call of the library with an error instead; 16 MB of address space are kept for that, and numbers count where
 * the heap is counted. Changes GMP for all that use it in the process. Once, before the first session. */
void a3d_guard_numbers(void);

/* The most digits of a number, numerator and denominator together, in texts and in bytes that are not trusted, at most
 * the default of 10,000,000: a number is read in one piece, which a3d_cancel does not interrupt. */
void a3d_limit_digits(size_t digits);

/* ---- Sessions: the surroundings of calls ---- */

typedef struct a3d_session a3d_session;

typedef struct a3d_options {
  uint64_t memory;    /* bytes that calls may take, 0: no limit; see a3d_counts_memory */
  uint32_t threads;   /* of each call at most; 0: as many as there are processors */
  const char* folder; /* of relative file names; null: the working directory of the process */
} a3d_options;

/* Opens a session. Null if there is no memory for it. The first session of a process takes some milliseconds. `options`
 * may be null: no limits, one thread. */
a3d_session* a3d_open(const a3d_options* options);
/* Closes a session, which may be null. No call of it may be running. Values stay valid. */
void a3d_close(a3d_session* session);

/* Ends the running call of a session, and those that follow, with the error `interrupted` (57014), until a3d_resume.
 * May be called by any thread and by a signal handler. */
void a3d_cancel(a3d_session* session);
void a3d_resume(a3d_session* session);

void a3d_set_memory(a3d_session* session, uint64_t bytes);
void a3d_set_threads(a3d_session* session, uint32_t threads);
/* Bytes of the heap that the session's calls, and the values that they made, hold now, in programs that count the heap;
 * elsewhere 0, and the limit has no effect but for results whose size is known before the work. Beyond the limit calls
 * fail with out_of_memory. */
uint64_t a3d_memory_used(const a3d_session* session);
/* Replaces that number by what the host knows better: where the C++ runtime is shared with others, what it allocates
 * and the library frees is not counted evenly. */
void a3d_set_memory_used(a3d_session* session, uint64_t bytes);
/* 1 if the heap is counted in this process. */
int a3d_counts_memory(void);

/* The error of the last function that returned A3D_ERROR; unspecified before. Lives as long as the session. */
const a3d_error* a3d_last_error(const a3d_session* session);

/* Notices since they were cleared, by their numbers from 0; null beyond them: why results are undefined, and remarks
 * such as "3 of 12 vertices rounded to floats". Equal ones are counted in one text. The texts live until the next call
 * of the session. */
size_t a3d_notice_count(a3d_session* session);
const char* a3d_notice(a3d_session* session, size_t number);
void a3d_clear_notices(a3d_session* session);
/* Of the notices the last one that is the reason of an undefined value; empty if there is none. Lives as long as they
 * do.
 */
const char* a3d_reason(a3d_session* session);

/* ---- Values ---- */

/* A value of one of the types, or undefined. Immutable, counted. */
typedef struct a3d_value a3d_value;

/* Bytes that the library made; `data` ends with a zero that `size` does not count. */
typedef struct a3d_bytes {
  const char* data;
  size_t size;
  void* owner;
} a3d_bytes;
void a3d_free_bytes(a3d_bytes* bytes);

/* One more owner; returns its argument. */
a3d_value* a3d_retain(a3d_value* value);
/* Gives up a value, which may be null. Cost: that of its destruction for the last owner. */
void a3d_release(a3d_value* value);

/* The name of the type of a value, such as "volume3d"; lives as long as the library. */
const char* a3d_type_of(const a3d_value* value);
int a3d_is_defined(const a3d_value* value);

/* Plain values. `type` of a text is "string" or "text". Errors: invalid_value for a real that is not finite, and for
 * text that is no UTF-8. */
a3d_status a3d_make_undefined(a3d_session* session, const char* type, a3d_value** result);
a3d_status a3d_make_int(a3d_session* session, int64_t number, a3d_value** result);
a3d_status a3d_make_real(a3d_session* session, double number, a3d_value** result);
a3d_status a3d_make_bool(a3d_session* session, int truth, a3d_value** result);
a3d_status a3d_make_text(a3d_session* session, const char* type, const char* text, size_t size, a3d_value** result);
/* A value of the type bytes: any bytes, such as the content of a file. (a3d_bytes above are bytes of the library's
 * own.)
 */
a3d_status a3d_make_bytes(a3d_session* session, const char* bytes, size_t size, a3d_value** result);
/* Of defined values of exactly these types. The text and the bytes live as long as the value; both end with a zero that
 * `size` does not count. */
int64_t a3d_int_of(const a3d_value* value);
double a3d_real_of(const a3d_value* value);
int a3d_bool_of(const a3d_value* value);
const char* a3d_text_of(const a3d_value* value, size_t* size);
const char* a3d_bytes_of(const a3d_value* value, size_t* size);

/* A mesh3d of points (x, y, z of each, finite) and faces with 3 corners each; or, where `degrees` is not null, with as
 * many as it says. Corners are numbers of points from 0. Errors: invalid_value with the place: a coordinate that is not
 * finite, a corner beyond the points, a face of fewer than 3 corners, degrees that do not sum up to the corners. */
a3d_status a3d_make_mesh(a3d_session* session, const double* coordinates, size_t point_count, const uint32_t* corners,
                         size_t corner_count, const uint32_t* degrees, size_t face_count, a3d_value** result);

/* The points and corners of a defined mesh3d, surface3d or volume3d. The arrays live as long as `owner` is not released
 * by a3d_release_mesh. Coordinates that are no doubles are rounded, each once. */
typedef struct a3d_mesh {
  const double* coordinates; /* 3 for each point */
  size_t point_count;
  const uint32_t* corners; /* one face after the other */
  size_t corner_count;
  const uint32_t* degrees; /* of the faces; null if each has three corners */
  size_t face_count;
  int is_exact; /* 0 if coordinates were rounded */
  void* owner;
} a3d_mesh;
a3d_status a3d_mesh_of(a3d_session* session, const a3d_value* value, a3d_mesh* result);
void a3d_release_mesh(a3d_mesh* mesh);

/* The binary form (docs/file_format.md), and back. With `is_trusted` 0 the value is proved to be valid; bytes that the
 * host itself stored need not be. Errors of decode: database_corrupt with the place, database_version. */
a3d_status a3d_encode(a3d_session* session, const a3d_value* value, a3d_bytes* result);
a3d_status a3d_decode(a3d_session* session, const char* type, const char* bytes, size_t size, int is_trusted,
                      a3d_value** result);
/* The body of the binary form alone, for small values whose type the host knows: without box, checksum and compression.
 * Errors: type_error for undefined values; database_corrupt. */
a3d_status a3d_encode_body(a3d_session* session, const a3d_value* value, a3d_bytes* result);
a3d_status a3d_decode_body(a3d_session* session, const char* type, const char* bytes, size_t size, int is_trusted,
                           a3d_value** result);
/* The value list of the query language, and back. A list that is well formed and no valid value is undefined, with the
 * reason as a notice. Errors of parse: invalid_value with line and column. */
a3d_status a3d_print(a3d_session* session, const a3d_value* value, a3d_bytes* result);
a3d_status a3d_parse(a3d_session* session, const char* type, const char* text, size_t size, a3d_value** result);

/* The smallest box of doubles around a spatial value, and its number of points or triangles. */
typedef struct a3d_header {
  double min[3], max[3]; /* min above max if the value is empty */
  uint32_t count;
} a3d_header;
/* Of a defined value of a type with a box. Errors: type_error for others. */
a3d_status a3d_header_of(a3d_session* session, const a3d_value* value, a3d_header* result);
/* The same from the first A3D_HEADER_BYTES of the binary form, or all of it if it is shorter. */
#define A3D_HEADER_BYTES 96
a3d_status a3d_header_of_bytes(a3d_session* session, const char* bytes, size_t size, a3d_header* result);

/* A point's place on Hilbert's curve: an order in which neighbours are near each other, for data of any extent. The
 * curve runs through a grid of 2^40 cells on each axis that is as large as the greatest coordinate, up to a power of
 * 2^16: cells of 2^-24 for parts of some units, of 2^-8 for coordinates in the millions. First by places[0], then by
 * places[1]. */
void a3d_hilbert_places(const double point[3], uint64_t places[2]);
/* The place of a cell on the curve through a cube of 2^A3D_HILBERT_BITS cells on each axis. The cells of a cube of 2^n,
 * whose coordinates begin at multiples of that, are 8^n places in a row. */
#define A3D_HILBERT_BITS 10
uint32_t a3d_hilbert_code(const uint32_t cell[3]);

/* The canonical order of two values of one type: below 0, 0 or above 0; undefined comes first. Equal values have equal
 * hashes. */
a3d_status a3d_compare(a3d_session* session, const a3d_value* a, const a3d_value* b, int* result);
a3d_status a3d_hash(a3d_session* session, const a3d_value* value, uint64_t* result);

/* ---- Functions: one for each signature of an operator over values ---- */

typedef enum a3d_kind { A3D_SCALAR = 0, A3D_AGGREGATE = 1, A3D_TABLE = 2 } a3d_kind;

typedef enum a3d_cost {
  A3D_CONSTANT = 1, /* independent of sizes */
  A3D_LINEAR = 2,
  A3D_SORTING = 3,
  A3D_PAIRS = 4,       /* with the product of the sizes */
  A3D_ARRANGEMENT = 5, /* with the sizes and the intersections */
  A3D_FILE = 6         /* with the size of a file */
} a3d_cost;

/* What a true result says about the boxes of the first two arguments. Empty values may satisfy it without a box. */
typedef enum a3d_boxes {
  A3D_BOXES_NONE = 0,
  A3D_BOXES_MEET = 1,
  A3D_BOXES_INSIDE = 2,   /* the second one encloses the first */
  A3D_BOXES_ENCLOSES = 3, /* the first one encloses the second */
  A3D_BOXES_NEAR = 4      /* their distance is at most the third argument */
} a3d_boxes;

typedef struct a3d_column {
  const char* name;
  const char* type;
} a3d_column;

typedef struct a3d_parameter {
  const char* name;
  const char* type;
  int accepts_undefined; /* 0: undefined gives undefined, without a call */
} a3d_parameter;

/* The description of a function; all of it lives as long as the library. */
typedef struct a3d_function {
  const char* name;          /* in snake case; several functions may have it, with different parameters */
  const char* operator_name; /* in the query language */
  const char* family;        /* "set operations" */
  const char* doc;           /* one sentence */
  const char* detail;        /* domain and special cases; may be empty */
  a3d_kind kind;
  a3d_cost cost;
  size_t parameter_count; /* of an aggregate: 1, for all values */
  const a3d_parameter* parameters;
  const char* result_type; /* of a scalar or aggregate; of a table null */
  size_t column_count;     /* of a table */
  const a3d_column* columns;
  int gives_elements; /* a table of one column whose rows are plain values */
  int has_one_row;    /* a table of at most one row */
  int is_pure;        /* no side effects, and equal results for equal arguments */
  int is_symmetric;   /* two parameters of one type may be exchanged */
  int reads_files;
  int writes_files;
  int has_parts;    /* an aggregate whose runs can be saved: see a3d_save_aggregate */
  int keeps_values; /* an aggregate whose runs hold all their values until the end */
  a3d_boxes boxes;  /* of a predicate */
} a3d_function;

/* All functions, sorted by name; those of one name in the order of docs/operators.md. A session must have been opened.
 */
size_t a3d_function_count(void);
const a3d_function* a3d_function_at(size_t number);

/* The function of that name for arguments of these types, by conversions of int to real and string to text if there is
 * none for the types themselves. The name may be that of the operator. Errors: unknown_name; type_error with what was
 * expected. */
a3d_status a3d_find(a3d_session* session, const char* name, const char* const* types, size_t count,
                    const a3d_function** result);

/* Calls a scalar. Arguments have the types of the parameters, or such as a3d_find takes for them. They stay with the
 * caller; the result belongs to the caller. Undefined results have their reason as a notice. */
a3d_status a3d_call(a3d_session* session, const a3d_function* function, a3d_value* const* arguments, size_t count,
                    a3d_value** result);

/* The rows of a table, made one after the other. `cells` has room for column_count values, which belong to the caller.
 * Arguments need not outlive the call. */
typedef struct a3d_rows a3d_rows;
a3d_status a3d_open_rows(a3d_session* session, const a3d_function* function, a3d_value* const* arguments, size_t count,
                         a3d_rows** result);
a3d_status a3d_next_row(a3d_session* session, a3d_rows* rows, a3d_value** cells);
void a3d_close_rows(a3d_rows* rows); /* may be null */

/* A running aggregate: values, then the result, once. `combine` adds what another run of the same function took, as if
 * its values came after those of this one; that run is used up. Undefined values are left out. */
typedef struct a3d_aggregate a3d_aggregate;
a3d_status a3d_open_aggregate(a3d_session* session, const a3d_function* function, a3d_aggregate** result);
a3d_status a3d_step(a3d_session* session, a3d_aggregate* aggregate, const a3d_value* value);
a3d_status a3d_combine(a3d_session* session, a3d_aggregate* aggregate, a3d_aggregate* later);
a3d_status a3d_finish(a3d_session* session, a3d_aggregate* aggregate, a3d_value** result);
void a3d_close_aggregate(a3d_aggregate* aggregate); /* may be null */
/* A run as bytes, for another process, which makes a run of the same function of them. The values of the run are
 * aggregated first, and it is used up. Errors: wrong_usage for a function without parts; of restore database_corrupt.
 */
a3d_status a3d_save_aggregate(a3d_session* session, a3d_aggregate* aggregate, a3d_bytes* result);
a3d_status a3d_restore_aggregate(a3d_session* session, const a3d_function* function, const char* bytes, size_t size,
                                 a3d_aggregate** result);

/* ---- Joins of boxes ---- */

/* A closed box: boxes that touch meet. One whose least corner is beyond its greatest on some axis is empty, and meets
 * none. */
typedef struct a3d_box {
  double min[3], max[3];
} a3d_box;
typedef struct a3d_box_pair {
  uint32_t first, second; /* numbers of boxes from 0 */
} a3d_box_pair;

/* The pairs of a box of one array and a box of another one that meet. The arrays may be freed after the call. At most
 * 2^32 - 1 boxes each. Cost: linear, some 100 bytes and 100 nanoseconds for each box. */
typedef struct a3d_box_join a3d_box_join;
a3d_status a3d_open_box_join(a3d_session* session, const a3d_box* first, size_t first_count, const a3d_box* second,
                             size_t second_count, a3d_box_join** result);
/* The next pairs, some thousand at a time, in an order that depends on the boxes only; A3D_END if there are none. They
 * live until the next call. Cost: that of the nodes of two R-trees that meet. */
a3d_status a3d_next_pairs(a3d_session* session, a3d_box_join* join, const a3d_box_pair** pairs, size_t* count);
void a3d_close_box_join(a3d_box_join* join); /* may be null */

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-deprecated-headers,modernize-use-using,readability-identifier-naming) */
