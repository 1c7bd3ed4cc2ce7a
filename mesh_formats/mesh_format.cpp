#include "mesh_formats/mesh_format.h"

#include <algorithm>
#include <string>

namespace mesh_formats {

const FileForm* MeshFormat::form(Encoding encoding) const {
  const auto found = std::ranges::find(forms, encoding, &FileForm::encoding);
  return found == forms.end() ? nullptr : &*found;
}

bool MeshFormat::has_ending_of(std::string_view file_name) const {
  std::string ending = std::filesystem::path(file_name).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::ranges::find(endings, ending) != endings.end();
}

}  // namespace mesh_formats
