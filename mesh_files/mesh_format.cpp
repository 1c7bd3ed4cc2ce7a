#include "mesh_files/mesh_format.h"

#include <algorithm>
#include <string>

#include "algebra3d/base/ascii_cursor.h"
#include "algebra3d/base/text.h"

namespace mesh_files {

using algebra3d::AsciiCursor;
using algebra3d::is_blank;

namespace {

// Enough to hold, in a binary STL file, several facets with their zero bytes.
constexpr std::size_t kTextSampleBytes = 1024;

}  // namespace

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

bool begins_as_text(std::string_view bytes) {
  const std::string_view sample = bytes.substr(0, kTextSampleBytes);
  return std::ranges::none_of(sample, [](char c) { return static_cast<unsigned char>(c) < ' ' && !is_blank(c); });
}

std::string_view first_word(std::string_view bytes) {
  AsciiCursor cursor(bytes.data(), bytes.data() + bytes.size());
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.move_to(bytes.data() + 3);
  cursor.skip_space();
  const char* const begin = cursor.position();
  cursor.skip_word();
  return {begin, static_cast<std::size_t>(cursor.position() - begin)};
}

}  // namespace mesh_files
