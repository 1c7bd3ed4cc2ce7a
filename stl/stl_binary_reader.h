#pragma once

#include <atomic>
#include <cstddef>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/stl_format.h"

namespace stl {

inline constexpr std::size_t kBinaryHeaderBytes = 80;
/// Header and count: where the facets begin.
inline constexpr std::size_t kBinaryPrefixBytes = 84;
/// Twelve floats (normal, three corners) and two attribute bytes.
inline constexpr std::size_t kBinaryFacetBytes = 50;

/// The count in the header of a binary file of at least kBinaryPrefixBytes bytes.
std::size_t announced_facet_count(std::string_view bytes);

/// Reads a binary file. The name is the header's text up to the first NUL, without a leading `solid`.
/// Where header and size disagree:
/// - size is a whole number of facets: the size is believed, with a remark (as admesh does). Programs that stream their
///   output leave 0 or -1 in the count.
/// - more bytes than announced, no whole number of facets: the rest is ignored, with a remark; but an announced 0
///   followed by a facet or more is an error, since neither number can be believed.
/// - fewer bytes than announced, no whole number of facets, or none at all: the file is truncated, an error.
/// What is read although the two numbers contradict each other has that in `wrong_count`.
/// Coordinates that are NaN or infinite are an error; such normals become zero, with a remark; attributes are ignored,
/// with a remark.
algebra3d::Result<ReadStl> read_binary(std::string_view bytes, std::string_view file_name,
                                       const std::atomic<bool>* cancel);

}  // namespace stl
