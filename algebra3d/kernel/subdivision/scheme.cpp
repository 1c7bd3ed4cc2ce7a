#include "algebra3d/kernel/subdivision/scheme.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/kernel/subdivision/detail/scheme_description.h"

namespace algebra3d {

constinit const SubdivisionScheme SubdivisionScheme::catmull_clark{&subdivision::kCatmullClark};
constinit const SubdivisionScheme SubdivisionScheme::doo_sabin{&subdivision::kDooSabin};
constinit const SubdivisionScheme SubdivisionScheme::loop{&subdivision::kLoop};
constinit const SubdivisionScheme SubdivisionScheme::butterfly{&subdivision::kButterfly};
constinit const SubdivisionScheme SubdivisionScheme::modified_butterfly{&subdivision::kModifiedButterfly};
constinit const SubdivisionScheme SubdivisionScheme::sqrt3{&subdivision::kSqrt3};

namespace {

constexpr std::array kSchemes{SubdivisionScheme(&subdivision::kCatmullClark),
                              SubdivisionScheme(&subdivision::kDooSabin),
                              SubdivisionScheme(&subdivision::kLoop),
                              SubdivisionScheme(&subdivision::kButterfly),
                              SubdivisionScheme(&subdivision::kModifiedButterfly),
                              SubdivisionScheme(&subdivision::kSqrt3)};

}  // namespace

std::span<const SubdivisionScheme> subdivision_schemes() {
  return kSchemes;
}

std::optional<SubdivisionScheme> subdivision_scheme(std::string_view name) {
  for (const SubdivisionScheme& scheme : kSchemes)
    if (name_of(scheme) == name) return scheme;
  return std::nullopt;
}

std::string_view name_of(const SubdivisionScheme& scheme) {
  return scheme.description().name;
}

bool takes_triangles_only(const SubdivisionScheme& scheme) {
  return scheme.description().takes_triangles_only;
}

bool needs_three_edges(const SubdivisionScheme& scheme) {
  return scheme.description().needs_three_edges;
}

bool has_limit(const SubdivisionScheme& scheme) {
  return scheme.description().limits != nullptr;
}

bool honours_creases(const SubdivisionScheme& scheme) {
  return scheme.description().honours_creases;
}

std::string subdivision_scheme_names() {
  return subdivision_scheme_names([](const SubdivisionScheme&) { return true; });
}

std::string subdivision_scheme_names(bool (*property)(const SubdivisionScheme&)) {
  std::string names;
  for (const SubdivisionScheme& scheme : kSchemes) {
    if (!property(scheme)) continue;
    if (!names.empty()) names += ", ";
    names += name_of(scheme);
  }
  return names;
}

std::span<const std::string_view> variants_of(const SubdivisionScheme& scheme) {
  return scheme.description().variants;
}

std::string_view kind_of_variants(const SubdivisionScheme& scheme) {
  return scheme.description().variants_are;
}

Result<std::size_t> subdivision_variant(const SubdivisionScheme& scheme, std::string_view name) {
  const auto variants = variants_of(scheme);
  if (const auto found = std::ranges::find(variants, name); found != variants.end())
    return static_cast<std::size_t>(found - variants.begin());
  if (variants.empty())
    return Error{ErrorCode::invalid_value, R"({} has no variants, got "{}")", name_of(scheme), name};
  return Error{ErrorCode::invalid_value,
               R"({} has no {} "{}", expected one of {})",
               name_of(scheme),
               kind_of_variants(scheme),
               name,
               fmt::join(variants, ", ")};
}

}  // namespace algebra3d
