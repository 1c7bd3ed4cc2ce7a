#include "queries/server/detail/pages.h"

#include <algorithm>

#include <fmt/format.h>

#include "queries/server/detail/refusal.h"

namespace queries {
namespace {

constexpr std::string_view kWithoutViewer =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>algebra3d</title>"
    "<body style=\"font-family: sans-serif; max-width: 40em; margin: 4em auto\">"
    "<h1>algebra3d</h1><p>The server runs, but this program was built without the viewer: Node.js, npm or the packages "
    "of the viewer were not available then. The HTTP API is at "
    "<a href=\"/api/openapi.json\">/api/openapi.json</a>. Delete <code>build/release/viewer.stamp</code> and start "
    "<code>scripts/run serve</code>, which installs them and builds again.</p></body></html>\n";

// The names of Vite's assets have a hash of their content.
bool is_immutable(std::string_view path) {
  return path.starts_with("/assets/");
}

}  // namespace

HttpAnswer page_answer(const HttpRequest& request) {
  if (request.method != "GET" && request.method != "HEAD") {
    HttpAnswer answer =
        Refusal{405, "method_not_allowed", fmt::format("{} {}: expected GET", request.method, request.path)}.answer();
    answer.headers.emplace_back("Allow", "GET");
    return answer;
  }
  const std::string_view path = request.path == "/" ? "/index.html" : std::string_view(request.path);
  const auto files = viewer_files();
  const auto found = std::ranges::find(files, path, &EmbeddedFile::path);
  if (found != files.end()) {
    HttpAnswer answer{.type = std::string(found->type), .body = std::string(found->bytes)};
    answer.headers.emplace_back("Content-Encoding", "gzip");  // unless the client does not take it
    answer.headers.emplace_back("Vary", "Accept-Encoding");
    answer.headers.emplace_back("Cache-Control",
                                is_immutable(path) ? "public, max-age=31536000, immutable" : "no-cache");
    return answer;
  }
  if (files.empty() && path == "/index.html")
    return {.type = "text/html; charset=utf-8", .body = std::string(kWithoutViewer)};
  return Refusal::not_found(fmt::format("there is no page '{}'", request.path)).answer();
}

}  // namespace queries
