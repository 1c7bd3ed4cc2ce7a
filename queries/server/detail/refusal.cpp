#include "queries/server/detail/refusal.h"

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "queries/exchange/json_text.h"

namespace queries {
namespace {

using algebra3d::ErrorCode;

// The table of docs/http-api.md.
int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::permission_denied:
    case ErrorCode::database_read_only:
      return 403;
    case ErrorCode::interrupted:
      return 409;
    case ErrorCode::database_busy:
    case ErrorCode::database_missing:
      return 503;
    case ErrorCode::internal:
    case ErrorCode::io_error:
    case ErrorCode::database_corrupt:
    case ErrorCode::disk_full:
    case ErrorCode::out_of_memory:
      return 500;
    default:
      return 422;
  }
}

// The remedies of the language name options of the shell; a client has only the person who runs the server.
std::string_view remedy_of(const algebra3d::ErrorDescription& description) {
  switch (description.code) {
    case ErrorCode::database_missing:
      return "Put the file back, or restart the server with `--db` and the file that it should serve.";
    case ErrorCode::database_read_only:
      return "Restart the server without `--read-only`, or check the permissions of the file and its folder.";
    default:
      return description.remedy;
  }
}

void append_member(std::string& json, std::string_view name, std::string_view text) {
  append_json_string(json, name);
  json += ':';
  append_json_string(json, algebra3d::shown_as_text(text));
}

}  // namespace

std::string Refusal::json() const {
  std::string json = "{";
  append_member(json, "code", code);
  json += ',';
  append_member(json, "message", message);
  if (!remedy.empty()) {
    json += ',';
    append_member(json, "remedy", remedy);
  }
  if (place.is_known()) json += fmt::format(R"(,"line":{},"column":{})", place.line, place.column);
  return json + "}";
}

HttpAnswer Refusal::answer() const {
  HttpAnswer answer{.status = status, .body = "{\"error\":" + json() + "}\n"};
  if (status == 429 || code == "database_busy") answer.headers.emplace_back("Retry-After", "1");
  if (status == 401) answer.headers.emplace_back("WWW-Authenticate", "Bearer");
  return answer;
}

Refusal refusal_of(const algebra3d::Error& error) {
  const algebra3d::ErrorDescription& description = algebra3d::describe(error.code);
  return {status_of(error.code), std::string(description.name), error.text(), std::string(remedy_of(description)),
          error.place};
}

Refusal refusal_of_session(const algebra3d::Error& error) {
  Refusal refusal = refusal_of(error);
  if (error.code != ErrorCode::limit_exceeded) return refusal;
  refusal.status = 429;
  refusal.code = "too_many";
  refusal.remedy = "Try again when a statement has ended, or delete results.";
  return refusal;
}

}  // namespace queries
