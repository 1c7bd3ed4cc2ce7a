// Running, listing and cancelling statements.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "algebra3d/base/error.h"
#include "queries/language/command_reader.h"
#include "queries/server/detail/api.h"
#include "queries/server/detail/http.h"
#include "queries/server/detail/result_json.h"

namespace queries {
namespace {

/// The number of UTF-16 code units of a UTF-8 text: the unit of positions in JavaScript.
std::size_t utf16_units(std::string_view text) {
  std::size_t units = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80) units += byte >= 0xF0 ? 2 : 1;
  }
  return units;
}

/// The byte at a line and column, both from 1; columns count bytes, without a byte order mark at the beginning.
std::size_t byte_offset(std::string_view text, const algebra3d::SourcePlace& place) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::size_t begin = place.line == 1 && text.starts_with(kMark) ? kMark.size() : 0;
  for (int line = 1; line < place.line; ++line) begin = text.find('\n', begin) + 1;
  return begin + static_cast<std::size_t>(place.column) - 1;
}

/// Writes server-sent events. Source: WHATWG HTML, section 9.2.
class EventStream {
 public:
  explicit EventStream(const SendPiece& send) : send_(send) {}
  /// Sends an event. False if the client is gone.
  bool send(std::string_view event, std::string json) {
    std::ranges::replace(json, '\n', ' ');  // a line end would end the data, and is white space in JSON
    is_open_ = is_open_ && send_(fmt::format("event: {}\ndata: {}\n\n", event, json));
    return is_open_;
  }
  bool is_open() const { return is_open_; }

 private:
  const SendPiece& send_;
  bool is_open_ = true;
};

// How often a request that waits for its statement looks after the client and the time limit.
constexpr std::chrono::milliseconds kLook(100);

Reply<std::string> whole_body(const HttpRequest& request, std::size_t limit) {
  std::string body;
  if (request.body == nullptr) return body;
  const Body::Outcome outcome = request.body->read(limit, [&](std::string_view piece) {
    body += piece;
    return true;
  });
  if (outcome != Body::Outcome::complete) return refusal_of(outcome, limit);
  return body;
}

// A command as it stands in a text, without what divides it from the next.
std::string_view without_end(std::string_view command) {
  const std::size_t last = command.find_last_not_of(" \t\r\n;");
  return command.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

// The name that a client has given itself; empty for none.
Reply<std::string> client_of(const HttpRequest& request) {
  constexpr const char* kHeader = "x-algebra3d-client";
  const std::size_t count = request.headers.count(kHeader);
  if (count == 0) return std::string();
  std::string name = request.header(kHeader);
  if (count == 1 && is_id(name)) return name;
  return Refusal::bad_request(fmt::format("the header 'X-Algebra3d-Client': expected {}", kIdForm));
}

bool wants_events(const HttpRequest& request) {
  return request.header("accept").find("text/event-stream") != std::string::npos;
}

}  // namespace

Reply<std::shared_ptr<Execution>> Api::start(const HttpRequest& request) {
  Reply<std::string> client = client_of(request);
  if (!client) return client.refusal();
  Reply<std::string> body = whole_body(request, limits_.statement_bytes);
  if (!body) return body.refusal();
  if (const Status there = database_.check(); !there) return refusal_of(there.error());
  Reply<StatementRequest> read = read_query_request(*body, registry_, results_);
  if (!read) return read.refusal();
  StatementRequest statement = *std::move(read);
  statement.client = *std::move(client);
  results_.make_room();
  if (statement.id.empty()) statement.id = running_.new_id();
  const auto execution = std::make_shared<Execution>(std::move(statement), folder_);
  if (!running_.add(execution))
    return Refusal::bad_request(fmt::format("'id': a statement '{}' runs already", execution->request().id));
  if (sessions_.is_crowded()) results_.release_sessions();
  const Status started = sessions_.run([execution](Session& session) { execution->run(session); });
  if (started) return execution;
  running_.remove(execution->request().id);
  return refusal_of_session(started.error());
}

void Api::await(Execution& execution, const Connection* connection, const std::function<void()>& each_time) {
  while (execution.wait_until(Execution::Clock::now() + kLook) == nullptr) {
    if (connection != nullptr && connection->is_gone()) execution.cancel("the client has gone");
    if (options_.max_seconds > 0 && execution.seconds() > options_.max_seconds)
      execution.cancel(fmt::format("the statement ran longer than {} s", options_.max_seconds));
    each_time();
  }
  running_.remove(execution.request().id);
  if (connection != nullptr && connection->is_gone()) execution.drop();
}

std::string Api::json_of_answer(const std::shared_ptr<Execution>& execution, const StatementAnswer& answer) {
  std::string json = fmt::format(R"({{"type":{},"value":{},"diagnostics":{},"seconds":{:.6f})", answer.type,
                                 answer.value, json_strings(answer.diagnostics), answer.seconds);
  if (execution->has_result())
    json += fmt::format(R"(,"result":{{"id":{},"count":{},"columns":{}}})", json_string(results_.keep(execution)),
                        answer.count, answer.columns);
  return json + "}";
}

HttpAnswer Api::await_answer(const std::shared_ptr<Execution>& execution, const Connection* connection) {
  await(*execution, connection, [] {});
  const Result<StatementAnswer>& answer = *execution->wait_until({});
  if (!answer) return refusal_of(answer.error()).answer();
  return {.body = json_of_answer(execution, *answer) + "\n"};
}

HttpAnswer Api::stream_answer(const std::shared_ptr<Execution>& execution, const Connection* connection) {
  HttpAnswer stream{.type = "text/event-stream"};
  stream.headers.emplace_back("Cache-Control", "no-store");
  stream.stream = [this, execution, connection](const SendPiece& send) {
    EventStream events(send);
    events.send("started", fmt::format(R"({{"id":{}}})", json_string(execution->request().id)));
    std::string told;
    await(*execution, connection, [&] {
      if (std::string text = execution->progress(); text != told) {
        told = std::move(text);
        events.send("progress",
                    fmt::format(R"({{"text":{},"seconds":{:.3f}}})", json_string(told), execution->seconds()));
      }
      if (!events.is_open()) execution->cancel("the client has gone");
    });
    const Result<StatementAnswer>& answer = *execution->wait_until({});
    if (answer) return (void)events.send("result", json_of_answer(execution, *answer));
    const Refusal refusal = refusal_of(answer.error());
    std::string json = refusal.json();
    json.back() = ',';
    events.send("error", json + fmt::format(R"("status":{}}})", refusal.status));
  };
  return stream;
}

HttpAnswer Api::post_query(const Call& call) {
  Reply<std::shared_ptr<Execution>> execution = start(call.request);
  if (!execution) return execution.refusal().answer();
  return wants_events(call.request) ? stream_answer(*execution, call.request.connection)
                                    : await_answer(*execution, call.request.connection);
}

HttpAnswer Api::get_statements(const Call&) {
  std::string json = "[";
  for (const auto& execution : running_.list()) {
    if (json.size() > 1) json += ',';
    json += fmt::format(R"({{"id":{},"statement":{},"seconds":{:.3f},"progress":{}}})",
                        json_string(execution->request().id), json_string(execution->request().text),
                        execution->seconds(), json_string(execution->progress()));
  }
  return {.body = json + "]\n"};
}

HttpAnswer Api::delete_statement(const Call& call) {
  const std::string& id = call.path.find("id")->second;
  if (running_.cancel(id, "the statement was cancelled")) return {.status = 204};
  return Refusal::not_found(fmt::format("no statement '{}' runs", id)).answer();
}

// NOLINTNEXTLINE(readability-make-member-function-const): all handlers have one type
HttpAnswer Api::post_split(const Call& call) {
  Reply<std::string> body = whole_body(call.request, limits_.statement_bytes);
  if (!body) return body.refusal().answer();
  Reply<nlohmann::json> parsed = parse_body(*body);
  if (!parsed) return parsed.refusal().answer();
  const nlohmann::json given = *std::move(parsed);
  if (!given.is_object() || given.size() != 1 || !given.contains("text") || !given["text"].is_string())
    return Refusal::bad_request("expected an object with the member 'text'").answer();
  const auto text = given["text"].get<std::string>();
  std::string json = "[";
  const std::vector<CommandText> commands = commands_of(text);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const CommandText& command = commands[i];
    const std::size_t begin = byte_offset(text, command.start);
    const std::size_t next = i + 1 < commands.size() ? byte_offset(text, commands[i + 1].start) : text.size();
    const std::string_view own = without_end(std::string_view(text).substr(begin, next - begin));
    const std::size_t units = utf16_units(std::string_view(text).substr(0, begin));
    if (json.size() > 1) json += ',';
    json += fmt::format(R"({{"text":{},"line":{},"column":{},"begin":{},"end":{}}})", json_string(command.text),
                        command.start.line, command.start.column, units, units + utf16_units(own));
  }
  return {.body = json + "]\n"};
}

}  // namespace queries
