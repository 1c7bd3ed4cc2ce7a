#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/stl_content.h"

namespace mesh_formats {

inline constexpr std::size_t kBinaryHeaderBytes = 80;
/// Size of header and count, where the facets begin.
inline constexpr std::size_t kBinaryPrefixBytes = 84;
/// Size of a facet: twelve floats (normal, three corners) and two attribute bytes.
inline constexpr std::size_t kBinaryFacetBytes = 50;

/// The count in the header of a binary file of at least kBinaryPrefixBytes bytes.
std::size_t announced_facet_count(std::string_view bytes);

/// True if `size` is exactly the size that the header in `head` announces.
bool has_announced_size(std::string_view head, std::size_t size);

/// True if `size` is not that, but is exactly what the count in the header announces with its bytes swapped: so the
/// numbers of the file are big-endian.
bool is_big_endian(std::string_view head, std::size_t size);

/// Reads a binary file. The name is the header's text up to the first NUL, without a leading `solid`. If header and
/// size disagree:
/// - the count with its bytes swapped agrees with the size: all numbers are read as big-endian, with a remark;
/// - the size is a whole number of facets: the size is used, with a remark (as admesh does). Programs that stream their
///   output leave 0 or -1 in the count.
/// - more bytes than announced, not a whole number of facets: the rest is ignored, with a remark; but an announced 0
///   followed by at least a facet is an error, since both numbers are doubtful.
/// - fewer bytes than announced, not a whole number of facets, or no facet: the file is truncated, an error.
/// `wrong_count` of the result reports a contradiction. Coordinates that are NaN or infinite are an error; such normals
/// become zero, with a remark; attributes are ignored, with a remark.
algebra3d::Result<ReadStl> read_binary(std::string_view bytes, std::string_view file_name,
                                       const std::atomic<bool>* cancel);

}  // namespace mesh_formats
