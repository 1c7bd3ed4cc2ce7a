#include "algebra3d/kernel/repair/soup_report.h"

#include <fmt/core.h>

#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {
namespace {

std::string place_text(const DefectExample& example, double size) {
  const std::string where = near_text(example.where, size);
  if (!example.second.is_valid()) return fmt::format("triangle {}, {}", example.first.index() + 1, where);
  return fmt::format("triangles {} and {}, {}", example.first.index() + 1, example.second.index() + 1, where);
}

}  // namespace

void SoupReport::count_contradicting_normals(const TriangleSoup& soup) {
  for (std::size_t i = 0; i < soup.normals.size(); ++i) {
    const auto& [a, b, c] = soup.triangles[i];
    if (!(dot(cross(b - a, c - a), soup.normals[i]) < 0)) continue;
    if (++contradicting_normal_count == 1) first_contradicting_triangle = i;
  }
}

std::string SoupReport::defects() const {
  const std::string text =
      validity.text(", ", [this](const DefectExample& example) { return place_text(example, size); });
  return text.empty() ? text : "no valid solid: " + text;
}

std::vector<std::string> SoupReport::remarks() const {
  std::vector<std::string> remarks;
  if (was_flipped) remarks.emplace_back("turned right side out");
  if (contradicting_normal_count == 1)
    remarks.push_back(
        fmt::format("1 normal contradicts the order of the corners (triangle {})", *first_contradicting_triangle + 1));
  if (contradicting_normal_count > 1)
    remarks.push_back(fmt::format("{} normals contradict the order of the corners (first: triangle {})",
                                  contradicting_normal_count, *first_contradicting_triangle + 1));
  return remarks;
}

}  // namespace algebra3d
