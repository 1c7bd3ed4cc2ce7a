#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "algebra3d/operators/registry/registry.h"
#include "queries/server/detail/execution.h"
#include "queries/server/detail/kept_results.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// Whether a text can name a statement or a client: at most 64 letters, digits, `-` and `_`.
bool is_id(std::string_view text);
inline constexpr std::string_view kIdForm = "at most 64 letters, digits, '-' and '_'";

/// Reads the body of POST /api/query. Cells that are parameters are loaded from their results. Refusals: bad_request
/// with the member that is wrong, those of the results, errors of parameters.
Reply<StatementRequest> read_query_request(const std::string& body, const algebra3d::Registry& registry,
                                           KeptResults& results);

/// The body of a request as JSON. Refusals: bad_request for a body that is not JSON or is nested too deeply.
Reply<nlohmann::json> parse_body(const std::string& body);

/// The refusal for an error of `cell_of`, or of another question to a result.
Refusal refusal_of_cell(const algebra3d::Error& error);

/// The value of a cell, loaded. Errors: those of the store; unknown_name for a column, invalid_value for a row that is
/// not there.
Result<Value> cell_of(Execution& result, std::size_t row, const std::string& column,
                      const Connection* connection = nullptr);

}  // namespace queries
