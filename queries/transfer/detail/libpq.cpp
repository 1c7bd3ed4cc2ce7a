#include "queries/transfer/detail/libpq.h"

#include <dlfcn.h>

#include <string>

#include "base/propagate.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

constexpr const char* kLibrary = "libpq.so.5";

Error no_library(const std::string& reason) {
  return {ErrorCode::file_missing,
          "the library {} of PostgreSQL's clients cannot be used ({}); the Debian package libpq5 has it", kLibrary,
          reason};
}

/// Looks up functions by name; remembers the first that is missing.
class Symbols {
 public:
  explicit Symbols(void* library) : library_(library) {}

  template <typename Function>
  void find(Function& function, const char* name) {
    void* const symbol = dlsym(library_, name);
    if (symbol == nullptr && missing_.empty()) missing_ = name;
    function = reinterpret_cast<Function>(symbol);  // NOLINT(*-reinterpret-cast): what POSIX says of dlsym
  }
  const std::string& missing() const { return missing_; }

 private:
  void* library_;
  std::string missing_;
};

void find_connecting(Symbols& symbols, Libpq& pq) {
  symbols.find(pq.parse_conninfo, "PQconninfoParse");
  symbols.find(pq.free_conninfo, "PQconninfoFree");
  symbols.find(pq.connect_start, "PQconnectStartParams");
  symbols.find(pq.connect_poll, "PQconnectPoll");
  symbols.find(pq.finish, "PQfinish");
  symbols.find(pq.status, "PQstatus");
  symbols.find(pq.socket, "PQsocket");
  symbols.find(pq.server_version, "PQserverVersion");
  symbols.find(pq.database, "PQdb");
  symbols.find(pq.error_message, "PQerrorMessage");
  symbols.find(pq.set_notice_receiver, "PQsetNoticeReceiver");
  symbols.find(pq.set_nonblocking, "PQsetnonblocking");
  symbols.find(pq.cancel_key, "PQgetCancel");
  symbols.find(pq.free_cancel_key, "PQfreeCancel");
  symbols.find(pq.request_cancel, "PQcancel");
}

void find_asking(Symbols& symbols, Libpq& pq) {
  symbols.find(pq.send_query, "PQsendQuery");
  symbols.find(pq.send_query_params, "PQsendQueryParams");
  symbols.find(pq.flush, "PQflush");
  symbols.find(pq.consume_input, "PQconsumeInput");
  symbols.find(pq.is_busy, "PQisBusy");
  symbols.find(pq.get_answer, "PQgetResult");
  symbols.find(pq.put_copy_data, "PQputCopyData");
  symbols.find(pq.put_copy_end, "PQputCopyEnd");
  symbols.find(pq.get_copy_data, "PQgetCopyData");
  symbols.find(pq.free_memory, "PQfreemem");
  symbols.find(pq.answer_status, "PQresultStatus");
  symbols.find(pq.answer_field, "PQresultErrorField");
  symbols.find(pq.answer_error, "PQresultErrorMessage");
  symbols.find(pq.affected, "PQcmdTuples");
  symbols.find(pq.row_count, "PQntuples");
  symbols.find(pq.column_count, "PQnfields");
  symbols.find(pq.cell, "PQgetvalue");
  symbols.find(pq.cell_is_null, "PQgetisnull");
  symbols.find(pq.cell_size, "PQgetlength");
  symbols.find(pq.clear, "PQclear");
}

Result<Libpq> loaded() {
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return no_library(dlerror());
  Libpq pq{};
  Symbols symbols(library);
  find_connecting(symbols, pq);
  find_asking(symbols, pq);
  if (!symbols.missing().empty()) return no_library("it has no function " + symbols.missing());
  return pq;
}

}  // namespace

Result<const Libpq*> Libpq::load() {
  static const Result<Libpq> library = loaded();
  if (!library) return library.error();
  return &*library;
}

}  // namespace queries
