/* Cuts a hole into a plate, measures what is left, and asks whether a block fits into the hole. */
#include <stdio.h>
#include <string.h>

#include "algebra3d/c.h"

static a3d_session *session;

static int fails(a3d_status status) {
  if (status == A3D_OK) return 0;
  fprintf(stderr, "%s: %s\n", a3d_last_error(session)->name, a3d_last_error(session)->message);
  return 1;
}

/* Calls a function by its name; gives up the arguments. Null if an argument is null, or after an error. */
static a3d_value *call(const char *name, a3d_value *first, a3d_value *second) {
  a3d_value *arguments[2] = {first, second}, *result = NULL;
  const char *types[2] = {first ? a3d_type_of(first) : "", second ? a3d_type_of(second) : ""};
  const a3d_function *function = NULL;
  const size_t count = second ? 2 : 1;
  if (first && !fails(a3d_find(session, name, types, count, &function)))
    fails(a3d_call(session, function, arguments, count, &result));
  a3d_release(first);
  a3d_release(second);
  return result;
}

static a3d_value *parsed(const char *type, const char *text) {
  a3d_value *value = NULL;
  fails(a3d_parse(session, type, text, strlen(text), &value));
  return value;
}

static a3d_value *box(const char *corner, const char *opposite) {
  return call("create_cube", parsed("point3d", corner), parsed("point3d", opposite));
}

int main(void) {
  session = a3d_open(NULL);
  if (!session) return 1;
  a3d_value *hole = box("(10 10 -1)", "(20 20 6)");
  a3d_value *block = box("(12 12 1)", "(18 18 4)");
  if (!hole || !block) return 1;
  a3d_value *plate = call("difference", box("(0 0 0)", "(40 30 5)"), a3d_retain(hole));
  if (!plate) return 1;
  a3d_value *volume = call("volume", a3d_retain(plate), NULL);
  a3d_value *meets = call("intersects", block, plate);
  if (!volume || !meets) return 1;
  printf("volume %g\nblock and plate %s\n", a3d_real_of(volume), a3d_bool_of(meets) ? "meet" : "do not meet");
  a3d_release(volume);
  a3d_release(meets);
  a3d_release(hole);
  a3d_close(session);
  return 0;
}
