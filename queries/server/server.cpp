#include "queries/server/server.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>

#include "base/polled_input.h"
#include "base/propagate.h"
#include "base/temporary_folder.h"
#include "queries/server/detail/api.h"
#include "queries/server/detail/http_listener.h"
#include "queries/store/database_creation.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestTokenFile = std::size_t{1} << 20U;

std::string first_line(const std::string& text) {
  return text.substr(0, text.find_first_of("\r\n"));
}

// The token; empty for none.
Result<std::string> token_of(const ServerOptions& options, const std::atomic<bool>& end) {
  std::string token;
  if (!options.token_file.empty()) {
    const auto file = algebra3d::PolledInput::open(options.token_file);
    auto content = file ? algebra3d::PolledInput(file->number(), &end).read_all(kLongestTokenFile, "the file")
                        : algebra3d::Result<std::string>(file.error());
    if (!content && content.error().code == ErrorCode::interrupted) return std::move(content).error();
    if (!content)
      return Error{ErrorCode::wrong_usage, "--token-file: '{}' cannot be read: {}", options.token_file.string(),
                   content.error().text()};
    token = first_line(*content);
  } else if (const char* const given = std::getenv("ALGEBRA3D_TOKEN"); given != nullptr) {
    token = given;
  }
  const bool is_wanted = !options.token_file.empty() || !token.empty();
  if (is_wanted && (token.size() < kShortestToken || token.find_first_of(" \t\r\n") != std::string::npos))
    return Error{ErrorCode::wrong_usage, "the token must have at least {} characters and no blanks", kShortestToken};
  return token;
}

// The file is there afterwards. A mistyped name makes no database.
Status prepare_database(const ServerOptions& options, const algebra3d::Registry& registry,
                        const std::function<void(const std::string&)>& note) {
  if (!options.creates && makes_database(options.database)) {
    std::error_code unknown;
    const bool is_empty = std::filesystem::exists(options.database, unknown);
    return Error{ErrorCode::database_missing, "{} '{}'{}",
                 is_empty ? "no database, but an empty file, is at" : "there is no database", options.database.string(),
                 options.read_only ? "" : "; with --create a new, empty one is made"};
  }
  Session session(registry, {.read_only = options.read_only, .creates = options.creates});
  A3D_TRY(session.open_file(options.database));
  if (const std::string notice = session.store()->opening_notice(); !notice.empty()) note(notice);
  if (session.has_made_database())
    note("there was no database '" + options.database.string() + "'; a new, empty one was made");
  return {};
}

std::string url_of(const std::string& address, int port) {
  const bool is_any = address == "0.0.0.0" || address == "::";
  const std::string host = is_any ? "127.0.0.1" : address;
  return fmt::format("http://{}:{}/", host.find(':') == std::string::npos ? host : "[" + host + "]", port);
}

// A quarter of the descriptors that the process may have, which become as many as the system allows: a session takes
// three of them, a connection one, and so does a result.
std::size_t quarter_of_descriptors() {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) == 0) {
    files.rlim_cur = files.rlim_max;
    setrlimit(RLIMIT_NOFILE, &files);
    getrlimit(RLIMIT_NOFILE, &files);
  }
  return std::max<std::size_t>(files.rlim_cur / 4, 16);
}

}  // namespace

Status serve(const ServerOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>& stop,
             const std::function<void(const std::string&)>& ready,
             const std::function<void(const std::string&)>& note) {
  constexpr std::size_t kMostUnanswered = 1024;
  ServerLimits limits;
  const std::size_t descriptors = quarter_of_descriptors();
  limits.results = std::min(limits.results, descriptors);
  const ListenerLimits connections{.requests = limits.connections,
                                   .unanswered = std::min(descriptors, kMostUnanswered)};
  A3D_ASSIGN(std::string token, token_of(options, stop));
  if (!is_loopback(options.listen) && token.empty())
    return Error{ErrorCode::wrong_usage,
                 "--listen {}: without a token the server listens to loopback addresses only; give one by --token-file "
                 "or ALGEBRA3D_TOKEN",
                 options.listen};
  std::vector<SiteName> further_names;
  for (const std::string& text : options.hosts) {
    A3D_ASSIGN(SiteName name, site_name(text));
    further_names.push_back(std::move(name));
  }
  std::vector<std::string> embedders;
  for (const std::string& text : options.embedders) {
    A3D_ASSIGN(std::string origin, embedding_origin(text));
    embedders.push_back(std::move(origin));
  }
  A3D_TRY(prepare_database(options, registry, note));
  A3D_ASSIGN(DatabaseIdentity database, DatabaseIdentity::of(options.database));
  A3D_ASSIGN(const auto listener,
             HttpListener::bind(options.listen, options.port, connections, common_headers(embedders)));
  A3D_ASSIGN(algebra3d::TemporaryFolder uploads, algebra3d::TemporaryFolder::make());
  Api api(registry, options, limits, token, site_names(options.listen, listener->port(), std::move(further_names)),
          std::move(uploads), std::move(database));
  auto tended = std::chrono::steady_clock::now();
  std::thread answering([&] { listener->run([&api](const HttpRequest& request) { return api.answer(request); }); });
  ready(url_of(options.listen, listener->port()) + (token.empty() ? "" : "#token=" + token));
  while (!stop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (const auto now = std::chrono::steady_clock::now(); now - tended > std::chrono::seconds(1)) {
      api.tend();
      tended = now;
    }
  }
  api.close();
  listener->stop();
  answering.join();
  return {};
}

}  // namespace queries
