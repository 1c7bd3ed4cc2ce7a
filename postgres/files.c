/* Mesh files on the server, for roles that may read its files (pg_read_server_files). */
#include "module.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catalog/pg_authid.h>
#include <funcapi.h>
#include <miscadmin.h>
#include <storage/fd.h>
#include <utils/acl.h>
#include <utils/builtins.h>
#include <utils/memutils.h>
#include <utils/tuplestore.h>

static void check_role(void) {
  if (!has_privs_of_role(GetUserId(), ROLE_PG_READ_SERVER_FILES))
    ereport(ERROR, errcode(ERRCODE_INSUFFICIENT_PRIVILEGE),
            errmsg("only roles with the privileges of pg_read_server_files read files of the server"),
            errhint("Clients can send the content: import_stl(bytea)."));
}

/* Reads in pieces between which an interrupt is served. */
static void read_pieces(int file, const char* path, char* to, size_t size) {
  const size_t most = 1 << 20;
  for (size_t done = 0; done < size;) {
    ssize_t piece;
    CHECK_FOR_INTERRUPTS();
    piece = read(file, to + done, Min(most, size - done));
    if (piece < 0 && errno == EINTR) continue;
    if (piece < 0) ereport(ERROR, errcode_for_file_access(), errmsg("could not read file \"%s\": %m", path));
    if (piece == 0)
      ereport(ERROR, errcode(ERRCODE_IO_ERROR), errmsg("file \"%s\" ended at byte %zu of %zu", path, done, size));
    done += piece;
  }
}

/* (path text): the content of a regular file. */
PG_FUNCTION_INFO_V1(algebra3d_server_file);
Datum algebra3d_server_file(PG_FUNCTION_ARGS);
Datum algebra3d_server_file(PG_FUNCTION_ARGS) {
  char* path = text_to_cstring(PG_GETARG_TEXT_PP(0));
  struct stat status;
  bytea* result;
  int file;
  check_role();
  /* A pipe would wait for its writer. */
  file = OpenTransientFile(path, O_RDONLY | O_NONBLOCK | PG_BINARY);
  if (file < 0) ereport(ERROR, errcode_for_file_access(), errmsg("could not open file \"%s\": %m", path));
  if (fstat(file, &status) != 0)
    ereport(ERROR, errcode_for_file_access(), errmsg("could not look at file \"%s\": %m", path));
  if (!S_ISREG(status.st_mode))
    ereport(ERROR, errcode(ERRCODE_WRONG_OBJECT_TYPE), errmsg("\"%s\" is not a regular file", path));
  if (status.st_size > (off_t)(MaxAllocSize - VARHDRSZ))
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
            errmsg("file \"%s\" has %lld bytes, at most %zu are read", path, (long long)status.st_size,
                   MaxAllocSize - VARHDRSZ));
  result = palloc(VARHDRSZ + status.st_size);
  SET_VARSIZE(result, VARHDRSZ + status.st_size);
  read_pieces(file, path, VARDATA(result), status.st_size);
  CloseTransientFile(file);
  PG_RETURN_BYTEA_P(result);
}

static bool ends_with(const char* text, const char* ending) {
  size_t size = strlen(text), of_ending = strlen(ending);
  return size > of_ending && pg_strcasecmp(text + size - of_ending, ending) == 0;
}

static int compare_names(const void* a, const void* b) {
  return strcmp(*(char* const*)a, *(char* const*)b);
}

/* (folder text): the names of the files in it that may be mesh files, sorted. */
PG_FUNCTION_INFO_V1(algebra3d_server_files);
Datum algebra3d_server_files(PG_FUNCTION_ARGS);
Datum algebra3d_server_files(PG_FUNCTION_ARGS) {
  char* folder = text_to_cstring(PG_GETARG_TEXT_PP(0));
  ReturnSetInfo* result;
  struct dirent* entry;
  DIR* opened;
  char** names = palloc(sizeof *names);
  int count = 0, room = 1;
  check_role();
  InitMaterializedSRF(fcinfo, MAT_SRF_USE_EXPECTED_DESC);
  result = (ReturnSetInfo*)fcinfo->resultinfo;
  opened = AllocateDir(folder);
  while ((entry = ReadDir(opened, folder)) != NULL) {
    if (!ends_with(entry->d_name, ".stl") && !ends_with(entry->d_name, ".obj") && !ends_with(entry->d_name, ".off"))
      continue;
    if (count == room) names = repalloc_huge(names, (room *= 2) * sizeof *names);
    names[count++] = pstrdup(entry->d_name);
  }
  FreeDir(opened);
  qsort(names, count, sizeof *names, compare_names);
  for (int i = 0; i < count; ++i) {
    Datum name = CStringGetTextDatum(names[i]);
    bool is_null = false;
    tuplestore_putvalues(result->setResult, result->setDesc, &name, &is_null);
  }
  return (Datum)0;
}
