#pragma once

#include <string>
#include <string_view>

namespace queries {

/// `name` without what a file system may not take, or takes for a folder: such characters become `_`. At most 120 bytes
/// of it, and no points or blanks at its ends.
std::string safe_file_name(std::string_view name);

/// The value of the header `Content-Disposition` (RFC 6266) with which a client keeps an answer as a file of this name.
/// Characters beyond ASCII are in `filename*` (RFC 8187), and `_` in `filename`, for old clients.
std::string attachment(std::string_view file_name);

}  // namespace queries
