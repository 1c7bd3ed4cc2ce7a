#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/work_memory.h"

namespace queries {

/// Options of `algebra3d serve`.
struct ServerOptions {
  std::filesystem::path database = {};
  bool creates = false;  ///< makes the database if there is none
  /// Address to listen on: a name or number of this machine. Without a token it must be a loopback address.
  std::string listen = "127.0.0.1";
  int port = 8737;  ///< 0: any free one
  bool read_only = false;
  /// File with the token that requests must give; empty: the variable ALGEBRA3D_TOKEN, if it is set.
  std::filesystem::path token_file = {};
  /// Further names in the headers `Host` and `Origin`, for servers behind another one: [SCHEME://]NAME[:PORT].
  std::vector<std::string> hosts = {};
  /// Origins whose pages may show the viewer in a frame: SCHEME://NAME[:PORT].
  std::vector<std::string> embedders = {};
  std::uint64_t max_upload_megabytes = 1024;
  double max_seconds = 0;  ///< of a statement; 0: no limit
  /// Memory limit of all sessions, kept results and answers on their way together; 0: that of WorkMemory.
  std::uint64_t memory_megabytes = 0;
  std::string failure_folder = {};  ///< for reports of internal errors; empty: the folder of temporary files
};

/// The memory limit in bytes.
inline std::size_t memory_limit_of(const ServerOptions& options) {
  return options.memory_megabytes == 0 ? algebra3d::WorkMemory::default_limit()
                                       : std::size_t{options.memory_megabytes} << 20U;
}

/// Limits of a server that have no option.
struct ServerLimits {
  std::size_t statement_bytes = std::size_t{16} << 20U;  ///< of a body that is not an upload
  std::size_t results_of_client = 64;                    ///< kept at once
  std::size_t results = 1024;                            ///< of all clients, kept at once
  std::size_t copied_bytes = std::size_t{4} << 30U;      ///< of results that left the database, most of it in files
  std::size_t sessions = 192;                            ///< of statements that run, and of results that need one
  std::size_t sessions_of_results = 96;                  ///< of results; beyond it some are dropped
  std::chrono::milliseconds session_patience{5000};      ///< until a statement that finds no session is refused
  std::size_t idle_sessions = 8;
  std::size_t connections = 256;
  std::size_t uploads = 256;                              ///< files
  std::uintmax_t log_bytes = std::uintmax_t{256} << 20U;  ///< of the write-ahead log; beyond it results are dropped
  std::uintmax_t usual_log_bytes = std::uintmax_t{16} << 20U;  ///< beyond it the log is emptied when no result needs it
};

}  // namespace queries
