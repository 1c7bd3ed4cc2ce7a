// Any bytes: the GeoJSON reader gives features or an error with a place, and each feature's properties are JSON again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "algebra3d/values/conversions/geojson.h"
#include "algebra3d/values/conversions/json_tree.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_feature(const algebra3d::GeoFeature& feature) {
  require(feature.shape || !feature.shape.reason().empty());
  if (!feature.properties) return;
  const auto tree = algebra3d::JsonTree::parse(*feature.properties);
  require(tree.ok() && tree->kind(0) == algebra3d::JsonKind::object);
  require(algebra3d::compact_json(*feature.properties) == *feature.properties);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto tree = algebra3d::JsonTree::parse(text);
  if (tree) require(algebra3d::JsonTree::parse(algebra3d::compact_json(tree->text(0))).ok());
  require(algebra3d::region_of_geojson(text).ok());
  const auto features = algebra3d::GeoFeatures::find(text);
  if (!features) {
    require(features.error().text().starts_with("line "));
    return 0;
  }
  for (std::size_t i = 0; i < features->size(); ++i) {
    const auto feature = features->feature(i);
    require(feature.ok());
    check_feature(*feature);
  }
  return 0;
}
