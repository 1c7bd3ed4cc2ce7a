// importGeoJSON: the features of a GeoJSON file as tuples.
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/geojson.h"
#include "algebra3d/types/planar.h"
#include "algebra3d/types/scalars.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"
#include "stl/file_content.h"

namespace queries {
namespace {

using algebra3d::GeoFeature;
using algebra3d::GeoFeatures;
using algebra3d::Region;
using algebra3d::Text;
using algebra3d::TypeOf;

TypeExpr feature_type() {
  return TypeExpr::tuple({{"No", TypeExpr("int")},
                          {"Id", TypeExpr("text")},
                          {"Properties", TypeExpr("text")},
                          {"Shape", TypeExpr("region")}});
}

/// The features lie in the file's bytes.
struct FeatureFile {
  std::string name;  // as the user wrote it
  stl::FileContent file;
  GeoFeatures features;
};

Result<std::shared_ptr<const FeatureFile>> open_features(const std::string& name, const Context& context) {
  ASSIGN_OR_RETURN(stl::FileContent file, stl::FileContent::read(context.resolve(name), context.cancel));
  Result<GeoFeatures> features = GeoFeatures::find(file.bytes(), context.monitor());
  if (!features && features.error().code == ErrorCode::interrupted) return features.error();
  if (!features) return Error{features.error().code, "{} {}", name, features.error().message};
  // Moving the file keeps the address of its bytes.
  return std::make_shared<const FeatureFile>(FeatureFile{name, std::move(file), *std::move(features)});
}

Value text_or_undefined(std::optional<std::string> text) {
  return text ? Value::of<Text>({*std::move(text)}) : Value(TypeOf<Text>::type());
}

Result<TuplePtr> feature_tuple(const FeatureFile& from, std::size_t index, Context& context) {
  ASSIGN_OR_RETURN(GeoFeature feature, from.features.feature(index, context.monitor()));
  if (!feature.shape)
    context.diagnostics.report_undefined("importGeoJSON: " + feature.shape.reason(),
                                         fmt::format("{}, feature {}", from.name, index + 1));
  Value shape = feature.shape ? Value::of<Region>(*std::move(feature.shape)) : Value(TypeOf<Region>::type());
  return std::make_shared<const Tuple>(
      Tuple{{Value::of(static_cast<std::int64_t>(index + 1)), text_or_undefined(std::move(feature.id)),
             text_or_undefined(std::move(feature.properties)), std::move(shape)}});
}

TupleStreamPtr no_tuples() {
  return make_stream([]() -> Result<TuplePtr> { return TuplePtr(); });
}

Result<Datum> run_import(const std::vector<Datum>& given, Context& context) {
  if (!given[0].value().is_defined()) return Datum{no_tuples()};
  const auto opened = open_features(given[0].value().get<Text>().content, context);
  if (!opened && opened.error().code == ErrorCode::interrupted) return opened.error();
  if (!opened) return Error{opened.error().code, "importGeoJSON: {}", opened.error().message};
  return Datum{make_stream([from = *opened, &context, index = std::size_t{0}]() mutable -> Result<TuplePtr> {
    if (index == from->features.size()) return TuplePtr();
    RETURN_IF_ERROR(context.check_cancelled());
    return feature_tuple(*from, index++, context);
  })};
}

Result<Plan> map_import_geojson(std::span<const ArgumentType> arguments) {
  const MappingCheck check("importGeoJSON", arguments);
  RETURN_IF_ERROR(check.argument_count(1, 1));
  RETURN_IF_ERROR(check.characters(0));
  return Plan{TypeExpr::stream(feature_type()), run_import};
}

}  // namespace

void register_geojson_features(algebra3d::Registry& registry) {
  registry.add({
      .name = "importGeoJSON",
      .syntax = "importGeoJSON(_)",
      .doc = "The features of a GeoJSON file, one tuple for each, in their order.",
      .detail =
          "Tuples (No: int, Id: text, Properties: text, Shape: region): the number of the feature from 1; its id, "
          "undefined if it has none; its properties as JSON, for `jsonText` and `jsonNumber`. The file holds a "
          "FeatureCollection, one Feature, or a bare geometry. Shape is read as `geojson2region` does it, and is "
          "undefined, with a diagnostic that names the feature, where the geometry is none of polygons, is malformed, "
          "or bounds no region. A file that cannot be read or is no GeoJSON is an error; an undefined name has no "
          "tuples. "
          "Relative names start at the folder of the session.",
      .exactness = algebra3d::Exactness::exact,
      .frame_use = algebra3d::FrameUse::coordinates,
      .sources = {"rfc7946"},
      .stream = stream_operator(map_import_geojson),
      .signatures = {"(text) -> stream(tuple)"},
      .handles_undefined = true,
      .examples = {{"importGeoJSON([const text value undefined]) count", "0"}},
      .errors = {{"query importGeoJSON(5) count", "importGeoJSON: expected text, got int"}},
  });
}

}  // namespace queries
