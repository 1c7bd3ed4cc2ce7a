#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/values/types/planar.h"

namespace algebra3d {

// Reading of GeoJSON with polygon geometries. Source: [rfc7946]. Coordinates after the second and unknown members
// (`crs`, `bbox`) are ignored. Numbers become the nearest doubles.

/// The parts of a feature that become attributes.
struct GeoFeature {
  std::optional<std::string> id;          ///< a string, or the text of a number
  std::optional<std::string> properties;  ///< the object as compact JSON
  Maybe<Region> shape;
};

/// The features of a GeoJSON text: those of a FeatureCollection, or a single Feature or bare geometry. Keeps 16 bytes
/// per feature, which are parsed on demand. The text must outlive it.
class GeoFeatures {
 public:
  /// Checks that the whole text is JSON, and its outermost object GeoJSON. Errors: file_format, "line 3, byte 57: ..."
  /// (both from 1) with what was found and expected; limit_exceeded; interrupted. Cost: linear.
  static Result<GeoFeatures> find(std::string_view text, const Monitor& monitor = {});

  std::size_t size() const { return places_.size(); }
  /// Parses a feature. Its shape is undefined if the geometry is malformed, not of polygons, or bounds no region.
  /// Positions in the reason are bytes of the whole text, from 1. Domain: an index below `size`. Errors: interrupted.
  Result<GeoFeature> feature(std::size_t index, const Monitor& monitor = {}) const;

 private:
  struct Place {
    std::size_t begin, end;
  };

  std::string_view text_;
  std::vector<Place> places_;
  bool is_bare_ = false;  // a geometry without a feature
};

/// The region of one geometry or Feature; undefined with the reason if there is none. Errors: interrupted.
Result<Maybe<Region>> region_of_geojson(std::string_view text, const Monitor& monitor = {});

}  // namespace algebra3d
