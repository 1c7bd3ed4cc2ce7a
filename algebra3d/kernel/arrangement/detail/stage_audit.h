#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/base/error.h"

namespace algebra3d::arrangement {

/// The violated invariants that an audit finds, one sentence each.
class Violations {
 public:
  /// Adds the sentence if the invariant does not hold. True if it holds.
  template <typename... Args>
  bool expect(bool holds, fmt::format_string<Args...> sentence, Args&&... args) {
    if (!holds) found_.push_back(fmt::format(sentence, std::forward<Args>(args)...));
    return holds;
  }
  std::vector<std::string> take() { return std::move(found_); }

 private:
  std::vector<std::string> found_;
};

/// Whether each stage is audited when it is done: in builds with assertions.
#ifdef NDEBUG
inline constexpr bool kAuditsStages = false;
#else
inline constexpr bool kAuditsStages = true;
#endif

/// The error internal with the first violations, if there are any.
Status status_of_audit(const char* stage, const std::vector<std::string>& violations);

/// Runs the audit, a function that gives violations, in builds that audit stages. The error names the stage.
template <typename Audit>
Status check_stage([[maybe_unused]] const char* stage, [[maybe_unused]] const Audit& audit) {
  if constexpr (kAuditsStages)
    return status_of_audit(stage, audit());
  else
    return {};
}

}  // namespace algebra3d::arrangement
