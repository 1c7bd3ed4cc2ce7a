#include "mesh_formats/mesh_formats.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/file_content.h"
#include "base/propagate.h"
#include "mesh_formats/foreign_file.h"
#include "mesh_formats/obj/obj_format.h"
#include "mesh_formats/off/off_format.h"
#include "mesh_formats/stl/stl_format.h"

namespace mesh_formats {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FileContent;
using algebra3d::Result;

const MeshFormats& known_mesh_formats() {
  static const MeshFormats formats({
      stl_format(),
      obj_format(),
      off_format(),
  });
  return formats;
}

namespace {

/// "a, b or c"
std::string listed(const std::vector<std::string>& words, std::string_view conjunction) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : fmt::format(" {} ", conjunction);
    text += words[i];
  }
  return text;
}

}  // namespace

const MeshFormat* MeshFormats::named(std::string_view name) const {
  const auto found = std::ranges::find(formats_, name, &MeshFormat::name);
  return found == formats_.end() ? nullptr : &*found;
}

const MeshFormat* MeshFormats::of_name(std::string_view file_name) const {
  const auto found = std::ranges::find_if(formats_, [&](const MeshFormat& f) { return f.has_ending_of(file_name); });
  return found == formats_.end() ? nullptr : &*found;
}

const MeshFormat* MeshFormats::of_content(std::string_view head, std::size_t size) const {
  const auto found =
      std::ranges::find(formats_, Match::sure, [&](const MeshFormat& f) { return f.detect(head, size); });
  return found == formats_.end() ? nullptr : &*found;
}

Result<const MeshFormat*> MeshFormats::detect(std::string_view bytes, std::string_view file_name) const {
  if (const MeshFormat* const format = of_content(bytes)) return format;
  A3D_TRY(refuse_foreign(bytes, file_name, names("or")));
  if (const MeshFormat* const format = of_name(file_name)) return format;
  for (const MeshFormat& format : formats_)
    if (format.detect(bytes, bytes.size()) == Match::possible) return &format;
  return Error{ErrorCode::file_format, "neither content nor name is that of a mesh file; expected {}", names("or")}
      .about(file_name);
}

Result<const MeshFormat*> MeshFormats::detect_file(const std::filesystem::path& path) const {
  A3D_ASSIGN(const FileContent file, FileContent::read(path));
  return detect(file.bytes(), path.string());
}

std::string MeshFormats::names(std::string_view conjunction) const {
  std::vector<std::string> words;
  for (const MeshFormat& format : formats_) words.emplace_back(format.name);
  return listed(words, conjunction);
}

std::vector<MeshFormats::FormatForm> MeshFormats::forms() const {
  std::vector<FormatForm> forms;
  for (const MeshFormat& format : formats_)
    for (const FileForm& form : format.forms) forms.push_back({&format, &form});
  return forms;
}

std::string MeshFormats::form_words(std::string_view conjunction) const {
  std::vector<std::string> words;
  for (const auto& [format, form] : forms()) words.push_back(format->word_of(*form));
  return listed(words, conjunction);
}

std::string MeshFormats::endings(std::string_view conjunction, std::string_view before) const {
  std::vector<std::string> words;
  for (const MeshFormat& format : formats_)
    for (const std::string_view ending : format.endings) words.push_back(std::string(before) + std::string(ending));
  return listed(words, conjunction);
}

}  // namespace mesh_formats
