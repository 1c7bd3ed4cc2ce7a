#pragma once

#include <cstddef>

#include "algebra3d/base/error.h"

namespace queries {

/// The functions of libpq 5 that are used (chapter "libpq" of PostgreSQL's manual), found when they are first needed:
/// the program runs without the library. All of them are in every version since PostgreSQL 9.
struct Libpq {
  struct Connection;  // PGconn
  struct Answer;      // PGresult
  struct CancelKey;   // PGcancel
  struct Option;      // PQconninfoOption

  // Values of ConnStatusType, PostgresPollingStatusType and ExecStatusType.
  static constexpr int kConnectionBad = 1;
  static constexpr int kPollingFailed = 0, kPollingReading = 1, kPollingWriting = 2, kPollingOk = 3;
  static constexpr int kEmptyQuery = 0, kCommandOk = 1, kTuplesOk = 2, kCopyOut = 3, kCopyIn = 4;
  // Codes of fields of an error, PG_DIAG_...
  static constexpr int kSqlState = 'C', kPrimary = 'M', kDetail = 'D', kHint = 'H', kContext = 'W';

  using NoticeReceiver = void (*)(void* argument, const Answer* answer);

  Option* (*parse_conninfo)(const char* conninfo, char** message);
  void (*free_conninfo)(Option* options);
  Connection* (*connect_start)(const char* const* keywords, const char* const* values, int expand_name);
  int (*connect_poll)(Connection* connection);
  void (*finish)(Connection* connection);
  int (*status)(const Connection* connection);
  int (*socket)(const Connection* connection);
  int (*server_version)(const Connection* connection);
  char* (*database)(const Connection* connection);
  char* (*error_message)(const Connection* connection);
  NoticeReceiver (*set_notice_receiver)(Connection* connection, NoticeReceiver receiver, void* argument);
  int (*set_nonblocking)(Connection* connection, int is_nonblocking);

  int (*send_query)(Connection* connection, const char* sql);
  int (*send_query_params)(Connection* connection, const char* sql, int count, const unsigned* types,
                           const char* const* values, const int* lengths, const int* formats, int result_format);
  int (*flush)(Connection* connection);
  int (*consume_input)(Connection* connection);
  int (*is_busy)(Connection* connection);
  Answer* (*get_answer)(Connection* connection);
  int (*put_copy_data)(Connection* connection, const char* bytes, int size);
  int (*put_copy_end)(Connection* connection, const char* message);
  int (*get_copy_data)(Connection* connection, char** bytes, int is_async);
  void (*free_memory)(void* memory);

  int (*answer_status)(const Answer* answer);
  char* (*answer_field)(const Answer* answer, int field);
  char* (*answer_error)(const Answer* answer);
  char* (*affected)(Answer* answer);
  int (*row_count)(const Answer* answer);
  int (*column_count)(const Answer* answer);
  char* (*cell)(const Answer* answer, int row, int column);
  int (*cell_is_null)(const Answer* answer, int row, int column);
  int (*cell_size)(const Answer* answer, int row, int column);
  void (*clear)(Answer* answer);

  CancelKey* (*cancel_key)(Connection* connection);
  void (*free_cancel_key)(CancelKey* key);
  int (*request_cancel)(CancelKey* key, char* message, int size);

  /// Loads the library at the first call; it stays. Errors: file_missing with the Debian package that has it.
  static algebra3d::Result<const Libpq*> load();
};

}  // namespace queries
