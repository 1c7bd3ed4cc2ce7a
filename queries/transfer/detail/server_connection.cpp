#include "queries/transfer/detail/server_connection.h"

#include <poll.h>

#include <cerrno>
#include <cstring>
#include <future>
#include <thread>

#include <fmt/format.h>

#include "algebra3d/base/monitor.h"
#include "base/propagate.h"
#include "base/text.h"

namespace queries {
namespace {

/// How often the flag of an interrupt is looked at while nothing arrives.
constexpr int kPatienceMilliseconds = 50;

std::string text_or_empty(const char* text) {
  return text != nullptr ? text : "";
}

bool is_cancelled(const std::atomic<bool>* cancel) {
  return cancel != nullptr && cancel->load(std::memory_order_relaxed);
}

ErrorCode code_of(std::string_view sql_state) {
  if (sql_state == "42501") return ErrorCode::permission_denied;
  if (sql_state == "53100") return ErrorCode::disk_full;
  if (sql_state.starts_with("25006")) return ErrorCode::database_read_only;
  return ErrorCode::io_error;
}

/// The notice as a line, for people.
void take_notice(void* argument, const Libpq::Answer* answer) {
  const auto& host = *static_cast<const ServerHost*>(argument);
  const std::string text = text_or_empty(host.pq.answer_field(answer, Libpq::kPrimary));
  if (host.note && !text.empty()) host.note("the server says: " + algebra3d::one_line(text));
}

/// The conninfo as it is, with what we demand behind it.
struct ConnectionParameters {
  std::vector<const char*> keywords, values;
  void add(const char* keyword, const char* value) {
    keywords.push_back(keyword);
    values.push_back(value);
  }
};

}  // namespace

std::string ServerAnswer::text(int row, int column) const {
  return {pq_->cell(answer_.get(), row, column), static_cast<std::size_t>(pq_->cell_size(answer_.get(), row, column))};
}

std::string ServerAnswer::sql_state() const {
  return text_or_empty(pq_->answer_field(answer_.get(), Libpq::kSqlState));
}

Status ServerAnswer::check() const {
  const int found = status();
  if (found == Libpq::kCommandOk || found == Libpq::kTuplesOk || found == Libpq::kCopyIn || found == Libpq::kCopyOut ||
      found == Libpq::kEmptyQuery)
    return {};
  const auto field = [&](int which) { return text_or_empty(pq_->answer_field(answer_.get(), which)); };
  std::string text = field(Libpq::kPrimary);
  if (text.empty()) text = text_or_empty(pq_->answer_error(answer_.get()));
  for (const int which : {Libpq::kDetail, Libpq::kHint, Libpq::kContext})
    if (const std::string more = field(which); !more.empty()) text += "; " + more;
  const std::string state = sql_state();
  const std::string shown = algebra3d::one_line(text);
  if (state.empty()) return Error{ErrorCode::io_error, "the connection to the server is lost: {}", shown};
  return Error{code_of(state), "the server says: {} (SQL state {})", shown, state};
}

Result<std::unique_ptr<ServerConnection>> ServerConnection::open(const ServerHost& host, const std::string& conninfo) {
  char* message = nullptr;
  Libpq::Option* const options = host.pq.parse_conninfo(conninfo.c_str(), &message);
  if (options == nullptr) {
    const std::string reason = algebra3d::one_line(text_or_empty(message));
    host.pq.free_memory(message);
    return Error{ErrorCode::wrong_usage,
                 "--pg: {}; expected as in 'host=HOST dbname=NAME user=NAME', or postgresql://...", reason};
  }
  host.pq.free_conninfo(options);
  ConnectionParameters parameters;
  parameters.add("dbname", conninfo.c_str());
  parameters.add("client_encoding", "UTF8");
  parameters.add("fallback_application_name", "algebra3d");
  parameters.add(nullptr, nullptr);
  std::unique_ptr<ServerConnection> made(
      new ServerConnection(host, host.pq.connect_start(parameters.keywords.data(), parameters.values.data(), 1)));
  if (made->handle() == nullptr) return Error{ErrorCode::out_of_memory, "no memory for a connection"};
  A3D_TRY(made->establish());
  return made;
}

Status ServerConnection::establish() {
  const auto failed = [&] {
    return Error{ErrorCode::io_error, "the server cannot be reached: {}",
                 algebra3d::one_line(pq().error_message(handle()))};
  };
  if (pq().status(handle()) == Libpq::kConnectionBad) return failed();
  pq().set_notice_receiver(handle(), take_notice, &host_);
  for (int state = Libpq::kPollingWriting; state != Libpq::kPollingOk; state = pq().connect_poll(handle())) {
    if (state == Libpq::kPollingFailed) return failed();
    A3D_TRY(wait_alone(state == Libpq::kPollingWriting));
  }
  if (pq().set_nonblocking(handle(), 1) != 0) return lost();
  return {};
}

Error ServerConnection::lost() const {
  return {ErrorCode::io_error, "the connection to the server is lost: {}",
          algebra3d::one_line(pq().error_message(handle()))};
}

Status ServerConnection::wait(const std::vector<Waiting>& connections, const std::atomic<bool>* cancel) {
  std::vector<pollfd> sockets;
  for (const Waiting& each : connections) {
    const int socket = each.connection->pq().socket(each.connection->handle());
    if (socket < 0) return each.connection->lost();
    sockets.push_back({socket, static_cast<short>(POLLIN | (each.is_writing ? POLLOUT : 0)), 0});
  }
  while (true) {
    if (is_cancelled(cancel)) return algebra3d::Monitor::interrupted();
    const int ready = poll(sockets.data(), sockets.size(), kPatienceMilliseconds);
    if (ready > 0) return {};
    if (ready < 0 && errno != EINTR) return Error{ErrorCode::io_error, "poll: {}", std::strerror(errno)};
  }
}

Status ServerConnection::flush() {
  while (true) {
    const int state = pq().flush(handle());
    if (state == 0) return {};
    if (state < 0) return lost();
    A3D_TRY(wait_alone(true));
    if (pq().consume_input(handle()) == 0) return lost();
  }
}

// NOLINTNEXTLINE(readability-make-member-function-const): it changes the connection
Status ServerConnection::send(const std::string& sql) {
  if (pq().send_query(handle(), sql.c_str()) == 0) return lost();
  return {};
}

// NOLINTNEXTLINE(readability-make-member-function-const): likewise
Result<std::optional<ServerAnswer>> ServerConnection::next_answer_if_ready(bool& is_ready) {
  is_ready = pq().is_busy(handle()) == 0;
  if (!is_ready) return std::optional<ServerAnswer>();
  Libpq::Answer* const answer = pq().get_answer(handle());
  if (answer == nullptr) return std::optional<ServerAnswer>();
  return std::optional<ServerAnswer>(std::in_place, pq(), answer);
}

Result<std::optional<ServerAnswer>> ServerConnection::next_answer() {
  A3D_TRY(flush());
  while (true) {
    bool is_ready = false;
    A3D_ASSIGN(auto answer, next_answer_if_ready(is_ready));
    if (is_ready) return answer;
    A3D_TRY(wait_alone(false));
    // The reason of a failure may be in what was read: it is the next answer.
    if (pq().consume_input(handle()) == 0 && pq().is_busy(handle()) != 0) return lost();
  }
}

Result<ServerAnswer> ServerConnection::query(const std::string& sql, const std::vector<std::string>& parameters) {
  std::vector<const char*> values;
  values.reserve(parameters.size());
  for (const std::string& each : parameters) values.push_back(each.c_str());
  const int sent = values.empty() ? pq().send_query(handle(), sql.c_str())
                                  : pq().send_query_params(handle(), sql.c_str(), static_cast<int>(values.size()),
                                                           nullptr, values.data(), nullptr, nullptr, 0);
  if (sent == 0) return lost();
  std::optional<ServerAnswer> last;
  Status status;
  while (true) {
    auto answer = next_answer();
    if (!answer) {
      if (answer.error().code == ErrorCode::interrupted) request_cancel();
      return std::move(answer).error();
    }
    if (!*answer) break;
    if (status) status = (*answer)->check();
    last = std::move(*answer);
  }
  if (!status) return std::move(status).error();
  if (!last) return lost();
  return *std::move(last);
}

Result<std::optional<ServerConnection::Copied>> ServerConnection::next_copied() {
  while (true) {
    char* bytes = nullptr;
    const int size = pq().get_copy_data(handle(), &bytes, 1);
    if (size > 0) return std::optional(Copied{{bytes, pq().free_memory}, static_cast<std::size_t>(size)});
    if (size == -1) return std::optional<Copied>();
    if (size == -2) return lost();
    A3D_TRY(wait_alone(false));
    if (pq().consume_input(handle()) == 0) return lost();
  }
}

// libpq waits for the server's answer to the request, which a network may never bring; so it does on another thread.
void ServerConnection::request_cancel() const {
  constexpr std::chrono::milliseconds kPatience{100};
  Libpq::CancelKey* const key = pq().cancel_key(handle());
  if (key == nullptr) return;
  auto done = std::make_shared<std::promise<void>>();
  const std::future<void> is_done = done->get_future();
  std::thread([&library = host_.pq, key, done] {
    char reason[256];
    library.request_cancel(key, reason, sizeof reason);
    library.free_cancel_key(key);
    done->set_value();
  }).detach();
  is_done.wait_for(kPatience);
}

std::string quoted_identifier(std::string_view name) {
  return '"' + algebra3d::with_replaced(std::string(name), "\"", "\"\"") + '"';
}

}  // namespace queries
