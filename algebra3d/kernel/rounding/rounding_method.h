#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace algebra3d {

/// The methods of rounding, from the one that changes least to the one that cannot fail (docs/set-operations.md).
enum class RoundingMethod : std::uint8_t {
  none,                  ///< nothing had to move
  vertices_moved,        ///< each vertex to the nearest point of the grid
  edges_led_round,       ///< as before, and edges led round vertices that they would have passed over
  crossings_divided,     ///< as before, and triangles divided where they crossed
  gaps_closed,           ///< gaps in a solid that are nowhere wider than the grid closed, and divided as before
  features_joined,       ///< features of crossing triangles that are nearly one joined
  facets_made_coplanar,  ///< facets that nearly lie upon each other made coplanar, then features joined
  faces_thickened,       ///< prisms over the faces added, with corners on a coarser grid
  cover_of_cubes,        ///< cubes that meet the solid in place of it; cannot fail
  faces_of_cubes,        ///< squares between cubes in place of a surface; cannot fail
};

/// The method in words, as in notes: "features joined".
const char* name_of(RoundingMethod method);

/// A row of the table of methods that rounding tries in turn, for pages and help.
struct RungInWords {
  std::string_view name;       ///< the method
  std::string_view condition;  ///< under which it is tried; may be empty
  std::string reach;  ///< within which features are joined, or how wide the cells of its lattice are; may be empty
  std::string_view promise;  ///< how far it may move the boundary
};

/// The ladder, in order.
std::vector<RungInWords> rounding_rungs();

}  // namespace algebra3d
