#include "algebra3d/kernel/repair/repair_report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace algebra3d {
namespace {

struct StepWording {
  std::string_view name, one, many;
};

constexpr std::array<StepWording, kRepairSteps> kStepWordings{{
    {"repeated corners", "triangle that repeats a corner dropped", "triangles that repeat a corner dropped"},
    {"collinear corners", "triangle without area dropped", "triangles without area dropped"},
    {"duplicate triangles", "duplicate triangle dropped", "duplicate triangles dropped"},
    {"opposite triangles", "triangle dropped with its duplicate since nothing lies between them",
     "triangles dropped with their duplicates since nothing lies between them"},
    {"T-junctions", "edge split at a vertex on it", "edges split at vertices on them"},
    {"gaps", "vertex moved across a gap", "vertices moved across gaps"},
    {"flipped triangles", "triangle flipped", "triangles flipped"},
    {"misconnected triangles", "triangle with a wrong corner replaced", "triangles with a wrong corner replaced"},
    {"dangling sheets", "triangle of a dangling sheet dropped", "triangles of dangling sheets dropped"},
    {"holes", "hole closed", "holes closed"},
    {"open holes", "hole left open", "holes left open"},
    {"open patches", "open patch dropped", "open patches dropped"},
    {"flipped shells", "shell turned right side out", "shells turned right side out"},
    {"intersections", "triangle divided where it meets others", "triangles divided where they meet others"},
    {"united bodies", "body united with another", "bodies united with others"},
    {"inner shells", "shell that bounds nothing dropped", "shells that bound nothing dropped"},
    {"inner triangles", "triangle inside the solid removed", "triangles inside the solid removed"},
    {"outer triangles", "triangle outside the solid dropped", "triangles outside the solid dropped"},
    {"cavities", "cavity filled", "cavities filled"},
    {"small shells", "small shell dropped", "small shells dropped"},
}};

const StepWording& wording_of(RepairStep step) {
  return kStepWordings[static_cast<std::size_t>(step)];
}

/// Nothing is a distance away from a solid that is empty.
std::string text_of_left_out(const RepairAmounts& amounts, bool is_solid_empty, double size) {
  const SurfaceAmount& left_out = amounts.left_out;
  if (left_out.triangle_count == 0) return {};
  const std::string text = fmt::format("left out: {} {}, area {} ({})", left_out.triangle_count,
                                       left_out.triangle_count == 1 ? "triangle" : "triangles", left_out.area.text(3),
                                       percent_text(amounts.left_out_part()));
  if (is_solid_empty) return text;
  return fmt::format("{}, up to {} from the solid ({})", text, length_text(left_out.distance, 3),
                     near_text(left_out.where, size));
}

std::string text_of_added(const RepairAmounts& amounts) {
  const SurfaceAmount& added = amounts.added;
  if (added.triangle_count == 0) return {};
  return fmt::format("added: area {} ({}), up to {} from the triangles", added.area.text(3),
                     percent_text(amounts.added_part()), length_text(added.distance, 3));
}

}  // namespace

std::string near_text(const Vec3& where, double size) {
  const Vec3 place = short_place(where, size);
  const auto number = [&](double x) { return size > 0 ? fmt::format("{}", x) : fmt::format("{:.6g}", x); };
  return fmt::format("near ({} {} {})", number(place.x), number(place.y), number(place.z));
}

std::string percent_text(double part) {
  const double rest = 1 - part;
  if (part > 0.99 && rest > 0)
    return fmt::format("{} %", 100 - std::strtod(fmt::format("{:.2g}", 100 * rest).c_str(), nullptr));
  return fmt::format("{:.3g} %", 100 * part);
}

std::pair<std::string, std::string> percents_above_limit(double part, double limit) {
  constexpr int kMostDigits = 17;
  const std::string limit_text = fmt::format("{:.15g} %", 100 * limit);
  std::string text = percent_text(part);
  const auto number = [](const std::string& percent) { return std::strtod(percent.c_str(), nullptr); };
  for (int digits = 4; !(number(text) > number(limit_text)) && digits <= kMostDigits; ++digits)
    text = fmt::format("{:.{}g} %", 100 * part, digits);
  return {text, limit_text};
}

std::string_view name_of(RepairStep step) {
  return wording_of(step).name;
}

void RepairReport::add(RepairStep step, const Vec3& where, double distance, std::uint64_t count) {
  auto place = std::ranges::lower_bound(entries, step, {}, &RepairEntry::step);
  if (place == entries.end() || place->step != step) place = entries.insert(place, {step, 0, where, 0});
  place->count += count;
  place->largest = std::max(place->largest, distance);
}

void RepairReport::add(HoleCover cover) {
  add(RepairStep::holes, cover.where, cover.farthest);
  covers.push_back(std::move(cover));
}

std::vector<std::array<Vec3, 3>> RepairReport::cover_triangles() const {
  std::vector<std::array<Vec3, 3>> result;
  for (const HoleCover& cover : covers)
    for (std::array<Vec3, 3> triangle : cover.triangles) {
      std::ranges::sort(triangle);
      result.push_back(triangle);
    }
  std::ranges::sort(result);
  return result;
}

void RepairReport::forget(RepairStep step) {
  std::erase_if(entries, [&](const RepairEntry& entry) { return entry.step == step; });
}

void RepairReport::drop_missing_covers(const std::vector<bool>& are_there) {
  forget(RepairStep::holes);
  const std::vector<HoleCover> all = std::move(covers);
  covers.clear();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (are_there[i]) add(all[i]);
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

double RepairReport::largest_move() const {
  double largest = 0;
  for (const RepairStep step : {RepairStep::t_junctions, RepairStep::gaps})
    if (const RepairEntry* entry = find(step)) largest = std::max(largest, entry->largest);
  return largest;
}

Vec3 short_place(const Vec3& where, double size) {
  if (!(size > 0) || !std::isfinite(size)) return where;
  const int decimals = std::clamp(5 - static_cast<int>(std::floor(std::log10(size))), 0, 300);
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string text = fmt::format("{:.{}f}", where[axis], decimals);
    result[axis] = std::strtod(text.c_str(), nullptr) + 0.0;
  }
  return result;
}

std::string RepairReport::text() const {
  constexpr double kMuch = 0.1;
  std::string text = changes_text();
  if (!amounts || !(amounts->added_part() > kMuch)) return text;
  return fmt::format("{} of the area seen added; {}", percent_text(amounts->added_part()), text);
}

std::string RepairReport::changes_text() const {
  std::string text;
  for (const RepairEntry& entry : entries) {
    const StepWording& wording = wording_of(entry.step);
    text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", entry.count,
                        entry.count == 1 ? wording.one : wording.many, near_text(entry.where, size));
  }
  const auto add = [&](const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
  };
  if (amounts) {
    add(text_of_left_out(*amounts, volume_after && volume_after->is_zero(), size));
    add(text_of_added(*amounts));
    if (const double moved = largest_move(); moved > 0) add(fmt::format("moved by {} at most", length_text(moved, 3)));
  } else if (const double moved = deviation(); moved > 0) {
    add(fmt::format("at most {} from the triangles", length_text(moved, 3)));
  }
  if (text.empty()) return "triangles linked anew where more than two meet; nothing moved, added or left out";
  return text;
}

}  // namespace algebra3d
