#include "algebra3d/values/types/file_atom.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/open_databases.h"
#include "base/propagate.h"

namespace algebra3d {

NestedList file_atom(std::string_view path) {
  return NestedList::symbol(std::string(kFileAtomBegin) + std::string(path) + std::string(kFileAtomEnd));
}

bool is_file_atom(std::string_view symbol) {
  return symbol.starts_with(kFileAtomBegin) && symbol.ends_with(kFileAtomEnd);
}

bool is_file_atom(const NestedList& list) {
  return list.is_symbol() && is_file_atom(list.as_symbol());
}

Result<std::string> file_atom_bytes(const NestedList& atom, const Context& context) {
  std::string_view path = atom.as_symbol();
  path.remove_prefix(kFileAtomBegin.size());
  path.remove_suffix(kFileAtomEnd.size());
  A3D_ASSIGN(const std::filesystem::path file, context.resolve(path));
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    return Error{ErrorCode::file_missing, "file atom '{}': there is no such file", path};
  if (!std::filesystem::is_regular_file(status))
    return Error{ErrorCode::file_missing, "file atom '{}': expected a file, found something else", path};
  if (open_database_with(file))
    return Error{ErrorCode::file_missing, "file atom '{}': this file holds the open database", path};
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error && size > kMaxFileAtomBytes)
    return Error{ErrorCode::limit_exceeded, "file atom '{}': the file has {} bytes, at most {} are read", path, size,
                 kMaxFileAtomBytes};
  std::string bytes(error ? 0 : static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (error || !stream) return Error{ErrorCode::io_error, "file atom '{}': the file cannot be read", path};
  return bytes;
}

Result<std::string> file_atom_content(const NestedList& atom, const Context& context) {
  A3D_ASSIGN(const std::string bytes, file_atom_bytes(atom, context));
  return base64(bytes);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t begin = 0; begin < bytes.size(); begin += 3) {
    const std::string_view group = bytes.substr(begin, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8U | (i < group.size() ? static_cast<unsigned char>(group[i]) : 0U);
    // n bytes fill n + 1 digits.
    for (std::size_t i = 0; i < 4; ++i) text += i <= group.size() ? kDigits[bits >> (18U - 6U * i) & 63U] : '=';
  }
  return text;
}

}  // namespace algebra3d
