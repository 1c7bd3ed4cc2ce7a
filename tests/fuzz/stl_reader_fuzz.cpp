// Any bytes: the STL reader gives finite triangles or an error that names the file, in time linear in the bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "stl/stl_reader.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_value(const mesh_formats::ReadStl& read) {
  require(read.soup.normals.size() == read.soup.triangles.size());
  require(read.solid_count > 0);
  for (const auto& triangle : read.soup.triangles)
    for (const auto& corner : triangle) require(is_finite(corner));
  for (const auto& normal : read.soup.normals) require(is_finite(normal));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT(*-naming)
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto read = mesh_formats::read_stl(bytes, "fuzz.stl");
  if (read)
    check_value(*read);
  else
    require(read.error().text().starts_with("fuzz.stl: "));
  return 0;
}
