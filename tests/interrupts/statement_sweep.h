#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "interrupts/call_sweep.h"

namespace algebra3d::interrupts {

/// A database of large values and relations, and statements over it that take long: commands that save, restore,
/// check and print, and every operator over streams and relations.
class StatementSweep {
 public:
  /// Makes the database in `folder`. `size`: triangles of a large value and tuples of a large relation.
  StatementSweep(const Registry& registry, std::filesystem::path folder, std::size_t size);

  /// Empty if the database could be made, else why not.
  const std::string& obstacle() const { return obstacle_; }
  std::vector<Work> statements() const;
  /// The relational operators that no statement uses.
  std::vector<std::string> missing() const;

 private:
  std::string run(const std::string& statement, const std::atomic<bool>* flag, bool as_json) const;
  void save_large_values(std::size_t size) const;

  const Registry& registry_;
  std::filesystem::path folder_;
  std::string obstacle_;
};

}  // namespace algebra3d::interrupts
