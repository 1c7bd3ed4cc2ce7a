// Any bytes: the OFF reader gives a sound soup or an error that names the file, in time linear in the bytes;
// and its name tells its format, if its content does not.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/sound_soup.h"
#include "mesh_formats/mesh_formats.h"
#include "mesh_formats/off/off_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  require(mesh_formats::known_mesh_formats().detect(bytes, "fuzz.off").ok());
  const auto read = mesh_formats::read_off(bytes, "fuzz.off");
  if (read)
    require_sound(read->soup);
  else
    require(read.error().text().starts_with("fuzz.off: "));
  return 0;
}
