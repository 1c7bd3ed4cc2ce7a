#pragma once

#include <atomic>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "mesh_formats/detail/read_mesh.h"

namespace mesh_formats {

/// Reads the bytes of a Wavefront OBJ file; `file_name` is used in messages only.
///
///     v x y z
///     f a b c ...
///
/// - Lines end with CR, LF or CRLF; the last line may have no end. A backslash at the end joins the next line as if by
///   a blank. A comment reaches from `#`, at the beginning of a word, to the end of the line, even after a backslash. A
///   byte order mark is skipped.
/// - Coordinates may be followed by a weight or a colour of three or four numbers. Neither changes the point: only
///   curves and surfaces have weights.
/// - A corner of a face is `v`, `v/t`, `v//n` or `v/t/n`; t and n need only be integers. A v above 0 counts from the
///   first vertex of the file and may refer to later vertices; one below 0 counts back from the last vertex before the
///   face.
/// - The name is that of the first object (`o`), else of the first group (`g`).
/// - Dropped, each kind with a remark and its count: texture coordinates, normals, colours, weights other than 1,
///   elements `l` and `p`, curves and surfaces, faces of fewer than 3 corners, statements with an unknown keyword (but
///   a file of nothing else is an error), NUL and Ctrl-Z bytes at the end. Without a remark: groups and materials.
/// - Everything else is an error, also a coordinate that is not finite or beyond the range of double. Numbers too small
///   for a double become zero.
///
/// With Wanted::attributes, texture coordinates and normals of corners are read, and groups, objects and materials of
/// faces; the others have no remark either: a `vt` may
/// have one to three numbers, of which the first two count; a name of `g`, `o` and `usemtl` is the rest of the line.
/// Indices of corners without an element become kNone, with a remark; malformed numbers are NaN.
///
/// Faces and points are not welded, reordered or checked beyond finiteness. Exactness: coordinates are the doubles
/// nearest to their digits. Errors: file_format, with byte and line, what was found and what was expected;
/// limit_exceeded (2^32 vertices, or corners of faces); interrupted, if `*cancel` is set (checked every 65536
/// statements). Cost: linear, one pass (two if an index is out of range); memory for the soup only, bounded by the size
/// of the file. Source: Wavefront Advanced Visualizer, appendix B1, version 3.0 of the format.
algebra3d::Result<ReadMesh> read_obj(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel = nullptr, Wanted wanted = Wanted::shape);

/// `read_obj` for the file at `path`. Errors: also those of InputFile and FileContent (file_missing, io_error with the
/// system's reason, ...).
algebra3d::Result<ReadMesh> read_obj_file(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

}  // namespace mesh_formats
