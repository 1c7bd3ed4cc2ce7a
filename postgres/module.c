/* Loading, settings, the session of the backend, errors and notices. */
#include "module.h"

#include <limits.h>
#include <malloc.h>

#include <access/xact.h>
#include <mb/pg_wchar.h>
#include <miscadmin.h>
#include <utils/guc.h>
#include <utils/memutils.h>
#include <utils/timestamp.h>

#include "join.h"
#include "settings.h"

PG_MODULE_MAGIC;

int setting_output = OUTPUT_CODEC;
int setting_notices = NOTICES_10;
int setting_threads = 1;
int setting_max_threads = 1;
int setting_memory = 0;
int setting_max_memory = INT_MAX;
int setting_max_digits = MOST_DIGITS;
bool setting_enable_box_join = true;

static a3d_session* session;

static const struct config_enum_entry output_forms[] = {
    {"codec", OUTPUT_CODEC, false}, {"list", OUTPUT_LIST, false}, {NULL, 0, false}};
static const struct config_enum_entry amounts_of_notices[] = {
    {"off", NOTICES_OFF, false}, {"10", NOTICES_10, false}, {"all", NOTICES_ALL, false}, {NULL, 0, false}};

static void limit_digits(int digits, void* extra) {
  a3d_limit_digits(digits);
}

void _PG_init(void);

void _PG_init(void) {
  DefineCustomEnumVariable("algebra3d.output", "Text form of solids and other values.",
                           "codec: base64 of the binary form; list: value lists, which people can read.",
                           &setting_output, OUTPUT_CODEC, output_forms, PGC_USERSET, 0, NULL, NULL, NULL);
  DefineCustomEnumVariable("algebra3d.notices", "NOTICEs of the library that a statement shows at most.", NULL,
                           &setting_notices, NOTICES_10, amounts_of_notices, PGC_USERSET, 0, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.threads", "Threads that a call may use.",
                          "At most algebra3d.max_threads are used. Parallel workers have as many each.",
                          &setting_threads, 1, 1, 1024, PGC_USERSET, 0, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.max_threads", "Threads that users may set.", NULL, &setting_max_threads, 1, 1,
                          1024, PGC_SUSET, 0, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.memory", "Memory for values and calls of a backend.",
                          "0: the larger of 256 MB and 64 times work_mem.", &setting_memory, 0, 0, MAX_KILOBYTES,
                          PGC_USERSET, GUC_UNIT_KB, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.max_memory", "Memory that users may set.", NULL, &setting_max_memory,
                          MAX_KILOBYTES, 16384, MAX_KILOBYTES, PGC_SUSET, GUC_UNIT_KB, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.max_digits", "Digits of a number in a text or in binary input.",
                          "Numerator and denominator together. Reading a number cannot be cancelled.",
                          &setting_max_digits, MOST_DIGITS, 100, MOST_DIGITS, PGC_SUSET, 0, NULL, limit_digits, NULL);
  DefineCustomBoolVariable("algebra3d.enable_box_join", "Enables the planner's use of joins by boxes in memory.", NULL,
                           &setting_enable_box_join, true, PGC_USERSET, GUC_EXPLAIN, NULL, NULL, NULL);
  MarkGUCPrefixReserved("algebra3d");
  offer_box_joins();
}

uint64 memory_limit(void) {
  uint64 kilobytes = setting_memory;
  if (kilobytes == 0) kilobytes = Max(UINT64CONST(256) * 1024, UINT64CONST(64) * work_mem);
  return Min(kilobytes, (uint64)setting_max_memory) * 1024;
}

/* Bytes of the heap that are not the server's. The library counts what it allocates and frees, but not what the shared
 * C++ runtime allocates for it, so its count is set right now and then. Cost: some microseconds. */
static size_t heap_beside_server(void) {
  struct mallinfo2 heap = mallinfo2();
  size_t all = heap.uordblks + heap.hblkhd, of_server = MemoryContextMemAllocated(TopMemoryContext, true);
  return all > of_server ? all - of_server : 0;
}

static size_t heap_before; /* with the tables of the library, and what others have allocated */

/* Often enough for a limit of memory, seldom enough to cost nothing: malloc looks at all that is free. */
#define MICROSECONDS_BETWEEN_COUNTS 20000

void count_heap(bool in_any_case) {
  static TimestampTz last;
  TimestampTz now = GetCurrentTimestamp();
  size_t heap;
  if (!in_any_case && now - last < MICROSECONDS_BETWEEN_COUNTS && now >= last) return;
  last = now;
  heap = heap_beside_server();
  a3d_set_memory_used(session, heap > heap_before ? heap - heap_before : 0);
}

#define CALLS_UNTIL_COUNTED 256

a3d_session* backend_session(void) {
  static int calls;
  if (session == NULL) {
    a3d_guard_numbers();
    session = a3d_open(NULL);
    if (session == NULL) ereport(ERROR, errcode(ERRCODE_OUT_OF_MEMORY), errmsg("out of memory"));
    heap_before = heap_beside_server();
  }
  if (++calls >= CALLS_UNTIL_COUNTED) {
    calls = 0;
    count_heap(false);
  }
  a3d_set_memory(session, memory_limit());
  a3d_set_threads(session, Min(setting_threads, setting_max_threads));
  return session;
}

void check_status(a3d_status status) {
  const a3d_error* error;
  int sql_state;
  if (status != A3D_ERROR) return;
  error = a3d_last_error(session);
  a3d_clear_notices(session);
  sql_state = MAKE_SQLSTATE(error->sql_state[0], error->sql_state[1], error->sql_state[2], error->sql_state[3],
                            error->sql_state[4]);
  if (sql_state == ERRCODE_OUT_OF_MEMORY) release_kept_values();
  ereport(ERROR, errcode(sql_state), errmsg("%s", pg_any_to_server(error->message, strlen(error->message), PG_UTF8)),
          error->place[0] != '\0' ? errdetail("In %s.", error->place) : 0,
          errhint("%s", sql_state == ERRCODE_OUT_OF_MEMORY
                            ? "Raise algebra3d.memory, or split the work: by smaller groups, or fewer rows."
                            : error->remedy));
}

void check_given(a3d_status status, int sql_state) {
  const a3d_error* error;
  if (status != A3D_ERROR) return;
  error = a3d_last_error(session);
  if (strncmp(error->name, "database_", 9) != 0) check_status(status);
  a3d_clear_notices(session);
  ereport(
      ERROR, errcode(sql_state), errmsg("%s", pg_any_to_server(error->message, strlen(error->message), PG_UTF8)),
      errhint("Expected a value list, which begins with a parenthesis, or the binary form that the extension writes; a "
              "missing value is NULL."));
}

void check_arguments(a3d_status status) {
  const a3d_error* error;
  if (status != A3D_ERROR) return;
  error = a3d_last_error(session);
  if (strcmp(error->name, "invalid_value") != 0) check_status(status);
  a3d_clear_notices(session);
  ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
          errmsg("%s", pg_any_to_server(error->message, strlen(error->message), PG_UTF8)));
}

void show_notices(void) {
  static TimestampTz statement;
  static int shown;
  size_t count = a3d_notice_count(session);
  if (count == 0) return;
  if (statement != GetCurrentStatementStartTimestamp()) {
    statement = GetCurrentStatementStartTimestamp();
    shown = 0;
  }
  for (size_t i = 0; i < count; ++i) {
    const char* notice;
    const bool are_few = setting_notices == NOTICES_10;
    if (setting_notices == NOTICES_OFF || (are_few && shown >= 10)) break;
    ++shown;
    /* The tenth says that there are more. */
    if (are_few && shown == 10) {
      ereport(NOTICE, errmsg("further notices of this statement are not shown"),
              errhint("SET algebra3d.notices = 'all' shows all."));
      break;
    }
    notice = a3d_notice(session, i);
    ereport(NOTICE, errmsg("%s", pg_any_to_server(notice, strlen(notice), PG_UTF8)));
  }
  a3d_clear_notices(session);
}

static void release_value(void* value) {
  a3d_release(value);
}

a3d_value* owned_value(a3d_value* value) {
  MemoryContextCallback* callback =
      MemoryContextAllocExtended(CurrentMemoryContext, sizeof(MemoryContextCallback), MCXT_ALLOC_NO_OOM);
  if (callback == NULL) {
    a3d_release(value);
    ereport(ERROR, errcode(ERRCODE_OUT_OF_MEMORY), errmsg("out of memory"));
  }
  callback->func = release_value;
  callback->arg = value;
  MemoryContextRegisterResetCallback(CurrentMemoryContext, callback);
  return value;
}
