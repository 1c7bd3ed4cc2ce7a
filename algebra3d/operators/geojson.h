#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/types/planar.h"

namespace algebra3d {

// GeoJSON whose geometries are polygons. Source: [rfc7946]. Coordinates after the second are read and ignored, as are
// members that it does not know (`crs`, `bbox`). Numbers become the nearest doubles.

/// One feature as far as a relation takes it.
struct GeoFeature {
  std::optional<std::string> id;          ///< a string as it is, a number as it is written
  std::optional<std::string> properties;  ///< the object, without white space between its parts
  Maybe<Region> shape;
};

/// The features of a GeoJSON text: those of a FeatureCollection, or the one that a Feature or a bare geometry is.
/// Keeps 16 bytes per feature; each is taken apart when it is asked for. The text must outlive it.
class GeoFeatures {
 public:
  /// Checks that the whole text is JSON, and its outermost object GeoJSON. Errors: file_format, "line 3, byte 57: ..."
  /// (both from 1) with what was found and expected; limit_exceeded; interrupted. Cost: linear.
  static Result<GeoFeatures> find(std::string_view text, const Monitor& monitor = {});

  std::size_t size() const { return places_.size(); }
  /// The shape is undefined where the geometry is none of polygons, is malformed, or bounds no region. Places in its
  /// reason are bytes of the whole text, from 1. Domain: an index below `size`. Errors: interrupted.
  Result<GeoFeature> feature(std::size_t index, const Monitor& monitor = {}) const;

 private:
  struct Place {
    std::size_t begin, end;
  };

  std::string_view text_;
  std::vector<Place> places_;
  bool is_bare_ = false;  // a geometry without a feature
};

/// The region of one geometry or Feature, with the reason if there is none. Errors: interrupted.
Result<Maybe<Region>> region_of_geojson(std::string_view text, const Monitor& monitor = {});

}  // namespace algebra3d
