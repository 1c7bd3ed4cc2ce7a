#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace algebra3d {

/// A strategy for triangles that do not bound a solid: which steps of the repair are done, and how.
struct RepairStrategy {
  std::string_view name;           ///< for tests and explanations
  bool stitches_gaps = true;       ///< false: T-junctions are split, but no vertex moves, rounded corners neither
  bool drops_open_patches = true;  ///< also dangling sheets and misconnected triangles
  bool closes_holes = true;        ///< false: winding numbers alone decide what is inside
  bool closes_bands = false;       ///< before holes are closed; if no band can be made, there is no solid
  bool covers_interfaces = false;  ///< closes loops without a boundary edge, too, so that every edge balances
  bool takes_shortcuts = false;    ///< covers end at balanced edges where that is shorter
  bool keeps_negative = false;     ///< cells of negative winding number are inside, too; used if every edge is balanced
};

/// The strategies, in the order in which they are tried until the solid agrees with the parity estimate
/// (parity_estimate.h): usual, keep negative, no stitching, keep open patches, balance all edges, winding numbers
/// alone, bands. docs/import.md says what each is for and which switches it sets.
std::span<const RepairStrategy> search_strategies();

/// When a group of cheaper strategies is tried.
enum class TryIf : std::uint8_t {
  /// More than a thousandth of the area seen is left out or added.
  costly,
  /// More than a thousandth of the area seen is left out; or as `costly`, if non-manifold loops were covered.
  leaves_out,
};

/// Strategies that are tried after one has agreed, because they may leave out and add less. Their solids have to agree
/// with the parity estimate, too.
struct CheaperStrategies {
  TryIf condition;  ///< the group is tried if this holds for the cheapest repair found before it
  std::span<const RepairStrategy> strategies;
};

/// The groups, in the order in which they are tried: bands if `costly`; keep open patches, shortcuts, and balance all
/// edges if `leaves_out`. All strategies of a group are tried.
std::span<const CheaperStrategies> cheaper_strategies();

}  // namespace algebra3d
