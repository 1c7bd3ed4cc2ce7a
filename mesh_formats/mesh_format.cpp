#include "mesh_formats/mesh_format.h"

#include <algorithm>
#include <string>

#include "base/atomic_file.h"
#include "mesh_formats/file_ending.h"

namespace mesh_formats {

const FileForm* MeshFormat::form(Encoding encoding) const {
  const auto found = std::ranges::find(forms, encoding, &FileForm::encoding);
  return found == forms.end() ? nullptr : &*found;
}

algebra3d::Status MeshFormat::write_file(const algebra3d::OutputPath& path, const Facets& facets,
                                         std::string_view solid_name, Encoding encoding) const {
  return algebra3d::write_file(path,
                               [&](algebra3d::ByteSink& sink) { return write(sink, facets, solid_name, encoding); });
}

std::string MeshFormat::word_of(const FileForm& form) const {
  std::string word(name);
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (form.encoding == forms.front().encoding) return word;
  return word + (form.encoding == Encoding::ascii ? "-ascii" : "-binary");
}

bool MeshFormat::has_ending_of(std::string_view file_name) const {
  return std::ranges::find(endings, file_ending(file_name)) != endings.end();
}

}  // namespace mesh_formats
