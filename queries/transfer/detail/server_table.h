#pragma once

#include <string>
#include <vector>

#include "queries/transfer/detail/column_types.h"
#include "queries/transfer/detail/server_connection.h"

namespace queries {

struct ServerColumn {
  std::string name;
  std::string type;            ///< as format_type names it
  std::string extension_type;  ///< its name, if it is of our extension; else empty
};

/// A table of a server, or the place for one.
struct ServerTable {
  std::string schema, name;
  bool is_there = false;
  char kind = 'r';  ///< pg_class.relkind
  bool has_children = false;
  std::vector<ServerColumn> columns;  ///< in their order

  std::string sql() const { return quoted_identifier(schema) + "." + quoted_identifier(name); }
  /// For people: public.parts
  std::string text() const { return schema + "." + name; }
};

/// What must be true of every server. Errors: database_version.
Status check_server(const ServerConnection& connection);
/// Errors: wrong_usage for a text that is no name of a table.
Result<ServerTable> find_table(ServerConnection& connection, const std::string& name);
Result<ExtensionTypes> find_extension_types(ServerConnection& connection);

/// A text as a literal of SQL, whatever the settings of the session.
std::string quoted_literal(std::string_view text);

}  // namespace queries
