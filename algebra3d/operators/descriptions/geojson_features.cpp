// importGeoJSON: the features of a GeoJSON file as rows.
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/operators/registry/rows.h"
#include "algebra3d/values/conversions/geojson.h"
#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/scalars.h"
#include "base/error_subject.h"
#include "base/file_content.h"
#include "base/propagate.h"

namespace algebra3d {
namespace {

/// No, Id, Properties, Shape.
using FeatureRows = Rows<std::int64_t, std::optional<Text>, std::optional<Text>, std::optional<Region>>;

/// The features lie in the file's bytes.
struct FeatureFile {
  std::string name;  // as the user wrote it
  FileContent file;
  GeoFeatures features;
};

Result<std::shared_ptr<const FeatureFile>> open_features(const std::string& name, const Context& context) {
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(name));
  A3D_ASSIGN(FileContent file, FileContent::read(path, context.cancel));
  Result<GeoFeatures> features = GeoFeatures::find(file.bytes(), context.monitor());
  if (!features && features.error().code == ErrorCode::interrupted) return features.error();
  if (!features) return in_text_of(name, std::move(features).error());
  // Moving the file keeps the address of its bytes.
  return std::make_shared<const FeatureFile>(FeatureFile{name, std::move(file), *std::move(features)});
}

std::optional<Text> text_or_undefined(std::optional<std::string> text) {
  return text ? std::optional(Text{*std::move(text)}) : std::nullopt;
}

Result<FeatureRows::Cells> feature_row(const FeatureFile& from, std::size_t index, Context& context) {
  A3D_ASSIGN(GeoFeature feature, from.features.feature(index, context.monitor()));
  if (!feature.shape)
    context.diagnostics.report_undefined("importGeoJSON: " + feature.shape.reason(),
                                         fmt::format("{}, feature {}", from.name, index + 1));
  std::optional<Region> shape = feature.shape ? std::optional(*std::move(feature.shape)) : std::nullopt;
  return FeatureRows::Cells(static_cast<std::int64_t>(index + 1), text_or_undefined(std::move(feature.id)),
                            text_or_undefined(std::move(feature.properties)), std::move(shape));
}

Result<FeatureRows> features_of_file(Context& context, const Text& file) {
  auto opened = open_features(file.content, context);
  if (!opened && opened.error().code == ErrorCode::interrupted) return std::move(opened).error();
  if (!opened) return std::move(opened).error().about("importGeoJSON");
  using Next = Result<std::optional<FeatureRows::Cells>>;
  return FeatureRows([from = *opened, index = std::size_t{0}](Context& running) mutable -> Next {
    if (index == from->features.size()) return Next(std::nullopt);
    A3D_TRY(running.check_cancelled());
    A3D_ASSIGN(FeatureRows::Cells row, feature_row(*from, index++, running));
    return std::optional(std::move(row));
  });
}

}  // namespace

void register_geojson_features(OperatorGroup& group) {
  group.add({
      .name = "importGeoJSON",
      .host_name = "import_geojson",
      .syntax = "importGeoJSON(_)",
      .doc = "The features of a GeoJSON file, one row each, in order.",
      .detail =
          "Rows (No: int, Id: text, Properties: text, Shape: region): the number of the feature from 1; its id, "
          "undefined if it has none; its properties as JSON, for `jsonText` and `jsonNumber`. The file contains a "
          "FeatureCollection, one Feature, or a bare geometry. Shape is read as by `geojson2region`; it is "
          "undefined, with a diagnostic that names the feature, if the geometry is malformed, not of polygons, or "
          "bounds no region. A file that cannot be read or is not GeoJSON is an error; an undefined name has no "
          "rows. Relative names start at the working folder.",
      .exactness = Exactness::exact,
      .frame_use = FrameUse::coordinates,
      .cost = Cost::file,
      .is_pure = false,
      .reads_files = true,
      .sources = {"rfc7946"},
      .overloads = {table<&features_of_file>({"No", "Id", "Properties", "Shape"}, "file")},
      .examples = {{{"(text undefined)"}, "0", "(count _)"}},
      .errors = {{{"5"}, "importGeoJSON: expected (text), got (int)"}},
  });
}

}  // namespace algebra3d
