#include "algebra3d/kernel/arrangement/detail/stage_audit.h"

#include <algorithm>

namespace algebra3d::arrangement {

Status status_of_audit(const char* stage, const std::vector<std::string>& violations) {
  constexpr std::size_t kShown = 5;
  if (violations.empty()) return {};
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, violations.size()); ++i) text += (i == 0 ? "" : "; ") + violations[i];
  if (violations.size() > kShown) text += fmt::format("; and {} more", violations.size() - kShown);
  return Error{ErrorCode::internal, "set operation, after {}: {}", stage, text};
}

}  // namespace algebra3d::arrangement
