// Any bytes: the WKT reader gives polygons or an error with a character in the text; what bounds a region is written
// and read back as the same region.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "algebra3d/values/conversions/wkt.h"
#include "algebra3d/values/types/planar.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  using algebra3d::Region;
  using algebra3d::Value;
  const auto polygons = algebra3d::polygons_from_wkt({reinterpret_cast<const char*>(data), size});
  if (!polygons) {
    require(polygons.error().text().starts_with("character "));
    return 0;
  }
  const auto region = Region::prove(*polygons);
  require(region.ok());
  if (!*region) return 0;
  const auto again = algebra3d::polygons_from_wkt(wkt_of((*region)->polygons()));
  require(again.ok());
  const auto proved = Region::prove(*again);
  require(proved.ok() && *proved);
  require(compare(Value::of<Region>(**region), Value::of<Region>(**proved)) == 0);
  return 0;
}
