#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/language/typed_tree.h"

namespace queries::fuzz {

/// All types and operators, but those that make solids out of numbers make small ones only: a sphere of a million
/// triangles is not a hang.
const algebra3d::Registry& fuzz_registry();

/// What every input meets: a folder of its own with a database `w` of objects of all kinds and some files. One per
/// process; the folder is removed at its end.
class ScriptWorld {
 public:
  ScriptWorld();
  ~ScriptWorld();
  ScriptWorld(const ScriptWorld&) = delete;
  ScriptWorld& operator=(const ScriptWorld&) = delete;

  /// Puts the folder into its first state.
  void reset() const;
  /// Nothing but the operators of files can leave it, and `is_confined` says of a script that they will not.
  const std::filesystem::path& folder() const { return folder_; }
  /// The objects of the database.
  const std::map<std::string, TypeExpr>& objects() const { return objects_; }

 private:
  std::filesystem::path root_;      // holds the folder and nothing else, so that `..` may be looked at
  std::filesystem::path original_;  // the first state
  std::filesystem::path folder_;
  std::map<std::string, TypeExpr> objects_;
};

/// False if a file name within the script might lead out of its folder. A slash stands between digits or blanks, or in
/// `</text--->` behind `<`, so that no path is absolute and no `..` is the folder above.
bool is_confined(std::string_view script);

/// Sets a flag when the time for one input is over; statements then end with the error `interrupted`.
class Deadline {
 public:
  explicit Deadline(std::chrono::milliseconds limit);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// A new input begins.
  void start();
  bool is_over() const { return is_over_.load(std::memory_order_relaxed); }
  const std::atomic<bool>& flag() const { return is_over_; }

 private:
  void watch();

  const std::chrono::milliseconds limit_;
  std::atomic<std::int64_t> end_ = 0;  // of the steady clock, in milliseconds
  std::atomic<bool> is_over_ = false;
  std::atomic<bool> is_finished_ = false;
  std::thread thread_;
};

}  // namespace queries::fuzz
