#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "algebra3d/base/error.h"

namespace stl {

/// The mesh files that can be read.
enum class MeshFormat { stl, obj, off };

/// "STL", "OBJ" or "OFF".
std::string_view name_of(MeshFormat format);

/// The format that the ending of a file's name says, in any case: .stl, .obj or .off.
std::optional<MeshFormat> format_of_name(std::string_view file_name);

/// The format that a content has without doubt, whatever the name of its file; see the first rule of
/// `detect_mesh_format`. Cost: constant but for the comments.
std::optional<MeshFormat> format_of_content(std::string_view bytes);

/// The format of the file of these bytes and this name; nothing is read beyond its first statement.
///
/// 1. The content decides, where it leaves no doubt, whatever the name says: a size that is exactly that of a binary
///    STL file; a header line of binary OFF; or, in a file of text, the first word behind a byte order mark, white
///    space and comments from `#`: `OFF` with its letters (see `off_header`) for OFF, `solid` in any case for STL, a
///    keyword of OBJ (`v`, `f`, `o`, `g`, `mtllib`, ...) for OBJ. What is text, says `detect_format`.
/// 2. Else a file of another program is refused, whatever its name says; see `refuse_foreign`.
/// 3. Else the name decides by its ending `.stl`, `.obj` or `.off`, in any case: so an OFF file may begin with its
///    counts, an OBJ file hold comments alone, and a faulty file has its error from the reader it was meant for.
/// 4. Else what is no text in its first 1024 bytes, and at least 84 bytes long, is binary STL with a wrong count.
///
/// Errors: file_format for everything else.
/// Cost: constant but for the comments.
algebra3d::Result<MeshFormat> detect_mesh_format(std::string_view bytes, std::string_view file_name);

/// `detect_mesh_format` of the file at `path`, as it is while nobody changes it (FileContent).
/// Errors: besides that, those of InputFile and FileContent (file_missing, io_error with the system's reason, ...).
algebra3d::Result<MeshFormat> detect_mesh_format_of_file(const std::filesystem::path& path);

}  // namespace stl
