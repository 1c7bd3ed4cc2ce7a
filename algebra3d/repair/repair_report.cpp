#include "algebra3d/repair/repair_report.h"

#include <algorithm>

#include <fmt/format.h>

namespace algebra3d {
namespace {

struct StepWording {
  std::string_view name, one, many;
};

constexpr std::array<StepWording, kRepairSteps> kStepWordings{{
    {"repeated corners", "facet that repeats a corner dropped", "facets that repeat a corner dropped"},
    {"collinear corners", "facet without area dropped", "facets without area dropped"},
    {"duplicate facets", "duplicate facet dropped", "duplicate facets dropped"},
    {"divided edges", "edge divided at a vertex on it", "edges divided at vertices on them"},
    {"cracks", "vertex moved across a crack", "vertices moved across cracks"},
    {"turned facets", "facet turned over", "facets turned over"},
    {"fins", "facet of a fin dropped", "facets of fins dropped"},
    {"holes", "hole closed", "holes closed"},
    {"open holes", "hole left open", "holes left open"},
    {"sheets", "sheet left open", "sheets left open"},
    {"turned shells", "shell turned right side out", "shells turned right side out"},
    {"intersections", "facet divided at others", "facets divided at others"},
    {"inner shells", "shell that bounds nothing dropped", "shells that bound nothing dropped"},
    {"cavities", "cavity filled", "cavities filled"},
    {"small shells", "small shell dropped", "small shells dropped"},
}};

const StepWording& wording_of(RepairStep step) {
  return kStepWordings[static_cast<std::size_t>(step)];
}

}  // namespace

std::string_view name_of(RepairStep step) {
  return wording_of(step).name;
}

void RepairReport::add(RepairStep step, const Vec3& where, double distance) {
  auto place = std::ranges::lower_bound(entries, step, {}, &RepairEntry::step);
  if (place == entries.end() || place->step != step) place = entries.insert(place, {step, 0, where, 0});
  ++place->count;
  place->largest = std::max(place->largest, distance);
}

const RepairEntry* RepairReport::find(RepairStep step) const {
  const auto place = std::ranges::lower_bound(entries, step, {}, &RepairEntry::step);
  return place != entries.end() && place->step == step ? &*place : nullptr;
}

double RepairReport::deviation() const {
  double largest = 0;
  for (const RepairEntry& entry : entries) largest = std::max(largest, entry.largest);
  return largest;
}

std::string RepairReport::text() const {
  std::string text;
  for (const RepairEntry& entry : entries) {
    const StepWording& wording = wording_of(entry.step);
    text += fmt::format("{}{} {} (near ({:.6g} {:.6g} {:.6g}))", text.empty() ? "" : ", ", entry.count,
                        entry.count == 1 ? wording.one : wording.many, entry.where.x, entry.where.y, entry.where.z);
  }
  if (const double moved = deviation(); moved > 0) text += fmt::format("; at most {:.3g} from the facets", moved);
  return text;
}

}  // namespace algebra3d
