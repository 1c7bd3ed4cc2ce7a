#include "algebra3d/values/conversions/geojson.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "algebra3d/values/conversions/detail/closed_rings.h"
#include "algebra3d/values/conversions/json_tree.h"
#include "algebra3d/values/types/utf8.h"
#include "base/ascii_cursor.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {
namespace {

constexpr std::size_t kMostFeatures = std::numeric_limits<std::int32_t>::max();
constexpr std::array<std::string_view, 7> kGeometries = {
    "Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon", "GeometryCollection"};

std::string_view name_of(JsonKind kind) {
  switch (kind) {
    case JsonKind::object:
      return "an object";
    case JsonKind::array:
      return "an array";
    case JsonKind::key:
      return "a key";
    case JsonKind::string:
      return "a string";
    case JsonKind::number:
      return "a number";
    case JsonKind::boolean:
      return "a boolean";
    case JsonKind::null:
      return "null";
  }
  return "";
}

/// Reads what is in a tree as GeoJSON. Positions in messages begin at `offset`.
class GeoReader {
 public:
  GeoReader(const JsonTree& tree, std::size_t offset) : tree_(tree), offset_(offset) {}

  Result<Polygons> polygons_of_geometry(std::size_t part);
  Result<Polygons> polygons_of_feature(std::size_t part);

  std::optional<std::string> type_of(std::size_t part) const {
    const auto type = tree_.member(part, "type", JsonKind::string);
    return type ? std::optional(tree_.content(*type)) : std::nullopt;
  }
  /// For messages: "a Feature", "an object without a type", "a number".
  std::string found(std::size_t part) const;
  Error expected(std::size_t part, std::string_view what) const {
    return {ErrorCode::file_format, "byte {}: found {}, expected {}", place(part), found(part), what};
  }

 private:
  std::size_t place(std::size_t part) const { return offset_ + tree_.begin(part) + 1; }
  Error missing(std::size_t part, std::string_view what) const {
    return {ErrorCode::file_format, "byte {}: found {} without {}", place(part), found(part), what};
  }
  Status read_geometry(std::size_t part);
  Status read_collection(std::size_t part);
  Status read_multiple(std::size_t part);
  Status read_polygon(std::size_t part);
  Status read_ring(std::size_t part);
  Status read_position(std::size_t part);
  Result<double> number(std::size_t part) const;

  const JsonTree& tree_;
  std::size_t offset_;
  ClosedRings rings_;
};

std::string GeoReader::found(std::size_t part) const {
  if (tree_.kind(part) != JsonKind::object) return std::string(name_of(tree_.kind(part)));
  const auto type = type_of(part);
  return type ? "the type " + found_text(*type + " ") : "an object without a type";
}

Result<double> GeoReader::number(std::size_t part) const {
  if (tree_.kind(part) != JsonKind::number) return expected(part, "a number");
  const std::string_view digits = tree_.text(part);
  double value = 0;
  if (AsciiCursor(digits.data(), digits.data() + digits.size()).take_number(value) != NumberKind::finite)
    return Error{ErrorCode::file_format, "byte {}: found {}, expected a number within the range of doubles",
                 place(part), found_text(digits)};
  return value;
}

Status GeoReader::read_position(std::size_t part) {
  if (tree_.kind(part) != JsonKind::array) return expected(part, "a position [x, y]");
  std::array<double, 2> position{};
  std::size_t count = 0;
  for (std::size_t part_of = JsonTree::first(part); part_of != tree_.end(part); part_of = tree_.after(part_of)) {
    A3D_ASSIGN(const double value, number(part_of));
    if (count < 2) position[count] = value;
    ++count;
  }
  if (count < 2)
    return Error{ErrorCode::file_format, "byte {}: found a position of {}, expected at least 2", place(part),
                 counted(count, "number")};
  rings_.add_point(position[0], position[1]);
  return {};
}

Status GeoReader::read_ring(std::size_t part) {
  if (tree_.kind(part) != JsonKind::array) return expected(part, "a ring of positions");
  for (std::size_t position = JsonTree::first(part); position != tree_.end(part); position = tree_.after(position))
    A3D_TRY(read_position(position));
  Status ended = rings_.end_ring();
  if (!ended) return std::move(ended).error().about(fmt::format("byte {}", place(part)));
  return {};
}

Status GeoReader::read_polygon(std::size_t part) {
  if (tree_.kind(part) != JsonKind::array) return expected(part, "an array of rings");
  for (std::size_t ring = JsonTree::first(part); ring != tree_.end(part); ring = tree_.after(ring))
    A3D_TRY(read_ring(ring));
  rings_.end_face();
  return {};
}

Status GeoReader::read_multiple(std::size_t part) {
  if (tree_.kind(part) != JsonKind::array) return expected(part, "an array of polygons");
  for (std::size_t polygon = JsonTree::first(part); polygon != tree_.end(part); polygon = tree_.after(polygon))
    A3D_TRY(read_polygon(polygon));
  return {};
}

Status GeoReader::read_geometry(std::size_t part) {
  const auto type = type_of(part);
  const bool is_multiple = type == "MultiPolygon";
  if (!is_multiple && type != "Polygon") return expected(part, "a Polygon or MultiPolygon");
  const auto coordinates = tree_.member(part, "coordinates");
  if (!coordinates) return missing(part, "\"coordinates\"");
  return is_multiple ? read_multiple(*coordinates) : read_polygon(*coordinates);
}

Status GeoReader::read_collection(std::size_t part) {
  const auto geometries = tree_.member(part, "geometries", JsonKind::array);
  if (!geometries) return missing(part, "an array \"geometries\"");
  for (std::size_t one = JsonTree::first(*geometries); one != tree_.end(*geometries); one = tree_.after(one))
    A3D_TRY(read_geometry(one));
  return {};
}

Result<Polygons> GeoReader::polygons_of_geometry(std::size_t part) {
  const auto type = type_of(part);
  if (type == "GeometryCollection") {
    A3D_TRY(read_collection(part));
  } else if (type == "Polygon" || type == "MultiPolygon") {
    A3D_TRY(read_geometry(part));
  } else {
    return expected(part, "a Polygon, a MultiPolygon or a GeometryCollection of these");
  }
  return std::move(rings_).polygons();
}

Result<Polygons> GeoReader::polygons_of_feature(std::size_t part) {
  if (type_of(part) != "Feature") return expected(part, "a Feature");
  const auto geometry = tree_.member(part, "geometry");
  if (!geometry) return missing(part, "\"geometry\"");
  return polygons_of_geometry(*geometry);
}

/// The region of the polygons that were read, proved. Errors: interrupted.
Result<Maybe<Region>> proved(const Result<Polygons>& polygons, const Monitor& monitor) {
  if (!polygons) return Maybe<Region>(Undefined{polygons.error().text()});
  return Region::prove(*polygons, monitor);
}

std::optional<std::string> id_of_feature(const JsonTree& tree) {
  const auto id = tree.member(0, "id");
  if (!id) return std::nullopt;
  if (tree.kind(*id) == JsonKind::number) return std::string(tree.text(*id));
  if (tree.kind(*id) != JsonKind::string) return std::nullopt;
  std::string content = tree.content(*id);
  if (first_no_text(content) != std::string::npos) return std::string(tree.text(*id));  // \u0000 stays as it is written
  return content;
}

std::optional<std::string> properties_of(const JsonTree& tree) {
  const auto properties = tree.member(0, "properties", JsonKind::object);
  return properties ? std::optional(compact_json(tree.text(*properties))) : std::nullopt;
}

/// The error with the line of that part.
Error at_line(Error error, std::string_view text, std::size_t begin) {
  error.message = fmt::format("line {}, {}", line_number(text, begin), error.text());
  return error;
}

}  // namespace

Result<GeoFeatures> GeoFeatures::find(std::string_view text, const Monitor& monitor) {
  // The object, its members, and the features, but nothing in them.
  A3D_ASSIGN(const JsonTree tree, JsonTree::parse(text, 2, monitor));
  const GeoReader reader(tree, 0);
  const auto type = reader.type_of(0);
  GeoFeatures result;
  result.text_ = text;
  if (type == "FeatureCollection") {
    const auto features = tree.member(0, "features");
    if (!features || tree.kind(*features) != JsonKind::array)
      return at_line(reader.expected(0, "it to have an array \"features\""), text, tree.begin(0));
    for (std::size_t one = JsonTree::first(*features); one != tree.end(*features); one = tree.after(one))
      result.places_.push_back({tree.begin(one), tree.begin(one) + tree.text(one).size()});
    if (result.size() > kMostFeatures)
      return Error{ErrorCode::limit_exceeded, "found {} features, expected at most {}", result.size(), kMostFeatures};
    return result;
  }
  result.is_bare_ = type && std::ranges::find(kGeometries, *type) != kGeometries.end();
  if (!result.is_bare_ && type != "Feature")
    return at_line(reader.expected(0, "a FeatureCollection, a Feature or a geometry"), text, tree.begin(0));
  result.places_.push_back({tree.begin(0), tree.begin(0) + tree.text(0).size()});
  return result;
}

Result<GeoFeature> GeoFeatures::feature(std::size_t index, const Monitor& monitor) const {
  const auto [begin, end] = places_[index];
  A3D_ASSIGN(const JsonTree tree, JsonTree::parse(text_.substr(begin, end - begin), JsonTree::kWholeDepth, monitor));
  GeoReader reader(tree, begin);
  const auto polygons = is_bare_ ? reader.polygons_of_geometry(0) : reader.polygons_of_feature(0);
  A3D_ASSIGN(auto shape, proved(polygons, monitor));
  if (is_bare_) return GeoFeature{{}, {}, std::move(shape)};
  return GeoFeature{id_of_feature(tree), properties_of(tree), std::move(shape)};
}

Result<Maybe<Region>> region_of_geojson(std::string_view text, const Monitor& monitor) {
  const auto tree = JsonTree::parse(text, JsonTree::kWholeDepth, monitor);
  if (!tree && tree.error().code == ErrorCode::interrupted) return tree.error();
  if (!tree) return Maybe<Region>(Undefined{tree.error().text()});
  GeoReader reader(*tree, 0);
  const bool is_feature = reader.type_of(0) == "Feature";
  return proved(is_feature ? reader.polygons_of_feature(0) : reader.polygons_of_geometry(0), monitor);
}

}  // namespace algebra3d
