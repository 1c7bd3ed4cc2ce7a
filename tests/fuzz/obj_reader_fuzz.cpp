// Any bytes: the OBJ reader gives a sound soup or an error that names the file, in time linear in the bytes, and the
// same with attributes; and its name tells its format, if its content does not.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/sound_soup.h"
#include "mesh_formats/mesh_formats.h"
#include "mesh_formats/obj/obj_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  require(mesh_formats::known_mesh_formats().detect(bytes, "fuzz.obj").ok());
  const auto read = mesh_formats::read_obj(bytes, "fuzz.obj");
  const auto with_attributes = mesh_formats::read_obj(bytes, "fuzz.obj", nullptr, mesh_formats::Wanted::attributes);
  require(read.ok() == with_attributes.ok());
  if (!read) {
    require(read.error().text().starts_with("fuzz.obj: "));
    return 0;
  }
  require_sound(read->soup);
  require(with_attributes->soup.corners == read->soup.corners && with_attributes->soup.points == read->soup.points);
  return 0;
}
