#include "algebra3d/kernel/validity/report.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <fmt/core.h>

#include "base/number_text.h"

namespace algebra3d {
namespace {

struct KindText {
  const char* one;
  const char* many;
};

constexpr std::array<KindText, kDefectKinds> kKindTexts{{
    {"degenerate triangle", "degenerate triangles"},
    {"duplicate triangle", "duplicate triangles"},
    {"boundary edge", "boundary edges"},
    {"non-manifold edge", "non-manifold edges"},
    {"inconsistently oriented edge", "inconsistently oriented edges"},
    {"intersecting pair", "intersecting pairs"},
    {"shell with a wrong winding number", "shells with a wrong winding number"},
}};

auto order_key(const DefectExample& e) {
  return std::tuple(e.kind, e.first, e.second, e.where);
}

std::string place_text(const DefectExample& e) {
  const std::string where = fmt::format("({} {} {})", real_text(e.where.x), real_text(e.where.y), real_text(e.where.z));
  if (!e.second.is_valid()) return fmt::format("first at triangle {}, near {}", e.first.index(), where);
  return fmt::format("first triangles {} and {}, near {}", e.first.index(), e.second.index(), where);
}

}  // namespace

std::string_view name_of(Defect kind) {
  return kKindTexts[static_cast<std::size_t>(kind)].many;
}

std::uint64_t ValidityReport::total() const {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

void ValidityReport::add(const DefectExample& defect) {
  ++counts[static_cast<std::size_t>(defect.kind)];
  const auto place = std::ranges::upper_bound(examples, order_key(defect), {}, order_key);
  const auto end = std::ranges::upper_bound(examples, defect.kind, {}, &DefectExample::kind);
  const auto begin = std::ranges::lower_bound(examples, defect.kind, {}, &DefectExample::kind);
  if (static_cast<std::size_t>(end - begin) < kExamplesPerKind) {
    examples.insert(place, defect);
  } else if (place != end) {
    std::move_backward(place, end - 1, end);
    *place = defect;
  }
}

std::string ValidityReport::text() const {
  return text("; ", place_text);
}

std::string ValidityReport::text(std::string_view separator,
                                 const std::function<std::string(const DefectExample&)>& place) const {
  std::string text;
  Defect previous{kDefectKinds};
  for (const DefectExample& example : examples) {
    if (example.kind == previous) continue;
    previous = example.kind;
    const std::uint64_t n = count(example.kind);
    const KindText& name = kKindTexts[static_cast<std::size_t>(example.kind)];
    const bool at_least = is_cut_short && example.kind == Defect::intersecting_triangles;
    text += fmt::format("{}{}{} {} ({})", text.empty() ? "" : separator, at_least ? "at least " : "", n,
                        n == 1 ? name.one : name.many, place(example));
  }
  return text;
}

}  // namespace algebra3d
