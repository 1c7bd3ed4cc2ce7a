#pragma once

#include <atomic>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/stl_content.h"

namespace mesh_formats {

/// Reads the bytes of an STL file, ASCII or binary; `file_name` is used in messages only.
///
/// Tolerated deviations from the format are listed at `read_ascii` and `read_binary`; each has a remark. Facets are not
/// welded, reordered or checked beyond finiteness. Exactness: binary coordinates are unchanged floats; ASCII
/// coordinates are the doubles nearest to their digits (not floats: more digits are kept, and numbers beyond the range
/// of float are accepted). Errors: file_format, with the byte (for ASCII also the line), what was found and what was
/// expected; interrupted, if `*cancel` is set (checked every 65536 facets). Cost: linear, one pass; memory for the soup
/// only, bounded by the size of the file, whatever the header.
algebra3d::Result<ReadStl> read_stl(std::string_view bytes, std::string_view file_name,
                                    const std::atomic<bool>* cancel = nullptr);

/// `read_stl` for the file at `path`. Errors: also those of InputFile and FileContent (file_missing, io_error with the
/// system's reason, ...).
algebra3d::Result<ReadStl> read_stl_file(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

/// Detects the encoding of a file. `size`: its size; `head`: at least its first kilobyte, or all of it. The decision is
/// final:
/// - Binary, if the size is exactly that of the announced facets: a text of that size would be over 7 GB long, since
///   four characters as a count are at least 151 million.
/// - Else ASCII, if the first 1024 bytes are text (no control characters but white space), or begin with `solid` and
///   contain `facet` and `vertex` (so that a stray control character is reported as such).
/// - Else binary, if the file has the 84 bytes of header and count.
/// Errors: file_format for a file that is empty, all white space, or neither.
algebra3d::Result<Encoding> detect_encoding(std::string_view head, std::size_t size, std::string_view file_name);

}  // namespace mesh_formats
