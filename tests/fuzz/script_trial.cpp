#include "fuzz/script_trial.h"

#include <cstdio>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "fuzz/silent_session.h"
#include "queries/language/command_reader.h"
#include "queries/language/nested_reader.h"
#include "queries/language/parser.h"
#include "queries/streams/ordered_index.h"

namespace queries::fuzz {
namespace {

constexpr std::int64_t kMostTuplesLookedAt = 60;

template <typename... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command.content) || ...);
}

class ScriptTrial {
 public:
  ScriptTrial(const ScriptWorld& world, const Deadline& deadline)
      : deadline_(deadline), folder_(world.folder()), session_(fuzz_registry(), world.folder(), &deadline.flag()) {}

  void run(const std::vector<std::string>& commands) {
    session_.run("open database w");
    state_ = state();
    for (const std::string& command : commands) {
      step(command);
      if (deadline_.is_over()) break;
    }
    finish();
  }

 private:
  void require(bool holds, std::string_view what, const std::string& expected = {}, const std::string& found = {}) {
    if (holds) return;
    std::fprintf(stderr, "%sdoes not hold: %.*s\nexpected: %s\nfound:    %s\n", history_.c_str(),
                 static_cast<int>(what.size()), what.data(), expected.c_str(), found.c_str());
    std::abort();
  }

  void step(const std::string& text) {
    history_ += text + ";\n";
    const auto command = parse_command(text, fuzz_registry());
    const std::string answer = session_.run(text);
    const bool has_failed = answer.starts_with("error: ");
    if (has_failed) require(answer.size() > 7, "an error has a message");
    const std::string before = std::exchange(state_, state());
    if (!command) {
      require(has_failed, "what cannot be read is an error", "error: " + command.error().text(), answer);
      require(state_ == before, "a command that is not understood changes nothing", before, state_);
      return;
    }
    if (has_failed && !is_one_of<Conditional, Loop, Sequence>(*command) && !has_ended_a_transaction(*command))
      require(state_ == before, "a command that fails changes nothing", before, state_);
    if (const auto* ended = std::get_if<TransactionStep>(&command->content); ended != nullptr && !has_failed)
      follow(ended->step, before);
    if (is_one_of<OpenDatabase, CloseDatabase, RestoreDatabase, Conditional, Loop, Sequence>(*command)) begun_.reset();
    if (const auto* query = std::get_if<Query>(&command->content); query != nullptr && state_ == before)
      ask_again(text, *query->value, answer);
  }

  // A failed commit has undone the transaction.
  static bool has_ended_a_transaction(const Command& command) {
    const auto* step = std::get_if<TransactionStep>(&command.content);
    return step != nullptr && step->step == TransactionStep::Step::commit;
  }

  void follow(TransactionStep::Step step, const std::string& before) {
    if (step == TransactionStep::Step::abort && begun_)
      require(state_ == *begun_, "aborting brings back what there was", *begun_, state_);
    begun_.reset();
    if (step == TransactionStep::Step::begin) begun_ = before;
  }

  void ask_again(const std::string& text, const Expression& query, const std::string& answer) {
    // These see the clock, or the files, among them those that the database makes beside its own.
    for (const char* name : {"now", "getDirectory", "import", "STL"})
      if (text.find(name) != std::string::npos) return;
    const std::string again = session_.run(text);
    if (deadline_.is_over()) return;
    require(again == answer, "a query gives the same answer again", answer, again);
    if (answer.starts_with("error: ")) return;
    const std::string printed = to_nested(query).print();
    const auto list = NestedList::parse(printed);
    require(list.ok(), "the nested form of a query can be read", printed, list ? "" : list.error().text());
    const auto read = NestedReader(fuzz_registry(), {"", 1, 1}).expression(*list);
    if (!read && read.error().code == ErrorCode::limit_exceeded) return;
    require(read.ok(), "the nested form of a query is an expression", printed, read ? "" : read.error().text());
    require(to_nested(**read) == *list, "the nested form of a query is read as it was", printed,
            to_nested(**read).print());
    const std::string nested_answer = session_.run("(query " + printed + ")");
    if (!deadline_.is_over()) require(nested_answer == answer, "(query " + printed + ")", answer, nested_answer);
  }

  void finish() {
    if (session_.store() == nullptr) return;
    if (session_.store()->is_in_explicit_transaction()) session_.run_to_the_end("commit transaction");
    const std::string findings = session_.run_to_the_end("check database");
    require(findings == "(inquiry (findings ()))", "the database is sound", "no findings", findings);
    const std::string name = session_.store()->file().stem().string();
    const std::string seen = state();
    restore_elsewhere();
    session_.run_to_the_end("close database");
    session_.run_to_the_end("open database " + name);
    require(session_.store() != nullptr, "the database can be opened again");
    const std::string kept = state();
    require(kept == seen, "the file holds what the session saw", seen, kept);
  }

  // Derived objects may have become others, or impossible, and are left out then; so only the values themselves are
  // compared.
  void restore_elsewhere() {
    if (history_.size() % 4 != 0) return;
    const std::string saved = session_.run_to_the_end("save database to 'end.list'");
    require(saved.empty(), "a database can be saved", "", saved);
    const std::string seen = content(*session_.store(), false);
    SilentSession other(fuzz_registry(), folder_, nullptr);
    const std::string restored = other.run_to_the_end("restore database elsewhere from 'end.list'");
    const bool is_restored = restored.empty() || restored.find("which cannot be derived again") != std::string::npos;
    require(is_restored, "a saved database can be restored", "", restored);
    const std::string again = content(*other.store(), false);
    require(again == seen, "a restored database equals the saved one", seen, again);
  }

  /// The objects of the open database and what they hold.
  std::string state() {
    Store* store = session_.store();
    return store == nullptr ? "closed" : store->file().stem().string() + "\n" + content(*store, true);
  }

  /// Without everything: what a restored database has in common with the saved one.
  std::string content(Store& store, bool is_everything) {
    std::string text;
    require(store.begin(false).ok(), "a statement can begin");
    const auto types = store.types();
    const auto objects = store.objects();
    require(types.ok() && objects.ok(), "the catalogue can be read");
    for (const NamedType& type : *types) text += type.name + " = " + type.type.text() + "\n";
    for (const ObjectInfo& info : *objects) {
      if (!is_everything && (is_index(info.type) || !info.derived_text.empty())) continue;
      text += info.name + ": " + info.type.text() + " " + info.function_text + info.derived_text;
      if (info.has_value && !info.type.is_function()) text += value_text(store, info.name, is_everything);
      text += "\n";
    }
    require(store.commit().ok(), "a statement can end");
    return text;
  }

  std::string value_text(Store& store, const std::string& name, bool shows_ids) {
    const auto value = store.read(name);
    require(value.ok(), "an object can be read", name, value ? "" : value.error().text());
    if (const auto* relation = std::get_if<std::shared_ptr<Relation>>(&value->content))
      return tuples(**relation, shows_ids);
    if (const auto* single = std::get_if<Value>(&value->content)) return shown(*single);
    return {};
  }

  std::string tuples(Relation& relation, bool shows_ids) {
    std::string text = std::to_string(*relation.count());
    const auto scan = relation.scan();
    for (std::int64_t i = 0; i < kMostTuplesLookedAt; ++i) {
      const auto tuple = (*scan)->next();
      require(tuple.ok(), "a relation can be read", "", tuple ? "" : tuple.error().text());
      if (*tuple == nullptr) break;
      text += shows_ids ? " (" + std::to_string((*tuple)->id) : " (";
      for (const Value& attribute : (*tuple)->attributes) text += shown(attribute);
      text += ")";
    }
    return text;
  }

  std::string shown(const Value& value) {
    // Geometry by its box: texts of coordinates would take most of the time.
    if (value.type().is_spatial() && value.is_defined()) {
      const auto [box, size] = value.header();
      return fmt::format(" {} {} {} {} {}", size, box.min.x, box.min.y, box.max.x, box.max.z);
    }
    const auto loaded = value.loaded();
    require(loaded.ok(), "a value can be loaded", "", loaded ? "" : loaded.error().text());
    return " " + loaded->to_nested().print();
  }

  const Deadline& deadline_;
  const std::filesystem::path folder_;
  SilentSession session_;
  std::string history_;
  std::string state_;
  std::optional<std::string> begun_;  // the state at the beginning of the open transaction
};

}  // namespace

std::vector<std::string> commands_of(std::string_view script) {
  CommandReader reader;
  std::vector<std::string> commands;
  const auto take = [&](const CommandText& command) {
    if (!is_shell_command(command.text)) commands.push_back(command.text);
  };
  while (!script.empty()) {
    const std::size_t end = script.find('\n');
    for (const CommandText& command : reader.add_line(script.substr(0, end))) take(command);
    script.remove_prefix(end == std::string_view::npos ? script.size() : end + 1);
  }
  if (const auto last = reader.finish()) take(*last);
  return commands;
}

void try_script(std::string_view script, const ScriptWorld& world, Deadline& deadline) {
  if (script.size() > kMaxScriptBytes || !is_confined(script)) return;
  std::vector<std::string> commands = commands_of(script);
  if (commands.size() > kMaxCommands) commands.resize(kMaxCommands);
  world.reset();
  deadline.start();
  ScriptTrial(world, deadline).run(commands);
}

}  // namespace queries::fuzz
