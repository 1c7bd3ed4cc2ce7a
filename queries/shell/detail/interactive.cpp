#include "queries/shell/detail/interactive.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "algebra3d/operators/registry/operator.h"
#include "queries/session/session.h"
#include "queries/shell/detail/command_history.h"
#include "queries/shell/detail/completion.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/line_editor.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

// `volume(_)` goes on with a bracket, `_ feed` with a blank.
Candidate operator_candidate(const algebra3d::Operator& op) {
  const std::size_t place = op.syntax.find(op.name);
  const std::size_t end = place == std::string::npos ? op.syntax.size() : place + op.name.size();
  const char next = end < op.syntax.size() ? op.syntax[end] : ' ';
  return {op.name, next == '(' || next == '[' ? std::string(1, next) : " "};
}

bool is_word(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
}

std::vector<std::string> files(const std::string& beginning) {
  const std::size_t slash = beginning.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : beginning.substr(0, slash + 1);
  std::vector<std::string> paths;
  std::error_code error;
  const std::filesystem::directory_options skips = std::filesystem::directory_options::skip_permission_denied;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, skips, error)) {
    const std::string name = entry.path().filename().string();
    std::error_code ignored;
    const bool is_hidden = name.starts_with('.') && !std::string_view(beginning).substr(folder.size()).starts_with('.');
    if (!is_hidden) paths.push_back(folder + name + (entry.is_directory(ignored) ? "/" : ""));
  }
  return paths;
}

std::vector<std::string> databases(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".db") names.push_back(entry.path().stem().string());
  return names;
}

/// The names for completion in a session. Reads the catalogue of the open database, if any; without names if that
/// fails.
CompletionNames session_names(Session& session) {
  CompletionNames names;
  for (const algebra3d::Operator* op : session.registry().operators())
    if (is_word(op->name)) names.operators.push_back(operator_candidate(*op));
  for (const algebra3d::Type* type : listed_types(session.registry())) names.types.emplace_back(type->name());
  names.databases = databases(session.options().folder);
  names.files = files;
  if (session.store() == nullptr) return names;
  if (const auto named = session.store()->types(); named)
    for (const NamedType& type : *named) names.types.push_back(type.name);
  const auto objects = session.store()->objects();
  if (!objects) return names;
  for (const ObjectInfo& object : *objects) {
    names.objects.push_back(object.name);
    if (object.type.is_relation())
      for (const auto& [name, type] : object.type.element().attributes()) names.attributes.push_back(name);
  }
  return names;
}

std::string database_text(Session& session) {
  if (session.store() == nullptr)
    return "No database is open: try `create database parts; open database parts;`, or `list databases;`.\n";
  const std::string name = session.store()->file().filename().string();
  const auto objects = session.store()->objects();
  if (!objects) return fmt::format("The database {} is open.\n", printable(name));
  if (objects->empty())
    return fmt::format(
        "The database {} is empty: try `let Cube = createCube(makePoint3D(0, 0, 0), "
        "makePoint3D(2, 2, 2));`\n",
        printable(name));
  return fmt::format("The database {} has {} object{}: `list objects;` shows {}.\n", printable(name), objects->size(),
                     objects->size() == 1 ? "" : "s", objects->size() == 1 ? "it" : "them");
}

/// The lines from the prompt up to the end of a command.
class Prompt {
 public:
  Prompt(Session& session, StatementRunner& runner, std::ostream& out)
      : runner_(runner),
        out_(out),
        history_(history_file()),
        editor_([this, &session](std::string_view line, std::size_t cursor) {
          return complete_line(session, line, cursor);
        }) {
    for (const std::string& entry : history_.entries()) editor_.remember(entry);
  }

  void run();

 private:
  enum class Next : bool { go_on, leave };

  Completion complete_line(Session& session, std::string_view line, std::size_t cursor) const;
  Next take(const std::string& line);
  void drop();

  StatementRunner& runner_;
  std::ostream& out_;
  CommandHistory history_;
  LineEditor editor_;
  CommandReader reader_;
  std::string typed_;  // of the command that is not complete
};

// The meaning of a word may depend on the lines before.
Completion Prompt::complete_line(Session& session, std::string_view line, std::size_t cursor) const {
  const std::string before = typed_.empty() ? "" : typed_ + "\n";
  Completion completion = complete(before + std::string(line), before.size() + cursor, session_names(session));
  if (completion.begin < before.size()) return {};
  completion.begin -= before.size();
  return completion;
}

void Prompt::drop() {
  reader_ = CommandReader();
  typed_.clear();
}

// The entry is written before the command runs, so that it is there if the command ends the program.
Prompt::Next Prompt::take(const std::string& line) {
  typed_ += (typed_.empty() ? "" : "\n") + line;
  std::vector<CommandText> commands;
  // An entry of the history may have several lines.
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find('\n', begin), line.size());
    for (CommandText& command : reader_.add_line(std::string_view(line).substr(begin, end - begin)))
      commands.push_back(std::move(command));
    begin = end + 1;
  }
  if (!reader_.is_pending()) {
    while (typed_.ends_with('\n')) typed_.pop_back();
    if (history_.add(typed_)) editor_.remember(typed_);
    drop();  // places in messages count from the prompt on
  }
  for (const CommandText& command : commands) {
    const RunResult result = runner_.run(command);
    if (result == RunResult::quit || Interruption::is_terminated()) return Next::leave;
    if (result == RunResult::interrupted) break;
  }
  Interruption::reset();
  return Next::go_on;
}

void Prompt::run() {
  while (true) {
    out_.flush();  // the prompt goes through the C library, behind the back of the stream
    std::string line;
    const auto event = editor_.read(reader_.is_pending() ? "      ...> " : "algebra3d> ", line);
    if (event == LineEditor::Event::line) {
      if (take(line) == Next::leave) return;
      continue;
    }
    out_ << (event == LineEditor::Event::interrupted ? "^C\n" : "\n");
    if (event == LineEditor::Event::end || Interruption::is_terminated()) return;
    Interruption::reset();
    drop();
  }
}

}  // namespace

bool run_interactive(Session& session, StatementRunner& runner, std::ostream& out) {
  out << "algebra3d: exact solids in a database\n"
         "Commands end with ';'. `help` lists commands and operators, `help volume` explains one,\n"
         "Tab completes, `quit` leaves.\n"
      << database_text(session);
  Prompt(session, runner, out).run();
  return !Interruption::is_terminated();
}

}  // namespace queries
