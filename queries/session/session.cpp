#include "queries/session/session.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <type_traits>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"
#include "queries/language/checker.h"
#include "queries/language/parser.h"
#include "queries/session/detail/failure_report.h"
#include "queries/session/detail/objects.h"
#include "queries/session/plan.h"
#include "queries/store/database_creation.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

/// The name of the only algebra (module of operators and types); SECONDO has many.
constexpr std::string_view kAlgebra = "Algebra3D";

NestedList symbol(std::string_view name) {
  return NestedList::symbol(std::string(name));
}

NestedList inquiry(std::string_view what, NestedList content) {
  return NestedList::list(symbol("inquiry"), NestedList::list(symbol(what), std::move(content)));
}

NestedList databases(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".db") names.push_back(algebra3d::shown_as_text(entry.path().stem().string()));
  std::ranges::sort(names);
  NestedList::List list;
  for (const std::string& name : names) list.push_back(symbol(name));
  return NestedList(std::move(list));
}

Result<NestedList> objects(Store& store) {
  A3D_ASSIGN(const auto infos, store.objects());
  NestedList::List list = {symbol("OBJECTS")};
  for (const ObjectInfo& info : infos) {
    // A type without arguments stands in parentheses too, so that every type here is a list.
    NestedList type = info.type.to_nested();
    if (!type.is_list()) type = NestedList::list(std::move(type));
    list.push_back(
        NestedList::list(symbol("OBJECT"), symbol(info.name), NestedList(), NestedList::list(std::move(type))));
  }
  return NestedList(std::move(list));
}

Result<NestedList> types(Store& store) {
  A3D_ASSIGN(const auto named, store.types());
  NestedList::List list = {symbol("TYPES")};
  for (const NamedType& type : named)
    list.push_back(NestedList::list(symbol("TYPE"), symbol(type.name), type.type.to_nested()));
  return NestedList(std::move(list));
}

// The counters of this process, such as how often decisions needed more than floating point.
NestedList counters() {
  const algebra3d::ExactCounters counts = algebra3d::exact_counters();
  const auto row = [](std::string_view name, std::uint64_t count) {
    return NestedList::list(symbol(name), NestedList(static_cast<std::int64_t>(count)));
  };
  return NestedList::list(row("predicate_calls", counts.calls), row("filter_failures", counts.filter_failures),
                          row("exact_fallbacks", counts.big_fallbacks), row("heap_rationals", counts.heap_rationals));
}

NestedList operators(const algebra3d::Registry& registry) {
  NestedList::List list;
  for (const algebra3d::Operator* op : registry.operators()) {
    NestedList::List signatures;
    for (std::string& signature : op->all_signatures()) signatures.push_back(NestedList::text(std::move(signature)));
    list.push_back(NestedList::list(symbol(op->name), NestedList(std::move(signatures)), NestedList::text(op->syntax),
                                    NestedList::text(op->doc)));
  }
  return NestedList(std::move(list));
}

NestedList type_constructors(const algebra3d::Registry& registry) {
  NestedList::List list;
  for (const algebra3d::Type* type : listed_types(registry)) {
    NestedList::List kinds;
    for (const auto kind : type->kinds()) kinds.push_back(symbol(algebra3d::Type::kind_name(kind)));
    list.push_back(NestedList::list(symbol(type->name()), NestedList(std::move(kinds)),
                                    NestedList::text(std::string(type->notation())),
                                    NestedList::text(std::string(type->doc()))));
  }
  return NestedList(std::move(list));
}

/// The result list of a `list` command, `(inquiry (what (...)))`. `store` is null while no database is open; then
/// `objects` must not be asked for.
Result<NestedList> inquire(Inquiry::Subject subject, const algebra3d::Registry& registry, Store* store,
                           const std::filesystem::path& folder) {
  switch (subject) {
    case Inquiry::Subject::databases:
      return inquiry("databases", databases(folder));
    case Inquiry::Subject::objects: {
      A3D_ASSIGN(NestedList list, objects(*store));
      return inquiry("objects", std::move(list));
    }
    case Inquiry::Subject::types: {
      A3D_ASSIGN(NestedList list, types(*store));
      return inquiry("types", std::move(list));
    }
    case Inquiry::Subject::algebras:
      return inquiry("algebras", NestedList::list(symbol(kAlgebra)));
    case Inquiry::Subject::counters:
      return inquiry("counters", counters());
    case Inquiry::Subject::operators:
      return inquiry("operators", operators(registry));
    case Inquiry::Subject::type_constructors:
      return inquiry("constructors", type_constructors(registry));
  }
  return Error{ErrorCode::internal, "unknown subject of an inquiry"};
}

// Advice for users of a shared session who give a command that concerns the session itself and not the content of its
// database; empty for other commands.
std::string_view instead_of(const CommandContent& command) {
  const auto advice = [](const auto& content) -> std::string_view {
    using T = std::decay_t<decltype(content)>;
    if constexpr (std::is_same_v<T, TransactionStep>)
      return "each command is a transaction of its own; one over several commands is for the shell";
    if constexpr (std::is_same_v<T, SetOption>) return "options are those of whoever started the server";
    if constexpr (std::is_same_v<T, OpenDatabase> || std::is_same_v<T, CloseDatabase>)
      return "it stays open for all clients; for another database start another server";
    if constexpr (std::is_same_v<T, CreateDatabase> || std::is_same_v<T, DeleteDatabase> ||
                  std::is_same_v<T, RestoreDatabase>)
      return "other databases are made, restored and deleted in the shell";
    return {};
  };
  return std::visit(advice, command);
}

}  // namespace

using About = algebra3d::Diagnostics::About;

OwnResult::OwnResult(const algebra3d::Context& context)
    : diagnostics_(context.diagnostics),
      unreadable_before_(diagnostics_.count(About::unreadable)),
      unwritten_before_(diagnostics_.count(About::unwritten)) {}

std::string_view OwnResult::failure(const Datum& value) const {
  const auto* single = std::get_if<Value>(&value.content);
  if (single == nullptr) return "";
  if (!single->is_defined()) return diagnostics_.count(About::unreadable) > unreadable_before_ ? "undefined" : "";
  const bool is_false = &single->type() == &algebra3d::TypeOf<bool>::type() && !single->get<bool>();
  return is_false && diagnostics_.count(About::unwritten) > unwritten_before_ ? "FALSE" : "";
}

Session::Session(const algebra3d::Registry& registry, SessionOptions options)
    : registry_(registry),
      options_(std::move(options)),
      memory_user_(options_.memory_bytes),
      memory_(options_.memory_bytes, algebra3d::WorkMemory::default_folder(), &memory_user_) {}

Session::~Session() = default;

Status Session::open_file(const std::filesystem::path& file) {
  A3D_TRY(require_closed());
  const OpenMode writing = options_.creates ? OpenMode::open_or_create : OpenMode::read_write;
  const OpenMode mode = options_.read_only ? OpenMode::read_only : writing;
  const bool makes = mode == OpenMode::open_or_create && makes_database(file);
  A3D_TRY(open_store(file, mode));
  has_made_database_ = makes;
  return {};
}

Status Session::open_store(const std::filesystem::path& file, OpenMode mode) {
  StoreOptions limits;
  limits.cache_bytes = options_.cache_bytes.value_or(options_.memory_bytes / 12);
  auto store = queries::open_store(file, mode, registry_, limits);
  if (store) {
    store_ = *std::move(store);
    return {};
  }
  Error error = std::move(store).error();
  if (error.code != ErrorCode::database_corrupt) return error;
  damaged_ = Damaged{file, error};
  error.message += "; `check database` says what can still be read";
  return error;
}

Status Session::execute(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context) {
  failed_result_ = {};
  const algebra3d::MemoryUserScope scope(options_.is_shared ? algebra3d::MemoryUser::current() : &memory_user_);
  algebra3d::FailedCalls failed_calls;
  Context own = context;
  own.memory = &memory_;
  if (!options_.failure_folders.empty()) own.failed_calls = &failed_calls;
  if (store_ != nullptr) store_->end_waiting_when(context.cancel);
  Status status = run_caught(text, start, presenter, own);
  if (store_ != nullptr) store_->end_waiting_when(nullptr);
  if (!status && status.error().code == ErrorCode::internal) report_failure(status.error(), text, own);
  return status;
}

Status Session::run_caught(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context) {
  try {
    const algebra3d::InterruptionScope interruption(context.cancel);
    A3D_ASSIGN(const Command command, parse_command(text, registry_, start, &options_.parameters));
    if (presenter.takes_queries_only() && !std::holds_alternative<Query>(command.content))
      return Error(ErrorCode::type_error, "expected a query; other commands have no value").at(command.place);
    presenter.begin(command);
    return run(command, presenter, context);
  } catch (const algebra3d::Interrupted&) {
    if (store_ != nullptr) store_->rollback();
    return algebra3d::Monitor::interrupted().at(start);
  } catch (const std::bad_alloc& failure) {
    if (store_ != nullptr) store_->rollback();
    return algebra3d::memory_error(failure).at(start);
  } catch (const std::exception& exception) {
    if (store_ != nullptr) store_->rollback();
    return Error(ErrorCode::internal, exception.what()).at(start);
  }
}

void Session::report_failure(Error& error, std::string_view text, const Context& context) const {
  if (context.failed_calls == nullptr) return;
  try {
    const std::filesystem::path database = store_ != nullptr ? store_->file() : std::filesystem::path();
    const std::string report = failure_report({text, error, *context.failed_calls, options_.parameters, database,
                                               std::filesystem::current_path() / context.folder.path()},
                                              context);
    const auto file = write_failure_report(report, options_.failure_folders);
    error.message += file ? "; a script that repeats the failure is in " + file->string()
                          : "; a report could not be written: " + file.error().text();
  } catch (const std::exception& exception) {
    error.message += std::string("; a report could not be made: ") + exception.what();
  }
}

Status Session::run(const Command& command, Presenter& presenter, Context& context) {
  if (const std::string_view advice = instead_of(command.content); options_.is_shared && !advice.empty())
    return Error(ErrorCode::wrong_usage, "this database is shared: {}", advice).at(command.place);
  auto status = std::visit([&](const auto& content) { return run(content, presenter, context); }, command.content);
  if (!status) return std::move(status).error().at(command.place);
  return {};
}

Status Session::in_transaction(bool writes, const std::function<Status()>& work) {
  if (damaged_) return damaged_->error;
  if (store_ == nullptr) return work();
  A3D_TRY(store_->begin(writes));
  Status status = algebra3d::as_interrupted(work);
  const algebra3d::UninterruptedScope uninterrupted;
  if (status) status = store_->commit();
  if (!status) store_->rollback();
  return status;
}

// Of several statements in one, the first counts.
void Session::judge(const OwnResult& result, const Datum& value) {
  if (failed_result_.empty()) failed_result_ = result.failure(value);
}

Result<Store*> Session::required_store() {
  if (store_ != nullptr) return store_.get();
  if (damaged_) return damaged_->error;
  return Error{ErrorCode::no_database,
               "no database is open; start with --db FILE, or use `create database N` and "
               "`open database N`"};
}

// A query may write (inserttuple, deletesearch); the transaction becomes a writing one when it does. SQLite waits for
// other writers only at the beginning of a transaction, so a query that met one begins once more, as a writing one.
Status Session::run(const Query& command, Presenter& presenter, Context& context) {
  bool has_shown = false;
  const auto work = [&]() -> Status {
    Objects objects(registry_, store_.get(), context, options_.rewrites_plans);
    Checker checker(registry_, objects, context);
    A3D_ASSIGN(const TypedPtr node,
               presenter.takes_streams() ? checker.check(*command.value) : checker.check_result(*command.value));
    if ((node->type().is_stream() && !presenter.takes_streams()) || node->type().is_tuple())
      return Error{ErrorCode::not_evaluable, "a result of type {} cannot be shown; end a stream with consume or count",
                   node->type().text()};
    const OwnResult result(context);
    A3D_ASSIGN(const Datum value, node->evaluate(nullptr, context));
    judge(result, value);
    has_shown = true;
    return presenter.present(node->type(), value, context);
  };
  Status status = in_transaction(false, work);
  const bool is_again_possible = (!has_shown || presenter.can_begin_again()) && !options_.read_only;
  if (!status && status.error().code == ErrorCode::database_busy && is_again_possible)
    status = in_transaction(true, work);
  return status;
}

Status Session::run(const Explain& command, Presenter& presenter, Context& context) {
  return in_transaction(false, [&]() -> Status {
    PlanRecorder recorder;
    Context own = context;
    if (!command.runs) own.unchanging = "`explain` without `query` runs nothing";
    Objects objects(registry_, store_.get(), own, options_.rewrites_plans);
    A3D_ASSIGN(const TypedPtr node, Checker(registry_, objects, own, &recorder).check(*command.value));
    if (command.runs) A3D_TRY(run_to_end(*node, own));
    return presenter.present_inquiry(plan_list(recorder));
  });
}

Status Session::run(const Inquiry& command, Presenter& presenter, Context&) {
  if (command.subject == Inquiry::Subject::objects || command.subject == Inquiry::Subject::types)
    A3D_TRY(required_store());
  if (!command.algebra.empty() && command.algebra != kAlgebra)
    return Error{ErrorCode::unknown_name, "there is no algebra '{}'; the only one is {}", command.algebra, kAlgebra};
  NestedList result;
  A3D_TRY(in_transaction(false, [&]() -> Status {
    A3D_ASSIGN(result, inquire(command.subject, registry_, store_.get(), options_.folder));
    return {};
  }));
  return presenter.present_inquiry(result);
}

}  // namespace queries
