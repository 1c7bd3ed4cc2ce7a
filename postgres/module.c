/* Loading, settings, the session of the backend, errors and notices. */
#include "module.h"

#include <limits.h>

#include <access/xact.h>
#include <mb/pg_wchar.h>
#include <miscadmin.h>
#include <utils/guc.h>
#include <utils/memutils.h>
#include <utils/timestamp.h>

#include "settings.h"

PG_MODULE_MAGIC;

int setting_output = OUTPUT_CODEC;
int setting_notices = 10;
int setting_threads = 1;
int setting_max_threads = 1;
int setting_memory = 0;
int setting_max_memory = INT_MAX;

static a3d_session* session;

static const struct config_enum_entry output_forms[] = {
    {"codec", OUTPUT_CODEC, false}, {"list", OUTPUT_LIST, false}, {NULL, 0, false}};

void _PG_init(void);

void _PG_init(void) {
  DefineCustomEnumVariable("algebra3d.output", "Text form of solids and other values.",
                           "codec: base64 of the binary form; list: value lists, which people can read.",
                           &setting_output, OUTPUT_CODEC, output_forms, PGC_USERSET, 0, NULL, NULL, NULL);
  DefineCustomIntVariable("algebra3d.notices", "NOTICEs of the library that a statement shows at most.",
                          "-1 shows all of them.", &setting_notices, 10, -1, INT_MAX, PGC_USERSET, 0, NULL, NULL, NULL);
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
  MarkGUCPrefixReserved("algebra3d");
}

static uint64 memory_limit(void) {
  uint64 kilobytes = setting_memory;
  if (kilobytes == 0) kilobytes = Max(UINT64CONST(256) * 1024, UINT64CONST(64) * work_mem);
  return Min(kilobytes, (uint64)setting_max_memory) * 1024;
}

a3d_session* backend_session(void) {
  if (session == NULL) {
    session = a3d_open(NULL);
    if (session == NULL) ereport(ERROR, errcode(ERRCODE_OUT_OF_MEMORY), errmsg("out of memory"));
  }
  a3d_set_memory(session, memory_limit());
  a3d_set_threads(session, Min(setting_threads, setting_max_threads));
  return session;
}

void check_status(a3d_status status) {
  const a3d_error* error;
  if (status != A3D_ERROR) return;
  error = a3d_last_error(session);
  a3d_clear_notices(session);
  ereport(ERROR,
          errcode(MAKE_SQLSTATE(error->sql_state[0], error->sql_state[1], error->sql_state[2], error->sql_state[3],
                                error->sql_state[4])),
          errmsg("%s", pg_any_to_server(error->message, strlen(error->message), PG_UTF8)),
          errhint("%s", error->remedy));
}

void check_given(a3d_status status, int sql_state) {
  const a3d_error* error;
  if (status != A3D_ERROR) return;
  error = a3d_last_error(session);
  if (strncmp(error->name, "database_", 9) != 0) check_status(status);
  a3d_clear_notices(session);
  ereport(
      ERROR, errcode(sql_state), errmsg("%s", error->message),
      errhint("Expected a value list, which begins with a parenthesis, or the binary form that the extension writes; a "
              "missing value is NULL."));
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
    if (setting_notices >= 0 && shown > setting_notices) break;
    if (setting_notices == 0) break;
    ++shown;
    if (setting_notices >= 0 && shown > setting_notices) {
      ereport(NOTICE, errmsg("further notices of this statement are not shown"),
              errhint("Set algebra3d.notices to -1."));
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
