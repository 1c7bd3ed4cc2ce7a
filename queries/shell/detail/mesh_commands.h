#pragma once

#include <atomic>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/kernel/repair/repair_options.h"
#include "queries/shell/detail/mesh_output.h"

namespace CLI {
class App;
}

namespace queries {

/// The environment of the commands for mesh files, which it outlives.
struct MeshConsole {
  std::ostream& out;     ///< reports
  std::ostream& errors;  ///< errors and notes
  const std::atomic<bool>* cancel = nullptr;
};

/// The subcommands for mesh files that need no database: check, repair, convert. Exit status: 0 success, 1 a file has
/// defects or could not be read or written, 2 wrong usage, 130 interrupted.
class MeshCommands {
 public:
  /// Adds the subcommands to a command line; parsing fills this object, which outlives `app`.
  void add_to(CLI::App& app);
  /// Runs the given subcommand and returns its exit status; nothing if none was given.
  std::optional<int> run(const MeshConsole& console) const;

 private:
  const CLI::App* add_check(CLI::App& app);
  const CLI::App* add_repair(CLI::App& app);
  const CLI::App* add_convert(CLI::App& app);
  int check(const MeshConsole& console) const;
  int repair(const MeshConsole& console) const;
  int convert(const MeshConsole& console) const;

  const CLI::App* check_ = nullptr;
  const CLI::App* repair_ = nullptr;
  const CLI::App* convert_ = nullptr;
  std::vector<std::string> files_;  // to be checked
  bool is_quiet_ = false;
  std::string input_;  // to be repaired or converted
  MeshOutput output_;
  algebra3d::RepairOptions options_;
};

/// Shows properties of mesh files: format, size, box, validity, volume and area, and the effect of a repair. Changes
/// nothing. Returns the exit status: 1 if a file could not be read.
int show_mesh_files(std::span<const std::string> files, const MeshConsole& console);

}  // namespace queries
