#include "algebra3d/kernel/subdivision/scheme.h"

#include <array>

namespace algebra3d {
namespace {

struct NamedScheme {
  std::string_view name;
  SubdivisionScheme scheme;
};
constexpr std::array<NamedScheme, 5> kSchemes = {{{"catmull-clark", SubdivisionScheme::catmull_clark},
                                                  {"doo-sabin", SubdivisionScheme::doo_sabin},
                                                  {"loop", SubdivisionScheme::loop},
                                                  {"butterfly", SubdivisionScheme::butterfly},
                                                  {"modified-butterfly", SubdivisionScheme::modified_butterfly}}};

}  // namespace

std::optional<SubdivisionScheme> subdivision_scheme(std::string_view name) {
  for (const NamedScheme& known : kSchemes)
    if (known.name == name) return known.scheme;
  return std::nullopt;
}

std::string_view name_of(SubdivisionScheme scheme) {
  for (const NamedScheme& known : kSchemes)
    if (known.scheme == scheme) return known.name;
  return {};
}

std::string subdivision_scheme_names() {
  std::string names;
  for (const NamedScheme& known : kSchemes) {
    if (!names.empty()) names += ", ";
    names += known.name;
  }
  return names;
}

bool takes_triangles_only(SubdivisionScheme scheme) {
  return scheme != SubdivisionScheme::catmull_clark && scheme != SubdivisionScheme::doo_sabin;
}

std::optional<LoopWeights> loop_weights(std::string_view name) {
  if (name == "loop") return LoopWeights::loop;
  if (name == "warren") return LoopWeights::warren;
  return std::nullopt;
}

}  // namespace algebra3d
