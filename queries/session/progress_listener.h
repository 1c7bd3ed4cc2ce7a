#pragma once

#include <string>

namespace queries {

/// What a presenter may be as well: told how far a long statement has come. Sessions ask their presenter whether it is
/// one, so that hosts without a place for such a line need nothing.
class ProgressListener {
 public:
  virtual ~ProgressListener() = default;
  ProgressListener() = default;
  ProgressListener(const ProgressListener&) = delete;
  ProgressListener& operator=(const ProgressListener&) = delete;
  /// `how_far` is for people: "42 % (Parts)". Comes from the thread of the statement, many times a second.
  virtual void advance(const std::string& how_far) = 0;
};

}  // namespace queries
