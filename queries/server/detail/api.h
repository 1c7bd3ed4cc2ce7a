#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/server/detail/database_identity.h"
#include "queries/server/detail/http.h"
#include "queries/server/detail/kept_results.h"
#include "queries/server/detail/log_keeper.h"
#include "queries/server/detail/query_request.h"
#include "queries/server/detail/request_guard.h"
#include "queries/server/detail/running_statements.h"
#include "queries/server/detail/session_pool.h"
#include "queries/server/detail/uploads.h"
#include "queries/server/server_options.h"

namespace queries {

/// A request whose path has matched a route.
struct Call {
  const HttpRequest& request;
  std::map<std::string, std::string, std::less<>> path = {};  ///< the parts of the path in braces
};

class Api;
/// A path of the API and its method.
struct Route {
  std::string_view method;
  std::string_view pattern;  ///< `/api/results/{id}/rows`
  HttpAnswer (Api::*handle)(const Call& call);
  std::span<const std::string_view> parameters = {};  ///< that may stand after `?`
};

/// The HTTP API (docs/http-api.md) without the network: requests in, answers out. `answer` may be called by any number
/// of threads.
class Api {
 public:
  Api(const algebra3d::Registry& registry, const ServerOptions& options, const ServerLimits& limits, std::string token,
      std::vector<SiteName> names, algebra3d::TemporaryFolder uploads, DatabaseIdentity database);

  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;
  ~Api() { close(); }

  /// Answers any request; never throws.
  HttpAnswer answer(const HttpRequest& request) noexcept;
  /// To be called about every second: drops results that nobody uses, keeps the log of the database short, and while no
  /// statement runs, gives freed memory back to the system.
  void tend();
  /// Ends all statements and drops all results.
  void close();

  static std::span<const Route> routes();

 private:
  HttpAnswer answer_or_refusal(const HttpRequest& request) noexcept;
  HttpAnswer answer_checked(const HttpRequest& request);
  HttpAnswer dispatch(const HttpRequest& request);

  // statement_routes.cpp
  HttpAnswer post_query(const Call& call);
  HttpAnswer get_statements(const Call& call);
  HttpAnswer delete_statement(const Call& call);
  HttpAnswer post_split(const Call& call);
  Reply<std::shared_ptr<Execution>> start(const HttpRequest& request);
  void await(Execution& execution, const Connection* connection, const std::function<void()>& each_time);
  HttpAnswer await_answer(const std::shared_ptr<Execution>& execution, const Connection* connection);
  HttpAnswer stream_answer(const std::shared_ptr<Execution>& execution, const Connection* connection);
  std::string json_of_answer(const std::shared_ptr<Execution>& execution, const StatementAnswer& answer);

  // result_routes.cpp
  HttpAnswer get_rows(const Call& call);
  HttpAnswer get_cell(const Call& call);
  HttpAnswer get_shapes(const Call& call);
  HttpAnswer get_file(const Call& call);
  HttpAnswer get_progress(const Call& call);
  HttpAnswer delete_result(const Call& call);

  // upload_routes.cpp
  HttpAnswer put_upload(const Call& call);
  HttpAnswer get_uploads(const Call& call);
  HttpAnswer delete_upload(const Call& call);

  // database_routes.cpp
  HttpAnswer get_server(const Call& call);
  HttpAnswer get_objects(const Call& call);
  HttpAnswer get_types(const Call& call);
  HttpAnswer get_operators(const Call& call);
  HttpAnswer get_operator(const Call& call);
  HttpAnswer get_commands(const Call& call);
  HttpAnswer get_keywords(const Call& call);
  HttpAnswer get_formats(const Call& call);
  HttpAnswer get_openapi(const Call& call);

  const algebra3d::Registry& registry_;
  const ServerOptions options_;
  const ServerLimits limits_;
  const RequestGuard guard_;
  const DatabaseIdentity database_;
  Uploads uploads_;
  const algebra3d::WorkingFolder folder_;
  RunningStatements running_;
  std::atomic<bool> has_answered_ = false;  // since freed memory was last given back
  KeptResults results_;
  LogKeeper log_keeper_;
  SessionPool sessions_;  // its work uses all of the above
};

}  // namespace queries
