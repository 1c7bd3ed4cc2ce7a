#pragma once

#include <string>
#include <utility>
#include <vector>

#include "queries/server/detail/http.h"

namespace queries {

using Headers = std::vector<std::pair<std::string, std::string>>;

/// The headers that every answer has: pages run nothing that is not ours, nobody but pages of the origins `embedders`
/// shows them in theirs, and only whole answers are given.
Headers common_headers(const std::vector<std::string>& embedders);

/// The bytes of the refusal of a request that the HTTP library has not seen, without its body if `is_without_body`. The
/// connection ends with it. `common`: headers that every answer has. Statuses: those of RequestHead, and 408.
std::string answer_text(const HttpAnswer& answer, const Headers& common, bool is_without_body);

}  // namespace queries
