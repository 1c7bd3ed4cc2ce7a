#pragma once

#include <filesystem>
#include <string>

namespace queries {

/// The options of `algebra3d push` and `algebra3d pull`.
struct TransferOptions {
  std::string server;  ///< conninfo of libpq
  std::filesystem::path database;
  std::string relation;   ///< of `pull`: empty for the name of the table
  std::string table;      ///< an identifier of SQL, perhaps with a schema; of `push`: empty for the relation's name
  bool replaces = false;  ///< empty the target first
  bool quiet = false;     ///< no progress and no summary
  bool shards = false;    ///< of `push`: the table is divided among several servers
  int connections = 2;    ///< of `push` into one table
  double batch_megabytes = 4;  ///< 10^6 bytes; a batch is one transaction, which ends with the row that reaches this
};

}  // namespace queries
