#pragma once

#include <atomic>
#include <filesystem>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/stl_format.h"

namespace stl {

/// Reads the bytes of an STL file, ASCII or binary; `file_name` is used in messages only.
///
/// What is accepted beyond the letter of the format is listed at `read_ascii` and `read_binary`; each such file gives a
/// remark. Facets are neither welded, nor reordered, nor checked beyond finiteness.
/// Exactness: binary coordinates are floats, passed on as they are; ASCII coordinates are the doubles nearest to their
/// digits (not floats: a file with more digits keeps them, and one beyond the range of float is still read).
/// Errors: file_format, naming the byte (for ASCII also the line), what was found and what was expected;
/// interrupted, if `*cancel` was set (asked every 65536 facets).
/// Cost: linear, one pass; memory for the soup alone, bounded by the size of the file, whatever its header announces.
algebra3d::Result<ReadStl> read_stl(std::string_view bytes, std::string_view file_name,
                                    const std::atomic<bool>* cancel = nullptr);

/// `read_stl` of the file at `path`, as it is while nobody changes it (FileContent).
/// Errors: besides those of read_stl, those of InputFile and FileContent (file_missing, io_error with the system's
/// reason, ...).
algebra3d::Result<ReadStl> read_stl_file(const std::filesystem::path& path, const std::atomic<bool>* cancel = nullptr);

/// The format of a file, by its size and content; nothing is tried and taken back.
/// - Binary, if the size is exactly that of the announced facets, whatever the header says: a text of that size would
///   have to be over 7 GB long, since four characters read as a count give at least 151 million.
/// - Else ASCII, if the first 1024 bytes are text (no control characters but white space), or begin with `solid` and
///   hold `facet` and `vertex` (so that a stray control character is reported as such).
/// - Else binary, if there are the 84 bytes of header and count.
/// Errors: file_format for a file that is empty, all white space, or neither.
algebra3d::Result<Format> detect_format(std::string_view bytes, std::string_view file_name);

}  // namespace stl
