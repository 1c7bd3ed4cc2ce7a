#include "algebra3d/kernel/repair/detail/repair_strategy.h"

#include <array>

namespace algebra3d {
namespace {

constexpr RepairStrategy kUsual{.name = "usual"};
constexpr RepairStrategy kKeepNegative{.name = "keep negative", .keeps_negative = true};
constexpr RepairStrategy kNoStitching{.name = "no stitching", .stitches_gaps = false};
constexpr RepairStrategy kKeepOpen{.name = "keep open patches", .drops_open_patches = false};
constexpr RepairStrategy kBalanceAll{
    .name = "balance all edges", .drops_open_patches = false, .covers_interfaces = true, .keeps_negative = true};
constexpr RepairStrategy kWindingAlone{
    .name = "winding numbers alone", .stitches_gaps = false, .drops_open_patches = false, .closes_holes = false};
constexpr RepairStrategy kBands{.name = "bands", .closes_bands = true};
constexpr RepairStrategy kShortcuts{.name = "shortcuts", .drops_open_patches = false, .takes_shortcuts = true};

constexpr std::array kSearch{kUsual, kKeepNegative, kNoStitching, kKeepOpen, kBalanceAll, kWindingAlone, kBands};
constexpr std::array kIfCostly{kBands};
constexpr std::array kIfLeftOut{kKeepOpen, kShortcuts, kBalanceAll};
constexpr std::array<CheaperStrategies, 2> kCheaper{{{TryIf::costly, kIfCostly}, {TryIf::leaves_out, kIfLeftOut}}};

}  // namespace

std::span<const RepairStrategy> search_strategies() {
  return kSearch;
}

std::span<const CheaperStrategies> cheaper_strategies() {
  return kCheaper;
}

}  // namespace algebra3d
