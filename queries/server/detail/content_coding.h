#pragma once

#include <string_view>

namespace queries {

/// Whether a client takes content compressed by gzip, by its header `Accept-Encoding` (RFC 9110, section 12.5.3). A
/// client without the header is sent nothing that it did not ask for.
bool takes_gzip(std::string_view accept_encoding);

}  // namespace queries
