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

/* ereport(ERROR) with the last error of the session, unless the status is A3D_OK or A3D_END. */
void check_status(a3d_status status);
/* The same for bytes that come from a client, as an error of the given SQL state. */
void check_given(a3d_status status, int sql_state);

/* The notices of the session as NOTICEs, as many as algebra3d.notices allows in a statement. */
void show_notices(void);

/* Makes the current memory context the owner of a value. */
a3d_value* owned_value(a3d_value* value);

/* Work of the library that may take long: on a thread of its own, while this one waits for it and serves interrupts.
 * A cancelled statement and a backend that is to end stop the work, and are reported. `work` must not call PostgreSQL.
 */
a3d_status run_aside(a3d_status (*work)(void*), void* argument);

/* The value in a datum of a type of the library, or of bigint, float8, boolean, text: named by the library's name. */
a3d_value* value_of_datum(Datum datum, const char* type);
/* The datum of a defined value, which may be an expanded object. */
Datum datum_of_value(a3d_value* value);
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
