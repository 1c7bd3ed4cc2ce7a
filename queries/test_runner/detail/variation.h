#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/test_runner/detail/motion.h"

namespace queries {

/// The folders of a run of a test file.
struct TestFolders {
  std::filesystem::path file;     ///< folder of the test file
  std::filesystem::path scratch;  ///< initially empty; for databases and files that commands write
};

enum class VariationKind : std::uint8_t {
  offset,    ///< geometry lies far from the origin
  axes,      ///< x, y and z are permuted cyclically
  operands,  ///< symmetric operators get their operands in the other order
};
inline constexpr std::array kVariationKinds = {VariationKind::offset, VariationKind::axes, VariationKind::operands};
std::string_view name_of(VariationKind kind);
std::optional<VariationKind> variation_named(std::string_view name);

/// A variation of a test case, and the inverse for its result (docs/language.md, "Variations"). Commands run in a moved
/// space: the literals of their text are moved, `registry()` moves geometry made from numbers, and results are moved
/// back before they are compared with the expectation. Immutable; owned by one run of a file.
class Variation {
 public:
  /// `plain` outlives the variation.
  Variation(VariationKind kind, const algebra3d::Registry& plain);

  VariationKind kind() const { return kind_; }
  /// The operators of the moved space.
  const algebra3d::Registry& registry() const { return registry_; }
  /// The command, in text or as a nested list, with its spatial literals moved; a command that does not parse is
  /// unchanged. For a restored file a moved copy is made in the scratch folder. Errors: io_error.
  algebra3d::Result<std::string> moved_command(const std::string& text, const TestFolders& folders) const;
  /// The result list `(T V)` in the space of the file.
  NestedList original_result(const NestedList& result) const;

 private:
  std::string moved_literals(const std::string& text) const;

  VariationKind kind_;
  Motion motion_;
  algebra3d::Registry registry_;
};

}  // namespace queries
