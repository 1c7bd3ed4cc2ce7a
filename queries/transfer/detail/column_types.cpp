#include "queries/transfer/detail/column_types.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/time.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "queries/store/stored_form.h"
#include "queries/transfer/detail/copy_format.h"

namespace queries {
namespace {

using Form = ColumnType::Form;

/// A row of a server has at most 1 GB.
constexpr std::size_t kMaxBytes = (std::size_t{1} << 30U) - (std::size_t{1} << 20U);
/// PostgreSQL counts from 2000-01-01, the language from the Monday after it.
constexpr std::int64_t kDaysBetweenEpochs = 2;
constexpr std::int64_t kMicroseconds = 1000;  // of a millisecond

struct PlainType {
  std::string_view name, sql_name;
  Form form;
};
constexpr PlainType kPlainTypes[] = {
    {"int", "bigint", Form::integer},
    {"real", "double precision", Form::real},
    {"bool", "boolean", Form::boolean},
    {"text", "text", Form::text},
    {"string", "text", Form::text},
    {"bytes", "bytea", Form::bytes},
    {"instant", "timestamp without time zone", Form::instant},
};
/// Further types of SQL that have room in one of the language.
constexpr PlainType kWiderTypes[] = {
    {"int", "integer", Form::integer},
    {"int", "smallint", Form::integer},
    {"real", "real", Form::real},
    {"text", "character varying", Form::text},
};
constexpr std::string_view kExtensionTypes[] = {"point3d", "points3d",  "vector3d", "plane3d", "rect3",
                                                "region",  "surface3d", "volume3d", "mesh3d"};
constexpr std::string_view kStoredShort[] = {"point3d", "vector3d", "plane3d", "rect3"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string number_bytes(std::uint64_t number) {
  std::string bytes;
  append_big_endian(bytes, number, sizeof number);
  return bytes;
}

Result<std::uint64_t> number_of(std::string_view bytes) {
  if (bytes.size() != sizeof(std::uint64_t))
    return Error{ErrorCode::invalid_value, "{} bytes, expected {}", bytes.size(), sizeof(std::uint64_t)};
  return big_endian(bytes);
}

Result<Value> received_real(std::string_view bytes) {
  A3D_ASSIGN(const std::uint64_t bits, number_of(bytes));
  const auto number = std::bit_cast<double>(bits);
  if (!std::isfinite(number)) return Error{ErrorCode::invalid_value, "{}, expected a finite number", number};
  return Value::of(number);
}

Result<Value> received_instant(std::string_view bytes) {
  A3D_ASSIGN(const std::uint64_t bits, number_of(bytes));
  const auto microseconds = static_cast<std::int64_t>(bits);
  constexpr std::int64_t kShift = kDaysBetweenEpochs * algebra3d::kMillisecondsPerDay;
  if (microseconds % kMicroseconds != 0)
    return Error{ErrorCode::invalid_value, "a time with {} microseconds beyond whole milliseconds",
                 std::abs(microseconds % kMicroseconds)};
  const std::int64_t milliseconds = microseconds / kMicroseconds - kShift;
  if (milliseconds < algebra3d::Instant::kFirst || milliseconds > algebra3d::Instant::kLast)
    return Error{ErrorCode::invalid_value, "a time that is not in the years 1 to 9999"};
  return Value::of(algebra3d::Instant{milliseconds});
}

Result<Value> received_text(const ColumnType& column, std::string_view bytes) {
  if (const std::size_t at = algebra3d::first_no_text(bytes); at != std::string_view::npos)
    return Error{ErrorCode::invalid_value, "character at byte {}: {}", at, algebra3d::no_text_message(bytes[at])};
  if (column.type->name() == "string") return Value::of(std::string(bytes));
  return Value::of(algebra3d::Text{std::string(bytes)});
}

Result<Value> received_set(const ColumnType& column, std::string_view bytes) {
  A3D_ASSIGN(const Value value, algebra3d::decode(*column.type, bytes, algebra3d::Origin::elsewhere));
  if (!value.is_defined()) return Error{ErrorCode::invalid_value, "an undefined value, expected NULL for one"};
  // Bytes that were proved are stored as they came.
  return column.type->is_large() ? with_form(value, std::string(bytes)) : value;
}

}  // namespace

std::string ColumnType::sent_sql(const std::string& column) const {
  const bool is_extended = form == Form::set || form == Form::small_set;
  return is_extended ? column : fmt::format("{}::{}", column, sql_name);
}

std::string ColumnType::hashed_sql(const std::string& column) const {
  switch (form) {
    case Form::integer:
      return fmt::format("int8send({})", sent_sql(column));
    case Form::real:
      return fmt::format("float8send({})", sent_sql(column));
    case Form::boolean:
      return fmt::format("boolsend({})", column);
    case Form::text:
      return fmt::format("convert_to({}, 'UTF8')", sent_sql(column));
    case Form::bytes:
      return column;
    case Form::instant:
      return fmt::format("timestamp_send({})", column);
    case Form::small_set:
      return fmt::format("convert_to({}.as_text({}), 'UTF8')", schema, column);
    case Form::set:
      break;
  }
  return fmt::format("{}.{}({})", schema, quoted_identifier(std::string(type->name()) + "_send"), column);
}

Result<ColumnType> column_type_of(const TypeExpr::Attribute& attribute, const ExtensionTypes& extension,
                                  const std::string& database, const algebra3d::Registry& registry) {
  const std::string& name = attribute.type.name();
  const algebra3d::Type* const type = registry.value_type(attribute.type);
  for (const PlainType& each : kPlainTypes)
    if (each.name == name) return ColumnType{type, each.form, std::string(each.sql_name), {}};
  if (attribute.type.is_nested_relation())
    return Error{
        ErrorCode::type_error,
        "the attribute '{}' is a nested relation, which has no counterpart in PostgreSQL; `unnest` makes tuples "
        "of its tuples",
        attribute.name};
  if (!contains(kExtensionTypes, name))
    return Error{ErrorCode::type_error, "the attribute '{}' is of type {}, which has no counterpart in PostgreSQL",
                 attribute.name, attribute.type.text()};
  if (!extension.is_installed)
    return Error{ErrorCode::file_missing,
                 "the attribute '{}' is of type {}, and the database '{}' has no extension for it: as its owner, run "
                 "CREATE EXTENSION algebra3d there{}",
                 attribute.name,
                 name,
                 database,
                 extension.is_available ? "" : " (the server lacks its files, too: package postgresql-15-algebra3d)"};
  const auto found = extension.by_name.find(name);
  if (found == extension.by_name.end())
    return Error{ErrorCode::type_error,
                 "the attribute '{}' is of type {}, which the extension of the database '{}' lacks", attribute.name,
                 name, database};
  const Form form = contains(kStoredShort, name) ? Form::small_set : Form::set;
  return ColumnType{type, form, found->second, extension.schema};
}

std::optional<std::string> type_for_sql(const std::string& sql_name, const std::string& extension_type) {
  if (contains(kExtensionTypes, extension_type)) return extension_type;
  for (const PlainType& each : kPlainTypes)
    if (each.sql_name == sql_name) return std::string(each.name);
  // With a greatest length in brackets, or without.
  const std::string_view plain = std::string_view(sql_name).substr(0, sql_name.find('('));
  for (const PlainType& each : kWiderTypes)
    if (each.sql_name == plain) return std::string(each.name);
  return std::nullopt;
}

Result<std::string> sent_bytes(const ColumnType& column, const Value& value) {
  switch (column.form) {
    case Form::integer:
      return number_bytes(static_cast<std::uint64_t>(value.get<std::int64_t>()));
    case Form::real:
      return number_bytes(std::bit_cast<std::uint64_t>(value.get<double>()));
    case Form::boolean:
      return std::string(1, value.get<bool>() ? '\1' : '\0');
    case Form::instant:
      return number_bytes(static_cast<std::uint64_t>(
          (value.get<algebra3d::Instant>().milliseconds + kDaysBetweenEpochs * algebra3d::kMillisecondsPerDay) *
          kMicroseconds));
    case Form::text:
    case Form::bytes:
    case Form::small_set:
    case Form::set:
      break;
  }
  std::string bytes;
  if (column.form == Form::text) {
    bytes = algebra3d::characters_of(value);
  } else if (column.form == Form::bytes) {
    bytes = value.get<algebra3d::Bytes>().content;
  } else {
    A3D_ASSIGN(bytes, stored_form(value));
  }
  if (bytes.size() > kMaxBytes)
    return Error{ErrorCode::limit_exceeded, "a value of {} bytes; a server takes {} at most", bytes.size(), kMaxBytes};
  return bytes;
}

Result<std::string> hashed_bytes(const ColumnType& column, const Value& value, std::string_view sent) {
  if (column.form != Form::small_set) return std::string(sent);
  A3D_ASSIGN(const Value loaded, value.loaded());
  return loaded.to_nested().print();
}

Result<Value> received_value(const ColumnType& column, std::string_view bytes) {
  switch (column.form) {
    case Form::integer: {
      A3D_ASSIGN(const std::uint64_t number, number_of(bytes));
      return Value::of(static_cast<std::int64_t>(number));
    }
    case Form::real:
      return received_real(bytes);
    case Form::boolean:
      if (bytes.size() != 1) return Error{ErrorCode::invalid_value, "{} bytes, expected 1", bytes.size()};
      return Value::of(bytes[0] != '\0');
    case Form::text:
      return received_text(column, bytes);
    case Form::bytes:
      return Value::of(algebra3d::Bytes{std::string(bytes)});
    case Form::instant:
      return received_instant(bytes);
    case Form::small_set:
    case Form::set:
      break;
  }
  return received_set(column, bytes);
}

}  // namespace queries
