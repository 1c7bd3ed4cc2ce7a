// Any bytes: the OBJ reader gives a sound soup or an error that names the file, in time linear in the bytes;
// and its name tells its format, if its content does not.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/sound_soup.h"
#include "stl/mesh_format.h"
#include "stl/obj_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  require(stl::detect_mesh_format(bytes, "fuzz.obj").ok());
  const auto read = stl::read_obj(bytes, "fuzz.obj");
  if (read)
    require_sound(read->soup);
  else
    require(read.error().message.starts_with("fuzz.obj: "));
  return 0;
}
