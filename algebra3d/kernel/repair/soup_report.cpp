#include "algebra3d/kernel/repair/soup_report.h"

#include <array>

#include <fmt/core.h>

#include "algebra3d/kernel/repair/repair_report.h"

namespace algebra3d {
namespace {

struct DefectWording {
  const char* one;
  const char* many;
};
constexpr std::array<DefectWording, kDefectKinds> kDefectWordings{{
    {"degenerate triangle", "degenerate triangles"},
    {"duplicate triangle", "duplicate triangles"},
    {"boundary edge", "boundary edges"},
    {"non-manifold edge", "non-manifold edges"},
    {"inconsistently oriented edge", "inconsistently oriented edges"},
    {"intersecting pair", "intersecting pairs"},
    {"shell with a wrong winding number", "shells with a wrong winding number"},
}};

std::string place_text(const DefectExample& example, double size) {
  const std::string where = near_text(example.where, size);
  if (!example.second.is_valid()) return fmt::format("triangle {}, {}", example.first.index() + 1, where);
  return fmt::format("triangles {} and {}, {}", example.first.index() + 1, example.second.index() + 1, where);
}

}  // namespace

std::string_view name_of(Defect kind) {
  return kDefectWordings[static_cast<std::size_t>(kind)].many;
}

void SoupReport::count_contradicting_normals(const TriangleSoup& soup) {
  for (std::size_t i = 0; i < soup.normals.size(); ++i) {
    const auto& [a, b, c] = soup.triangles[i];
    if (!(dot(cross(b - a, c - a), soup.normals[i]) < 0)) continue;
    if (++contradicting_normal_count == 1) first_contradicting_triangle = i;
  }
}

std::string SoupReport::defects() const {
  std::string text;
  Defect previous{kDefectKinds};
  for (const DefectExample& example : validity.examples) {
    if (example.kind == previous) continue;
    previous = example.kind;
    const std::uint64_t count = validity.count(example.kind);
    const DefectWording& wording = kDefectWordings[static_cast<std::size_t>(example.kind)];
    const bool at_least = validity.is_cut_short && example.kind == Defect::intersecting_triangles;
    text += fmt::format("{}{}{} {} ({})", text.empty() ? "no valid solid: " : ", ", at_least ? "at least " : "", count,
                        count == 1 ? wording.one : wording.many, place_text(example, size));
  }
  return text;
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
