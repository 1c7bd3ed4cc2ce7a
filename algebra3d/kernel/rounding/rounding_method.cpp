#include "algebra3d/kernel/rounding/rounding_method.h"

namespace algebra3d {

const char* name_of(RoundingMethod method) {
  switch (method) {
    case RoundingMethod::none:
      return "unchanged";
    case RoundingMethod::vertices_moved:
      return "vertices moved";
    case RoundingMethod::edges_led_round:
      return "edges led round vertices";
    case RoundingMethod::crossings_divided:
      return "divided where triangles crossed";
    case RoundingMethod::gaps_closed:
      return "gaps narrower than the grid closed";
    case RoundingMethod::features_joined:
      return "features joined";
    case RoundingMethod::facets_made_coplanar:
      return "facets made coplanar";
    case RoundingMethod::faces_thickened:
      return "faces thickened and features joined";
    case RoundingMethod::cover_of_cubes:
      return "cover of cubes";
    case RoundingMethod::faces_of_cubes:
      return "faces of cubes";
  }
  return "";
}

}  // namespace algebra3d
