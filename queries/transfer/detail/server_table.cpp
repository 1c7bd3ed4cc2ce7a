#include "queries/transfer/detail/server_table.h"

#include <fmt/format.h>

#include "base/propagate.h"
#include "base/text.h"

namespace queries {
namespace {

/// The first version with scans of ranges of rows, which `pull` needs to go on where it ended.
constexpr int kLeastVersion = 140000;

Status read_columns(ServerConnection& connection, ServerTable& table) {
  A3D_ASSIGN(
      const ServerAnswer rows,
      connection.query(
          "SELECT a.attname, format_type(a.atttypid, a.atttypmod), (SELECT t.typname FROM pg_type t JOIN pg_depend d "
          "ON d.classid = 'pg_type'::regclass AND d.objid = t.oid AND d.deptype = 'e' JOIN pg_extension e ON "
          "d.refclassid = 'pg_extension'::regclass AND e.oid = d.refobjid AND e.extname = 'algebra3d' WHERE t.oid = "
          "a.atttypid) FROM pg_attribute a WHERE a.attrelid = $1::regclass AND a.attnum > 0 AND NOT "
          "a.attisdropped ORDER BY a.attnum",
          {table.sql()}));
  for (int row = 0; row < rows.row_count(); ++row)
    table.columns.push_back({rows.text(row, 0), rows.text(row, 1), rows.text(row, 2)});
  return {};
}

Status check_table_name(ServerConnection& connection, const std::string& name) {
  auto parts = connection.query("SELECT cardinality(parse_ident($1))", {name});
  if (!parts) {
    Error error = std::move(parts).error();
    if (error.code == ErrorCode::io_error && error.message.find("22023") != std::string::npos)
      error.code = ErrorCode::wrong_usage;
    return std::move(error).about("--table");
  }
  if (parts->text(0, 0) == "1" || parts->text(0, 0) == "2") return {};
  return Error{ErrorCode::wrong_usage, "'{}' is no name of a table: expected NAME or SCHEMA.NAME", name};
}

/// Where a table of this name would be made.
Result<ServerTable> place_for_table(ServerConnection& connection, const std::string& name) {
  A3D_ASSIGN(const ServerAnswer parts,
             connection.query("SELECT coalesce(p[2], p[1])::name, CASE WHEN p[2] IS NULL THEN current_schema() ELSE "
                              "p[1]::name END FROM parse_ident($1) p",
                              {name}));
  if (parts.is_null(0, 1))
    return Error{ErrorCode::wrong_usage,
                 "there is no table '{}', and no schema of the search_path where it could be made", name};
  ServerTable table;
  table.name = parts.text(0, 0);
  table.schema = parts.text(0, 1);
  return table;
}

}  // namespace

Status check_server(const ServerConnection& connection) {
  const int version = connection.pq().server_version(connection.handle());
  if (version >= kLeastVersion) return {};
  return Error{ErrorCode::database_version, "the server has version {} of PostgreSQL; {} or later is needed",
               version / 10000, kLeastVersion / 10000};
}

Result<ServerTable> find_table(ServerConnection& connection, const std::string& name) {
  A3D_TRY(check_table_name(connection, name));
  A3D_ASSIGN(
      const ServerAnswer found,
      connection.query("SELECT n.nspname, c.relname, c.relkind, c.relhassubclass FROM pg_class c JOIN pg_namespace n "
                       "ON n.oid = c.relnamespace WHERE c.oid = to_regclass($1)",
                       {name}));
  if (found.row_count() == 0) return place_for_table(connection, name);
  ServerTable table;
  table.schema = found.text(0, 0);
  table.name = found.text(0, 1);
  table.is_there = true;
  table.kind = (found.text(0, 2) + ' ').front();
  table.has_children = found.is_true(0, 3);
  A3D_TRY(read_columns(connection, table));
  return table;
}

Result<ExtensionTypes> find_extension_types(ServerConnection& connection) {
  A3D_ASSIGN(
      const ServerAnswer rows,
      connection.query(
          "SELECT quote_ident(s.nspname), t.typname, quote_ident(n.nspname) || '.' || quote_ident(t.typname) FROM "
          "pg_extension e JOIN pg_namespace s ON s.oid = e.extnamespace JOIN pg_depend d ON d.refclassid = "
          "'pg_extension'::regclass AND d.refobjid = e.oid AND d.deptype = 'e' AND d.classid = 'pg_type'::regclass "
          "JOIN pg_type t ON t.oid = d.objid JOIN pg_namespace n ON n.oid = t.typnamespace WHERE e.extname = "
          "'algebra3d'"));
  ExtensionTypes types;
  for (int row = 0; row < rows.row_count(); ++row) {
    types.is_installed = true;
    types.schema = rows.text(row, 0);
    types.by_name[rows.text(row, 1)] = rows.text(row, 2);
  }
  if (types.is_installed) return types;
  A3D_ASSIGN(const ServerAnswer available,
             connection.query("SELECT EXISTS (SELECT FROM pg_available_extensions WHERE name = 'algebra3d')"));
  types.is_available = available.is_true(0, 0);
  return types;
}

std::string quoted_literal(std::string_view text) {
  const std::string doubled = algebra3d::with_replaced(std::string(text), "'", "''");
  return "E'" + algebra3d::with_replaced(doubled, "\\", "\\\\") + "'";
}

}  // namespace queries
