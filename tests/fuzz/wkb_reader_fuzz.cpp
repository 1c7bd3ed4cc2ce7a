// Any bytes: the WKB reader gives a geometry or an error with a byte in the text; its polygons make a mesh or an error;
// what was read is written and read back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "algebra3d/values/conversions/wkb.h"
#include "algebra3d/values/types/planar.h"

namespace {

using algebra3d::WkbContents;

void require(bool holds) {
  if (!holds) std::abort();
}

bool names_a_byte(const algebra3d::Error& error) {
  return error.text().starts_with("byte ");
}

void try_faces(std::string_view bytes, algebra3d::Srid srid) {
  const auto read = algebra3d::read_wkb(bytes, WkbContents::faces, srid);
  if (!read) return require(names_a_byte(read.error()));
  const auto mesh = mesh_of_wkb(*read, algebra3d::WkbHoles::triangulated);
  if (!mesh) return require(names_a_byte(mesh.error()));
  const auto written = wkb_of_mesh(*mesh, srid);
  require(written.ok());
  const auto again = algebra3d::read_wkb(*written, WkbContents::faces, srid);
  require(again.ok() && again->polygon_count() == mesh->face_count());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto srid = algebra3d::srid_of_wkb(bytes);
  if (!srid) {
    require(names_a_byte(srid.error()));
    return 0;
  }
  try_faces(bytes, *srid);
  for (const WkbContents contents : {WkbContents::points, WkbContents::point}) {
    const auto read = algebra3d::read_wkb(bytes, contents, *srid);
    require(read.ok() || names_a_byte(read.error()));
  }
  const auto read = algebra3d::read_wkb(bytes, WkbContents::region, *srid);
  if (!read) {
    require(names_a_byte(read.error()));
    return 0;
  }
  const auto region = algebra3d::Region::prove(polygons_of_wkb(*read));
  require(region.ok());
  if (!*region) return 0;
  const auto written = wkb_of_region((*region)->polygons(), *srid);
  require(written.ok());
  const auto again = algebra3d::read_wkb(*written, WkbContents::region, *srid);
  require(again.ok());
  const auto proved = algebra3d::Region::prove(polygons_of_wkb(*again));
  require(proved.ok() && *proved);
  return 0;
}
