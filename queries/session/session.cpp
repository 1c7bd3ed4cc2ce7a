#include "queries/session/session.h"

#include <new>

#include "queries/language/checker.h"
#include "queries/language/parser.h"
#include "queries/session/inquiry.h"
#include "queries/session/objects.h"

namespace queries {
namespace {

bool can_be_stored(const TypeExpr& type, const algebra3d::Registry& registry) {
  if (type.is_relation() || type.is_function() || type.is("rtree3")) return true;
  return type.arguments().empty() && registry.find_type(type.name()) != nullptr;
}

Error cannot_be_stored(const std::string& command, const TypeExpr& type) {
  const std::string_view hint = type.is_stream() ? "; end the stream with consume" : "";
  return {ErrorCode::not_evaluable, "{}: a value of type {} cannot be stored{}", command, type.text(), hint};
}

}  // namespace

Session::Session(const algebra3d::Registry& registry, SessionOptions options)
    : registry_(registry), options_(std::move(options)) {}

Session::~Session() = default;

Status Session::open_file(const std::filesystem::path& file) {
  RETURN_IF_ERROR(require_closed());
  ASSIGN_OR_RETURN(store_,
                   Store::open(file, options_.read_only ? OpenMode::read_only : OpenMode::open_or_create, registry_));
  return {};
}

Status Session::execute(std::string_view text, const SourcePlace& start, Presenter& presenter, Context& context) {
  try {
    ASSIGN_OR_RETURN(const Command command, parse_command(text, registry_, start));
    auto status = run(command, presenter, context);
    if (!status) return std::move(status).error().at(command.place);
    return {};
  } catch (const std::bad_alloc&) {
    if (store_ != nullptr) store_->rollback();
    return Error(ErrorCode::out_of_memory, "memory is exhausted").at(start);
  } catch (const std::exception& exception) {
    if (store_ != nullptr) store_->rollback();
    return Error(ErrorCode::internal, exception.what()).at(start);
  }
}

Status Session::run(const Command& command, Presenter& presenter, Context& context) {
  return std::visit([&](const auto& content) { return run(content, presenter, context); }, command.content);
}

template <typename Work>
Status Session::in_transaction(bool writes, Work work) {
  if (store_ == nullptr) return work();
  RETURN_IF_ERROR(store_->begin(writes));
  Status status = work();
  if (status) status = store_->commit();
  if (!status) store_->rollback();
  return status;
}

Result<Store*> Session::required_store() {
  if (store_ != nullptr) return store_.get();
  return Error{ErrorCode::no_database,
               "no database is open; start with --db FILE, or use `create database N` and "
               "`open database N`"};
}

Status Session::check_new_name(const std::string& name) {
  if (is_reserved(name, registry_))
    return Error{ErrorCode::reserved_name, "'{}' is {} and cannot name an object", name,
                 registry_.find_operator(name) != nullptr ? "an operator" : "a word of the language"};
  return {};
}

Status Session::run(const CreateObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  RETURN_IF_ERROR(check_new_name(command.name));
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context);
    ASSIGN_OR_RETURN(const TypeExpr type, Checker(registry_, objects, context).resolve(command.type));
    if (!can_be_stored(type, registry_) || type.is_function() || type.is("rtree3"))
      return cannot_be_stored("create", type);
    return store->create(command.name, type);
  });
}

Status Session::run(const LetObject& command, Presenter&, Context& context) {
  RETURN_IF_ERROR(required_store());
  RETURN_IF_ERROR(check_new_name(command.name));
  return in_transaction(true, [&] { return define(command, context); });
}

Status Session::define(const LetObject& command, Context& context) {
  Objects objects(registry_, store_.get(), context);
  ASSIGN_OR_RETURN(const auto existing, store_->find(command.name));
  if (existing && !command.replaces)
    return Error{ErrorCode::name_exists, "there is an object '{}' already; delete it first, or use let_", command.name};
  ASSIGN_OR_RETURN(const TypedPtr node, Checker(registry_, objects, context).check(*command.value));
  const TypeExpr& type = node->type();
  if (!can_be_stored(type, registry_)) return cannot_be_stored("let", type);
  if (type.is_function()) {
    if (existing) RETURN_IF_ERROR(store_->remove(command.name));
    return store_->create_function(command.name, type, command.source);
  }
  ASSIGN_OR_RETURN(const Datum value, node->evaluate(nullptr, context));
  if (existing) RETURN_IF_ERROR(store_->remove(command.name));
  RETURN_IF_ERROR(store_->create(command.name, type));
  return store_->assign(command.name, value, context);
}

Status Session::run(const UpdateObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    Objects objects(registry_, store, context);
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (!existing)
      return Error{ErrorCode::unknown_name, "there is no object '{}'; use let to create one", command.name};
    ASSIGN_OR_RETURN(const TypedPtr node, Checker(registry_, objects, context).check(*command.value));
    if (!(node->type() == existing->type))
      return Error{ErrorCode::type_error, "update: '{}' is of type {}, the new value of type {}", command.name,
                   existing->type.text(), node->type().text()};
    if (existing->type.is_function()) {
      RETURN_IF_ERROR(store->remove(command.name));
      return store->create_function(command.name, existing->type, command.source);
    }
    ASSIGN_OR_RETURN(const Datum value, node->evaluate(nullptr, context));
    return store->assign(command.name, value, context);
  });
}

Status Session::run(const DeleteObject& command, Presenter&, Context&) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  return in_transaction(true, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto existing, store->find(command.name));
    if (!existing) return Error{ErrorCode::unknown_name, "there is no object '{}'", command.name};
    return store->remove(command.name);
  });
}

// A query may write (inserttuple, deletesearch); the transaction becomes a writing one when it does. SQLite waits for
// other writers only at the beginning of a transaction, so a query that met one begins once more, as a writing one.
Status Session::run(const Query& command, Presenter& presenter, Context& context) {
  bool has_shown = false;
  const auto work = [&]() -> Status {
    Objects objects(registry_, store_.get(), context);
    ASSIGN_OR_RETURN(const TypedPtr node, Checker(registry_, objects, context).check(*command.value));
    if (node->type().is_stream() || node->type().is_tuple())
      return Error{ErrorCode::not_evaluable, "a result of type {} cannot be shown; end a stream with consume or count",
                   node->type().text()};
    ASSIGN_OR_RETURN(const Datum value, node->evaluate(nullptr, context));
    has_shown = true;
    return presenter.present(node->type(), value, context);
  };
  Status status = in_transaction(false, work);
  if (!status && status.error().code == ErrorCode::database_busy && !has_shown && !options_.read_only)
    status = in_transaction(true, work);
  return status;
}

Status Session::run(const Inquiry& command, Presenter& presenter, Context&) {
  if (command.subject == Inquiry::Subject::objects) RETURN_IF_ERROR(required_store());
  NestedList result;
  RETURN_IF_ERROR(in_transaction(false, [&]() -> Status {
    ASSIGN_OR_RETURN(result, inquire(command.subject, registry_, store_.get(), options_.folder));
    return {};
  }));
  return presenter.present_inquiry(result);
}

}  // namespace queries
