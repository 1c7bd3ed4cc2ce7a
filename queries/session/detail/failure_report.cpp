#include "queries/session/detail/failure_report.h"

#include <cerrno>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/version.h"
#include "base/file_error.h"
#include "base/propagate.h"
#include "queries/language/command_reader.h"
#include "queries/session/session.h"
#include "queries/streams/datum.h"

namespace queries {
namespace {

namespace fs = std::filesystem;
using algebra3d::FailedCall;
using algebra3d::OperatorKind;

/// The lines of a text as comments of a script.
std::string commented(std::string_view text) {
  std::string lines = "# ";
  for (const char c : text) {
    if (c == '\r') continue;
    lines += c;
    if (c == '\n') lines += "# ";
  }
  return lines + "\n";
}

NestedList symbol_atom(std::string_view name) {
  return NestedList::symbol(std::string(name));
}

/// `(const volume3d value (...))`
std::string constant_text(const Value& value) {
  return NestedList::list(symbol_atom("const"), value.type().term().to_nested(), symbol_atom("value"),
                          value.to_nested())
      .print();
}

/// `(feed (const (rel (tuple ((Elem int)))) value ((1) (2))))`
std::string stream_text(const FailedCall& call) {
  std::string text = fmt::format("(feed (const (rel (tuple ((Elem {})))) value (",
                                 call.overload->parameters.front().type->term().text());
  for (const Value& value : call.arguments) text += "\n  (" + value.to_nested().print() + ")";
  return text + ")))";
}

/// The command that calls the operator with its arguments, as a nested list with a line for each argument.
std::string command_text(const FailedCall& call) {
  const OperatorKind kind = call.overload->kind();
  if (kind == OperatorKind::aggregate) return fmt::format("(query ({} {} Elem))", call.op->name, stream_text(call));
  std::string text = "(" + call.op->name;
  for (const Value& argument : call.arguments) text += "\n  " + constant_text(argument);
  text += ")";
  // Rows are made when they are asked for.
  return kind == OperatorKind::table ? "(query (count " + text + "))" : "(query " + text + ")";
}

/// Why the notation of a value does not give this value; empty if it does.
std::string notation_gap(const Value& value, const algebra3d::Context& surroundings) {
  algebra3d::Diagnostics reasons;
  algebra3d::Context context{.diagnostics = reasons, .cancel = surroundings.cancel, .folder = surroundings.folder};
  const auto list = NestedList::parse(value.to_nested().print());
  if (!list) return list.error().text();
  const auto read = value_from_nested(value.type(), *list, context);
  if (!read) return read.error().text();
  if (compare(*read, value) == 0) return "";
  const std::vector<std::string> lines = reasons.summary();
  return lines.empty() ? "it gives another value" : lines.front();
}

/// Whether a script can hold the command: a line that is empty or begins with `#` ends or disturbs it, in strings, too.
bool is_whole_in_script(const std::string& command) {
  CommandReader reader;
  for (std::size_t begin = 0; begin <= command.size();) {
    const std::size_t end = std::min(command.find('\n', begin), command.size());
    if (!reader.add_line(std::string_view(command).substr(begin, end - begin)).empty()) return false;
    begin = end + 1;
  }
  const std::optional<CommandText> read = reader.finish();
  return read && read->text == command;
}

std::string call_report(const FailedCall& call, const FailedStatement& statement, const algebra3d::Context& context) {
  const std::string command = command_text(call);
  std::string text =
      commented(fmt::format("algebra3d {}: the operator {} ended with the error internal.", algebra3d::kVersion,
                            call.op->name)) +
      commented(fmt::format("Message: {}", call.error.text())) +
      commented("To repeat the failure: algebra3d THIS_FILE") +
      commented("The arguments are exact. Please report the failure with this file, if you may give them away.");
  for (std::size_t place = 0; place < call.arguments.size(); ++place)
    if (const std::string gap = notation_gap(call.arguments[place], context); !gap.empty())
      text += commented(fmt::format("Not exact: the constant for argument {} is not the argument: {}", place + 1, gap));
  if (!is_whole_in_script(command))
    text += commented(
        "Not exact: a string has a line that is empty, begins with '#' or ends with a carriage return, which no script "
        "can hold.");
  if (call.op->reads_files || call.op->writes_files)
    text += commented(fmt::format("The operator uses files; relative names start in {}", statement.folder.string()));
  return text + command + "\n";
}

std::string parameter_line(const std::string& name, const SessionParameter& parameter) {
  if (const auto* constant = std::get_if<WrittenConstant>(&parameter))
    return fmt::format("${} was (const {} value {})", name, constant->type, constant->list.print());
  return fmt::format("${} was {}", name, constant_text(std::get<HostValue>(parameter).value));
}

std::string statement_report(const FailedStatement& statement, std::string_view reason) {
  std::string text =
      commented(fmt::format("algebra3d {}: a statement ended with the error internal.", algebra3d::kVersion)) +
      commented(fmt::format("Message: {}", statement.error.text())) +
      commented(fmt::format("This is the statement, and not the call that failed: {}.", reason));
  if (statement.database.empty())
    text += commented("To repeat the failure: algebra3d THIS_FILE");
  else
    text += commented(fmt::format("To repeat the failure, with the database as it was: algebra3d --db {} THIS_FILE",
                                  fs::absolute(statement.database).string()));
  for (const auto& [name, parameter] : statement.parameters.values) text += commented(parameter_line(name, parameter));
  return text + std::string(statement.text) + "\n";
}

constexpr int kMostReports = 100;

/// 0, or the reason for which not all bytes could be written.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// A new file, or none if there is one of that name. Half a file is removed.
Result<bool> write_new_file(const fs::path& file, std::string_view bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // NOLINT(*-vararg)
  if (descriptor < 0 && errno == EEXIST) return false;
  if (descriptor < 0) return algebra3d::write_error(file, errno);
  int reason = write_all(descriptor, bytes);
  if (::close(descriptor) != 0 && reason == 0) reason = errno;
  if (reason == 0) return true;
  ::unlink(file.c_str());
  return algebra3d::write_error(file, reason);
}

Result<fs::path> write_in_folder(std::string_view report, const fs::path& folder) {
  for (int number = 1; number <= kMostReports; ++number) {
    const fs::path file = folder / fmt::format("algebra3d-failure-{}.q", number);
    A3D_ASSIGN(const bool is_written, write_new_file(file, report));
    if (is_written) return file;
  }
  return Error{ErrorCode::io_error, "{}: there are {} reports already", folder.string(), kMostReports};
}

}  // namespace

std::string failure_report(const FailedStatement& statement, const algebra3d::Context& context) {
  const std::optional<FailedCall>& call = statement.calls.first();
  if (!call || statement.error.message != call->error.message)
    return statement_report(statement, "no operator over values failed");
  if (!call->obstacle.empty())
    return statement_report(statement, fmt::format("of the operator {}, {}", call->op->name, call->obstacle));
  return call_report(*call, statement, context);
}

Status prepare_failure_folder(const fs::path& folder) {
  const fs::path report = folder / "algebra3d-failure-1.q";
  std::error_code error;
  fs::create_directories(folder, error);
  const int reason = error ? error.value() : algebra3d::folder_obstacle(report);
  if (reason == 0) return {};
  return Error{ErrorCode::io_error, "no reports can be written to '{}': {}", folder.string(),
               algebra3d::write_obstacle(report, reason)};
}

Result<fs::path> write_failure_report(std::string_view report, const std::vector<fs::path>& folders) {
  std::string reasons;
  for (const fs::path& folder : folders) {
    auto file = write_in_folder(report, fs::absolute(folder).lexically_normal());
    if (file) return file;
    reasons += (reasons.empty() ? "" : "; ") + file.error().text();
  }
  return Error(ErrorCode::io_error, reasons);
}

}  // namespace queries
