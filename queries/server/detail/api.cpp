#include "queries/server/detail/api.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <array>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "base/memory_limit.h"
#include "queries/server/detail/pages.h"
#include "queries/server/detail/percent_coding.h"

namespace queries {
namespace {

std::vector<std::string_view> segments_of(std::string_view path) {
  std::vector<std::string_view> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::size_t end = std::min(path.find('/'), path.size());
    segments.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return segments;
}

// The parts of the path in braces, if the path matches.
std::optional<decltype(Call::path)> match(std::string_view pattern, std::string_view path) {
  const auto expected = segments_of(pattern);
  const auto found = segments_of(path);
  if (expected.size() != found.size()) return std::nullopt;
  decltype(Call::path) parts;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i].starts_with('{'))
      parts.emplace(expected[i].substr(1, expected[i].size() - 2), percent_decoded(found[i]));
    else if (expected[i] != found[i])
      return std::nullopt;
  }
  return parts;
}

SessionOptions session_options(const ServerOptions& options) {
  SessionOptions result;
  result.read_only = options.read_only;
  result.memory_bytes = memory_limit_of(options);
  // Each session has its own cache of geometry, and there may be many.
  result.cache_bytes = result.memory_bytes / 192;
  result.failure_folders = {options.failure_folder.empty() ? algebra3d::WorkMemory::default_folder()
                                                           : std::filesystem::path(options.failure_folder)};
  result.creates = false;
  result.is_shared = true;
  return result;
}

// Relative to the working directory, so that messages name files as statements do.
algebra3d::WorkingFolder confined_folder(const ServerOptions& options, const Uploads& uploads) {
  using Writing = algebra3d::WorkingFolder::Writing;
  return algebra3d::WorkingFolder::confined({}, uploads.folder(),
                                            options.read_only ? Writing::none : Writing::new_files);
}

std::optional<Refusal> refuse_parameters(const HttpRequest& request, const Route& route) {
  for (const auto& [name, value] : request.query) {
    if (std::ranges::find(route.parameters, name) == route.parameters.end())
      return Refusal::bad_request(
          route.parameters.empty()
              ? fmt::format("unknown parameter '{}'; {} {} has none", name, route.method, route.pattern)
              : fmt::format("unknown parameter '{}'; expected {}", name, fmt::join(route.parameters, ", ")));
    if (request.query.count(name) > 1)
      return Refusal::bad_request(fmt::format("the parameter '{}' is given twice", name));
  }
  return std::nullopt;
}

constexpr std::string_view kApi = "/api/";

// Memory that statements and results have freed goes back to the system. Otherwise it stays with the process, up to the
// whole heap of each thread.
void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

Api::Api(const algebra3d::Registry& registry, const ServerOptions& options, const ServerLimits& limits,
         std::string token, std::vector<SiteName> names, algebra3d::TemporaryFolder uploads, DatabaseIdentity database)
    : registry_(registry),
      options_(options),
      limits_(limits),
      guard_(std::move(names), std::move(token)),
      database_(std::move(database)),
      uploads_(std::move(uploads), options.max_upload_megabytes << 20U, limits.uploads),
      folder_(confined_folder(options, uploads_)),
      results_(limits),
      log_keeper_(database_.file(), options.read_only, limits, results_, sessions_),
      sessions_(registry, session_options(options), options.database,
                {limits.sessions, limits.idle_sessions, limits.session_patience}) {}

void Api::tend() {
  results_.drop_what_is_too_much();
  log_keeper_.tend();
  if (running_.list().empty() && has_answered_.exchange(false)) give_back_freed_memory();
}

void Api::close() {
  running_.cancel_all("the server ends");
  results_.drop_all();
}

std::span<const Route> Api::routes() {
  using Names = std::string_view;
  static constexpr std::array kRows{Names("from"), Names("count")};
  static constexpr std::array kCell{Names("row"), Names("column")};
  static constexpr std::array kShapes{Names("column"),    Names("from"),  Names("count"),
                                      Names("triangles"), Names("bytes"), Names("encoding")};
  static constexpr std::array kFile{Names("row"), Names("column"), Names("format")};
  static constexpr std::array kRoutes = {
      Route{"POST", "/api/query", &Api::post_query},
      Route{"GET", "/api/statements", &Api::get_statements},
      Route{"DELETE", "/api/statements/{id}", &Api::delete_statement},
      Route{"POST", "/api/statements/split", &Api::post_split},
      Route{"GET", "/api/results/{id}/rows", &Api::get_rows, kRows},
      Route{"GET", "/api/results/{id}/cell", &Api::get_cell, kCell},
      Route{"GET", "/api/results/{id}/shapes", &Api::get_shapes, kShapes},
      Route{"GET", "/api/results/{id}/file", &Api::get_file, kFile},
      Route{"GET", "/api/results/{id}/progress", &Api::get_progress},
      Route{"DELETE", "/api/results/{id}", &Api::delete_result},
      Route{"PUT", "/api/uploads/{name}", &Api::put_upload},
      Route{"GET", "/api/uploads", &Api::get_uploads},
      Route{"DELETE", "/api/uploads/{name}", &Api::delete_upload},
      Route{"GET", "/api/server", &Api::get_server},
      Route{"GET", "/api/objects", &Api::get_objects},
      Route{"GET", "/api/types", &Api::get_types},
      Route{"GET", "/api/operators", &Api::get_operators},
      Route{"GET", "/api/operators/{name}", &Api::get_operator},
      Route{"GET", "/api/commands", &Api::get_commands},
      Route{"GET", "/api/keywords", &Api::get_keywords},
      Route{"GET", "/api/formats", &Api::get_formats},
      Route{"GET", "/api/openapi.json", &Api::get_openapi},
  };
  return kRoutes;
}

HttpAnswer Api::answer(const HttpRequest& request) noexcept {
  has_answered_ = true;
  const std::size_t refusals = algebra3d::ProcessMemory::refusals();
  HttpAnswer answer = answer_or_refusal(request);
  // The limit counts what is in use. What is freed after it was met must not stay beside what others take.
  if (algebra3d::ProcessMemory::refusals() != refusals) give_back_freed_memory();
  return answer;
}

HttpAnswer Api::answer_or_refusal(const HttpRequest& request) noexcept {
  try {
    return answer_checked(request);
  } catch (const std::bad_alloc& failure) {
    return refusal_of(algebra3d::memory_error(failure)).answer();
  } catch (const std::exception& exception) {
    return Refusal{500, "internal", exception.what()}.answer();
  }
}

HttpAnswer Api::answer_checked(const HttpRequest& request) {
  const bool is_api = request.path.starts_with(kApi) || request.path == "/api";
  if (const auto refusal = guard_.refuse(request, is_api)) return refusal->answer();
  return is_api ? dispatch(request) : page_answer(request);
}

HttpAnswer Api::dispatch(const HttpRequest& request) {
  std::vector<std::string_view> methods;
  for (const Route& route : routes()) {
    auto parts = match(route.pattern, request.path);
    if (!parts) continue;
    if (route.method == request.method || (route.method == "GET" && request.method == "HEAD")) {
      if (const auto refusal = refuse_parameters(request, route)) return refusal->answer();
      return (this->*route.handle)({request, *std::move(parts)});
    }
    methods.push_back(route.method);
  }
  if (methods.empty()) return Refusal::not_found(fmt::format("there is no path '{}'", request.path)).answer();
  HttpAnswer answer =
      Refusal{405, "method_not_allowed",
              fmt::format("{} {}: expected {}", request.method, request.path, fmt::join(methods, " or "))}
          .answer();
  answer.headers.emplace_back("Allow", fmt::format("{}", fmt::join(methods, ", ")));
  return answer;
}

}  // namespace queries
