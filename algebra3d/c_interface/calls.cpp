#include <memory>

#include "algebra3d/c_interface/detail/functions.h"
#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/conversion.h"
#include "algebra3d/operators/registry/registry.h"
#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "base/text.h"

struct a3d_rows : algebra3d::c_interface::Held {
  a3d_rows(const a3d_session& session, algebra3d::RowSourcePtr its_source, std::size_t its_column_count)
      : Held(session), source(std::move(its_source)), column_count(its_column_count) {}

  algebra3d::RowSourcePtr source;
  std::size_t column_count;
};

struct a3d_aggregate : algebra3d::c_interface::Held {
  a3d_aggregate(const a3d_session& session, const algebra3d::c_interface::Function& its_function)
      : Held(session), function(its_function), content(its_function.call) {}

  const algebra3d::c_interface::Function& function;
  algebra3d::Aggregation content;
  bool is_used_up = false;  ///< finished, or taken by another run
};

namespace algebra3d::c_interface {
namespace {

/// Errors: type_error.
Status check_argument(const Function& function, std::size_t number, const Value& value) {
  const Type& expected = *function.call.overload->parameters[number].type;
  if (&value.type() == &expected || conversion_cost(value.type().term(), expected.name())) return {};
  return Error{ErrorCode::type_error,
               "argument {} of '{}': expected {}, got {}",
               number + 1,
               function.description.name,
               expected.name(),
               value.type().name()};
}

/// Errors: wrong_usage.
Status check_running(const a3d_aggregate& aggregate) {
  if (!aggregate.is_used_up) return {};
  return Error{ErrorCode::wrong_usage, "this run of '{}' has ended: it was finished, or combined into another",
               aggregate.function.description.name};
}

/// The number of undefined values, little-endian, then the result.
std::string bytes_of(const Aggregation::Part& part) {
  std::string bytes;
  ByteWriter(bytes).u64(part.undefined_count);
  return bytes + encode(part.result);
}

/// Errors: database_corrupt.
Result<Aggregation::Part> part_of(const Function& function, std::string_view bytes) {
  ByteReader reader(bytes, "saved aggregate");
  const std::uint64_t undefined_count = reader.u64();
  A3D_TRY(reader.status());
  A3D_ASSIGN(Value result,
             decode(*function.call.overload->part, bytes.substr(sizeof undefined_count), Origin::own_store));
  return Aggregation::Part{std::move(result), undefined_count};
}

/// Errors: wrong_usage.
Status check_parts(const a3d_function& function) {
  if (function.has_parts != 0) return {};
  return Error{ErrorCode::wrong_usage, "'{}' is not an aggregate whose runs can be saved", function.name};
}

/// Copies of the arguments. Errors: wrong_usage for a function of another kind; type_error for another number of
/// arguments, or other types.
Result<std::vector<Value>> values_for(const Function& function, a3d_kind kind, a3d_value* const* arguments,
                                      std::size_t count) {
  const a3d_function& description = function.description;
  if (description.kind != kind)
    return Error{ErrorCode::wrong_usage, "'{}' is {}", description.name, describe(function.call.overload->kind())};
  if (count != description.parameter_count)
    return Error{ErrorCode::type_error, "'{}' takes {}, got {}", description.name,
                 counted(description.parameter_count, "argument"), count};
  std::vector<Value> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    A3D_TRY(check_argument(function, i, arguments[i]->content));
    values.push_back(arguments[i]->content);
  }
  return values;
}

}  // namespace

extern "C" {

a3d_status a3d_call(a3d_session* session, const a3d_function* function, a3d_value* const* arguments, size_t count,
                    a3d_value** result) {
  return made(session, result, [&](Context& context) -> Result<Value> {
    const Function& called = function_of(function);
    A3D_ASSIGN(std::vector<Value> values, values_for(called, A3D_SCALAR, arguments, count));
    return Registry::call(called.call, values, context);
  });
}

a3d_status a3d_open_rows(a3d_session* session, const a3d_function* function, a3d_value* const* arguments, size_t count,
                         a3d_rows** result) {
  return done(
      session,
      [&](Context& context) -> Result<RowSourcePtr> {
        const Function& called = function_of(function);
        A3D_ASSIGN(std::vector<Value> values, values_for(called, A3D_TABLE, arguments, count));
        return Registry::rows(called.call, values, context);
      },
      [&](RowSourcePtr source) { *result = new a3d_rows(*session, std::move(source), function->column_count); });
}

a3d_status a3d_next_row(a3d_session* session, a3d_rows* rows, a3d_value** cells) {
  bool is_end = false;
  const a3d_status status = done(
      session, [&](Context& context) { return rows->source->next(context); },
      [&](std::optional<Row> row) {
        is_end = !row;
        if (is_end) return;
        std::vector<std::unique_ptr<a3d_value>> made;
        for (Value& cell : *row) made.push_back(std::make_unique<a3d_value>(*session, std::move(cell)));
        for (std::size_t i = 0; i < rows->column_count; ++i) cells[i] = made[i].release();
      });
  return status == A3D_OK && is_end ? A3D_END : status;
}

void a3d_close_rows(a3d_rows* rows) {
  give_up(rows);
}

a3d_status a3d_open_aggregate(a3d_session* session, const a3d_function* function, a3d_aggregate** result) {
  return done(session, [&](Context&) -> Status {
    const Function& called = function_of(function);
    if (called.description.kind != A3D_AGGREGATE)
      return Error{ErrorCode::wrong_usage, "'{}' is {}", function->name, describe(called.call.overload->kind())};
    *result = new a3d_aggregate(*session, called);
    return {};
  });
}

a3d_status a3d_step(a3d_session* session, a3d_aggregate* aggregate, const a3d_value* value) {
  return done(session, [&](Context& context) -> Status {
    A3D_TRY(check_running(*aggregate));
    A3D_TRY(check_argument(aggregate->function, 0, value->content));
    return aggregate->content.step(value->content, context);
  });
}

a3d_status a3d_combine(a3d_session* session, a3d_aggregate* aggregate, a3d_aggregate* later) {
  return done(session, [&](Context& context) -> Status {
    if (&aggregate->function != &later->function)
      return Error{ErrorCode::wrong_usage, "a run of '{}' and one of '{}' cannot be combined",
                   aggregate->function.description.name, later->function.description.name};
    A3D_TRY(check_running(*aggregate));
    A3D_TRY(check_running(*later));
    if (aggregate == later)
      return Error{ErrorCode::wrong_usage, "a run of '{}' cannot be combined with itself",
                   aggregate->function.description.name};
    later->is_used_up = true;
    return aggregate->content.combine(later->content, context);
  });
}

a3d_status a3d_finish(a3d_session* session, a3d_aggregate* aggregate, a3d_value** result) {
  return made(session, result, [&](Context& context) -> Result<Value> {
    A3D_TRY(check_running(*aggregate));
    aggregate->is_used_up = true;
    return aggregate->content.finish(context);
  });
}

void a3d_close_aggregate(a3d_aggregate* aggregate) {
  give_up(aggregate);
}

a3d_status a3d_save_aggregate(a3d_session* session, a3d_aggregate* aggregate, a3d_bytes* result) {
  return done(
      session,
      [&](Context& context) -> Result<std::string> {
        A3D_TRY(check_parts(aggregate->function.description));
        A3D_TRY(check_running(*aggregate));
        aggregate->is_used_up = true;
        A3D_ASSIGN(const Aggregation::Part part, aggregate->content.finish_part(context));
        return bytes_of(part);
      },
      [&](std::string bytes) { give(*session, std::move(bytes), result); });
}

a3d_status a3d_restore_aggregate(a3d_session* session, const a3d_function* function, const char* bytes, size_t size,
                                 a3d_aggregate** result) {
  return done(session, [&](Context& context) -> Status {
    A3D_TRY(check_parts(*function));
    const Function& called = function_of(function);
    A3D_ASSIGN(const Aggregation::Part part, part_of(called, {bytes, size}));
    auto run = std::make_unique<a3d_aggregate>(*session, called);
    A3D_TRY(run->content.step_part(part, context));
    *result = run.release();
    return {};
  });
}

}  // extern "C"
}  // namespace algebra3d::c_interface
