#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "queries/server/detail/http.h"

namespace queries {

/// Whether a client prefers content compressed by gzip, by its header `Accept-Encoding` (RFC 9110, section 12.5.3):
/// gzip has a weight above 0 that is not below that of `identity`. A client without the header is sent nothing that it
/// did not ask for; a weight that cannot be read is 0.
bool takes_gzip(std::string_view accept_encoding);

/// The bytes compressed by gzip (RFC 1952), quickly rather than to the last byte. Throws std::bad_alloc.
std::string gzip(std::string_view bytes);
/// The content of bytes compressed by gzip; nothing if they are damaged. Throws std::bad_alloc.
std::optional<std::string> gunzip(std::string_view bytes);

/// Gives an answer the coding that its client takes: JSON above 1 kB, and what is marked as compressible, is
/// compressed; pages, which lie compressed in the program, are unpacked for clients that do not take gzip. Streams stay
/// as they are.
void encode(HttpAnswer& answer, std::string_view accept_encoding);

}  // namespace queries
