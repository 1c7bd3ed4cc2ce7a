#include "queries/transfer/transfer_command.h"

#include <string>

#include <CLI/CLI.hpp>

namespace queries {
namespace {

void add_common_options(CLI::App& command, TransferOptions& options, const std::string& replacing) {
  command
      .add_option("--pg", options.server,
                  "The server and its database, as psql takes them: 'host=HOST dbname=NAME user=NAME', or "
                  "postgresql://USER@HOST/NAME; what is left out is taken from PGHOST, PGUSER and so on")
      ->type_name("CONNINFO")
      ->required();
  command.add_flag("--replace", options.replaces, replacing)->disable_flag_override();
  command.add_flag("--quiet", options.quiet, "Show no progress and no summary")->disable_flag_override();
  command.add_option("--batch-megabytes", options.batch_megabytes, "Commit a batch of rows after this much data")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
}

}  // namespace

CLI::App* add_push_command(CLI::App& app, TransferOptions& options) {
  CLI::App* push = app.add_subcommand("push", "Copy a relation into a table of a server of PostgreSQL");
  push->add_option("--db", options.database, "Database file")->type_name("FILE")->required();
  push->add_option("--relation", options.relation, "Relation")->type_name("NAME")->required();
  push->add_option("--table", options.table,
                   "Table, created if it does not exist: NAME or SCHEMA.NAME, as in SQL (default: the relation's name)")
      ->type_name("TABLE");
  add_common_options(*push, options, "Delete the rows of the table first, and begin anew");
  CLI::Option* const connections =
      push->add_option("--connections", options.connections,
                       "Connections that rows are sent over; with one they lie in the table in the order of ids");
  connections->check(CLI::Range(1, 16))->capture_default_str();
  push->add_flag("--shards", options.shards,
                 "The table is divided among several servers by the extension algebra3d_shards; CONNINFO is their "
                 "coordinator, and rows go straight to them, over a connection to each")
      ->disable_flag_override()
      ->excludes(connections);
  push->footer(
      "Columns have the names of attributes in lower case, as psql takes them without quotes. Types: int is bigint,\n"
      "real is double precision, bool is boolean, string and text are text, bytes is bytea, instant is timestamp, and\n"
      "point3d, points3d, vector3d, plane3d, rect3, region, surface3d, volume3d, mesh3d are those of the extension;\n"
      "undefined is NULL. A table that exists needs a column of that name and type for each attribute.\n"
      "Rows are sent in the order of their ids. How far they came is recorded on the server in the table\n"
      "algebra3d_transfers, in the same transaction as the rows: the same command goes on after an interruption, and\n"
      "later sends tuples that were added since. At the end count and checksum are compared on both sides.\n"
      "Exit status: 0 all rows are in the table, 1 the push failed, 2 wrong usage, 130 interrupted.");
  return push;
}

CLI::App* add_pull_command(CLI::App& app, TransferOptions& options) {
  CLI::App* pull = app.add_subcommand("pull", "Copy a table of a server of PostgreSQL into a relation");
  pull->add_option("--db", options.database, "Database file; created if it does not exist")
      ->type_name("FILE")
      ->required();
  pull->add_option("--table", options.table, "Table or materialized view: NAME or SCHEMA.NAME, as in SQL")
      ->type_name("TABLE")
      ->required();
  pull->add_option("--relation", options.relation,
                   "Relation, created if it does not exist (default: the name of the table with a capital)")
      ->type_name("NAME");
  add_common_options(*pull, options, "Empty the relation first, and begin anew");
  pull->footer(
      "A new relation has an attribute for each column, whose name begins with a capital: name is Name. One that "
      "exists\n"
      "needs an attribute for each column, and a column for each attribute; upper and lower case do not matter.\n"
      "Types are those of `algebra3d push --help`; smaller numbers and varchar are taken, too. NULL is undefined.\n"
      "Values of the server are proved to be valid. The rows are those of one moment. How far they came is recorded "
      "in\n"
      "the database, in the same transaction as the rows: the same command goes on after an interruption, and later\n"
      "takes rows that were added since. At the end count and checksum are compared on both sides.\n"
      "Exit status: 0 all rows are in the relation, 1 the pull failed, 2 wrong usage, 130 interrupted.");
  return pull;
}

}  // namespace queries
