#include "mesh_formats/foreign_file.h"

#include <array>
#include <utility>

namespace mesh_formats {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kForeignBeginnings{{
    {"SQLite format 3", "a SQLite database"},
    {"PK\x03\x04", "a ZIP archive (as .3mf and .xlsx files are)"},
    {"\x1f\x8b", "compressed by gzip"},
    {"\x28\xb5\x2f\xfd", "compressed by zstd"},
    {"\xfd"
     "7zXZ",
     "compressed by xz"},
    {"BZh", "compressed by bzip2"},
    {"7z\xbc\xaf", "a 7z archive"},
    {"Rar!\x1a", "a RAR archive"},
    {"\x7f"
     "ELF",
     "a program"},
    {"MZ\x90", "a program"},
    {"\xcf\xfa\xed\xfe", "a program"},
    {"\x89PNG", "a PNG image"},
    {"\xff\xd8\xff", "a JPEG image"},
    {"%PDF", "a PDF document"},
    {"glTF", "a binary glTF model"},
    {"Kaydara FBX", "an FBX model"},
    {"\xff\xfe", "text in UTF-16, not UTF-8"},
    {"\xfe\xff", "text in UTF-16, not UTF-8"},
}};

// A tar archive begins with the name of its first file.
bool is_tar(std::string_view head) {
  constexpr std::size_t kMagicPlace = 257;
  return head.size() > kMagicPlace && head.substr(kMagicPlace).starts_with("ustar");
}

// Text of Latin letters in UTF-16 has a zero in every second byte, also without a mark at the beginning.
bool is_utf16(std::string_view head) {
  constexpr std::size_t kSampleBytes = 64, kLeastBytes = 16;
  const std::string_view sample = head.substr(0, kSampleBytes);
  if (sample.size() < kLeastBytes) return false;
  const auto is_text = [](char c) { return c == '\t' || c == '\r' || c == '\n' || (c >= ' ' && c <= '~'); };
  const auto is_pair = [&](std::size_t i, std::size_t zero) {
    return sample[i + zero] == 0 && is_text(sample[i + 1 - zero]);
  };
  for (const std::size_t zero : {0, 1}) {
    std::size_t i = 0;
    while (i + 1 < sample.size() && is_pair(i, zero)) i += 2;
    if (i + 1 >= sample.size()) return true;
  }
  return false;
}

}  // namespace

std::string_view foreign_kind(std::string_view head) {
  for (const auto& [beginning, kind] : kForeignBeginnings)
    if (head.starts_with(beginning)) return kind;
  if (is_utf16(head)) return "text in UTF-16, not UTF-8";
  return is_tar(head) ? "a tar archive" : "";
}

Status refuse_foreign(std::string_view bytes, std::string_view file_name, std::string_view expected) {
  const std::string_view kind = foreign_kind(bytes);
  if (kind.empty()) return {};
  return Error{ErrorCode::file_format, "it is {}; expected an {} file", kind, expected}.about(file_name);
}

}  // namespace mesh_formats
