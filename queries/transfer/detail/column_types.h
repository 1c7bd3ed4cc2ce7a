#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/streams/datum.h"
#include "queries/transfer/detail/server_connection.h"

namespace queries {

/// The types of the extension in a database: their qualified names in quotes, and the schema of the extension.
struct ExtensionTypes {
  bool is_installed = false;
  bool is_available = false;                   ///< on the server, for CREATE EXTENSION
  std::string schema;                          ///< in quotes
  std::map<std::string, std::string> by_name;  ///< "volume3d" -> "public"."volume3d"
};

/// How values of a type of the language move: as which type of SQL, in which bytes.
struct ColumnType {
  enum class Form : std::uint8_t {
    integer,    ///< bigint
    real,       ///< float8
    boolean,    ///< boolean
    text,       ///< text: string and text
    bytes,      ///< bytea
    instant,    ///< timestamp, whole milliseconds
    small_set,  ///< a type of the extension that is stored without a frame: point3d, vector3d, plane3d, rect3
    set,        ///< a type of the extension with the binary form of the library
  };
  const algebra3d::Type* type = nullptr;
  Form form = Form::text;
  std::string sql_name;  ///< as in CREATE TABLE
  std::string schema;    ///< of a type of the extension, in quotes

  /// The expression that COPY sends of a column, and that of the bytes that a digest hashes: the bytes that are sent,
  /// or of `small_set` the value list, since the bytes may depend on the program that made them.
  std::string sent_sql(const std::string& column) const;
  std::string hashed_sql(const std::string& column) const;
};

/// The column for an attribute. Errors: type_error, naming the attribute, for a type without a counterpart;
/// file_missing if the type is one of the extension and the database has none.
Result<ColumnType> column_type_of(const TypeExpr::Attribute& attribute, const ExtensionTypes& extension,
                                  const std::string& database, const algebra3d::Registry& registry);

/// The type of the language for a type of SQL, as format_type names it, or `extension_type` for one of the extension;
/// nothing for a type without a counterpart.
std::optional<std::string> type_for_sql(const std::string& sql_name, const std::string& extension_type);

/// The bytes of COPY for a defined value. Errors: invalid_value for a text with a zero byte; limit_exceeded beyond what
/// a server takes; those of the store.
Result<std::string> sent_bytes(const ColumnType& column, const Value& value);
/// The bytes that a digest hashes, if they are not those that are sent.
Result<std::string> hashed_bytes(const ColumnType& column, const Value& value, std::string_view sent);

/// A value from the bytes of COPY, which are proved. Errors: invalid_value or database_corrupt with what was found.
Result<Value> received_value(const ColumnType& column, std::string_view bytes);

}  // namespace queries
