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

/// False for answers that end with their head.
bool has_body(const HttpAnswer& answer);

/// How an answer is sent.
struct AnswerForm {
  bool stays_open = false;  ///< the client may send another request on the connection
  bool in_chunks = false;   ///< a streamed body comes in chunks, rather than until the connection ends
};

/// The status line and the headers of an answer (RFC 9112), with the empty line behind them.
std::string answer_head(const HttpAnswer& answer, const Headers& common, const AnswerForm& form);

}  // namespace queries
