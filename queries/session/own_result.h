#pragma once

#include <string_view>

#include "algebra3d/base/context.h"
#include "queries/streams/datum.h"

namespace queries {

/// The result that is a statement's own: the value of a query, or the one that an object gets. The language has a file
/// that cannot be read or written give undefined or FALSE; where that is the result, the statement has failed though
/// there is no error.
class OwnResult {
 public:
  /// Made before the expression is evaluated; the context outlives it.
  explicit OwnResult(const algebra3d::Context& context);
  /// How the value, made since, tells of a failure: "undefined", "FALSE", or empty.
  std::string_view failure(const Datum& value) const;

 private:
  const algebra3d::Diagnostics& diagnostics_;
  std::uint64_t unreadable_before_;
  std::uint64_t unwritten_before_;
};

}  // namespace queries
