#pragma once

#include <atomic>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "mesh_formats/detail/read_mesh.h"

namespace mesh_formats {

/// Reads the bytes of an OFF file of Geomview, ASCII or binary; `file_name` is used in messages only.
///
///     [ST][C][N][4][n]OFF [BINARY]
///     vertices faces edges
///     x y z [w] [normal] [colour] [texture coordinates]
///     ...
///     n a b c ... [colour]
///     ...
///
/// Tolerated deviations from the format are listed at `read_ascii_off` and `read_binary_off`. In both encodings:
/// - Dropped, each with a remark and its count: faces of fewer than 3 corners, and text after the last face; also
///   normals, colours of vertices and of faces, and texture coordinates, if attributes are not wanted. A colour by its
///   number in a table, which no file has, is dropped.
/// - Colours are numbers from 0 to 1; those of a file in which one is above 1 are divided by 255. A normal of length 0
///   counts as none.
/// - Weights (`4OFF`) must be 1, since other weights yield coordinates that are not doubles in general. The dimension
///   (`nOFF`) must be 3.
/// - Errors are also coordinates that are not finite or beyond the range of double, invalid indices, and a file that
///   ends too early for its counts. The format has no name.
///
/// Faces and points are not welded, reordered or checked beyond finiteness. Exactness: binary coordinates are unchanged
/// floats; ASCII coordinates are the doubles nearest to their digits. Errors: file_format, with the byte (for ASCII
/// also the line), what was found and what was expected; limit_exceeded (2^32 vertices, or corners of faces);
/// interrupted, if `*cancel` is set (checked every 65536 vertices and faces). Cost: linear; memory for the soup and its
/// attributes only, bounded by the size of the file, whatever the header. Source: Geomview 1.9, manual, section 4.2.5.
algebra3d::Result<ReadMesh> read_off(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel = nullptr, Wanted wanted = Wanted::shape);

/// `read_off` for the file at `path`. Errors: also those of InputFile and FileContent (file_missing, io_error with the
/// system's reason, ...).
algebra3d::Result<ReadMesh> read_off_file(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

}  // namespace mesh_formats
