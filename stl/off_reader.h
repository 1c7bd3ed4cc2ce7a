#pragma once

#include <atomic>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/read_mesh.h"

namespace stl {

/// Reads the bytes of an OFF file of Geomview, ASCII or binary; `file_name` is used in messages only.
///
///     [ST][C][N][4][n]OFF [BINARY]
///     vertices faces edges
///     x y z [w] [normal] [colour] [texture coordinates]
///     ...
///     n a b c ... [colour]
///     ...
///
/// What is accepted beyond the letter of the format is listed at `read_ascii_off` and `read_binary_off`. In both forms:
/// - Left out, each with a remark and its count: normals, colours of vertices and of faces, texture coordinates, faces
///   of fewer than 3 corners, and what follows the last face.
/// - Weights (`4OFF`) must be 1: what else they give is no double in general. The dimension (`nOFF`) must be 3.
/// - Errors are also coordinates that are not finite or beyond the range of double, indices of no vertex, and a file
///   that ends before its counts are reached. The name stays empty: the format has none.
///
/// Faces and points are neither welded, nor reordered, nor checked beyond finiteness.
/// Exactness: binary coordinates are floats, passed on as they are; ASCII coordinates are the doubles nearest to their
/// digits.
/// Errors: file_format, naming the byte (for ASCII also the line), what was found and what was expected; limit_exceeded
/// (2^32 vertices, or corners of faces); interrupted, if `*cancel` was set (asked every 65536 vertices and faces).
/// Cost: linear; memory for the soup alone, bounded by the size of the file, whatever its header announces.
/// Source: Geomview 1.9, manual, section 4.2.5.
algebra3d::Result<ReadMesh> read_off(std::string_view bytes, std::string_view file_name,
                                     const std::atomic<bool>* cancel = nullptr);

/// `read_off` of the file at `path`, as it is while nobody changes it (FileContent).
/// Errors: besides those of read_off, those of InputFile and FileContent (file_missing, io_error with the system's
/// reason, ...).
algebra3d::Result<ReadMesh> read_off_file(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

}  // namespace stl
