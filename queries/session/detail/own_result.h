#pragma once

#include <string_view>

#include "base/context.h"
#include "base/diagnostics.h"
#include "queries/streams/datum.h"

namespace queries {

/// The final result of a statement: the value of a query, or the new value of an object. In the language a file that
/// cannot be read or written yields undefined or FALSE; if that is the final result, the statement has failed without
/// an error.
class OwnResult {
 public:
  /// To be constructed before the expression is evaluated; the context outlives it.
  explicit OwnResult(const algebra3d::Context& context);
  /// The failure that the value shows: "undefined" or "FALSE"; empty if there is none.
  std::string_view failure(const Datum& value) const;

 private:
  const algebra3d::Diagnostics& diagnostics_;
  std::uint64_t unreadable_before_;
  std::uint64_t unwritten_before_;
};

}  // namespace queries
