#pragma once

#include <string>
#include <utility>
#include <vector>

#include "queries/server/detail/http.h"

namespace queries {

/// The headers that every answer has: nobody shows our pages in theirs, they run nothing that is not ours, and only
/// whole answers are given.
const std::vector<std::pair<std::string, std::string>>& common_headers();

/// The bytes of the refusal of a request that the HTTP library has not seen, without its body if `is_without_body`. The
/// connection ends with it. Statuses: those of RequestHead, and 408.
std::string answer_text(const HttpAnswer& answer, bool is_without_body);

}  // namespace queries
