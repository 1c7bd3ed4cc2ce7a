#pragma once

#include <string>
#include <string_view>

#include "algebra3d/values/types/nested_list.h"
#include "base/context.h"

namespace algebra3d {

// File atoms: `<file>path</file--->` stands for the content of a file. In a nested list it is a symbol, so reading a
// list needs no files; the file is read when the atom becomes a value of type text, as base64, or of type bytes.

inline constexpr std::string_view kFileAtomBegin = "<file>";
inline constexpr std::string_view kFileAtomEnd = "</file--->";
/// Maximum size of the file of an atom.
inline constexpr std::uintmax_t kMaxFileAtomBytes = std::uintmax_t{64} << 20U;

NestedList file_atom(std::string_view path);
bool is_file_atom(const NestedList& list);
bool is_file_atom(std::string_view symbol);

/// The bytes of the file; `atom` is a file atom. Relative paths are resolved by the context. Errors: file_missing, also
/// of anything but a regular file; limit_exceeded; io_error.
Result<std::string> file_atom_bytes(const NestedList& atom, const Context& context);
/// These in base64, without line breaks.
Result<std::string> file_atom_content(const NestedList& atom, const Context& context);

/// Encodes bytes in base64 with padding. Source: [rfc4648], section 4.
std::string base64(std::string_view bytes);

}  // namespace algebra3d
