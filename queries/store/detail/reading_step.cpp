#include "queries/store/detail/reading_step.h"

#include "base/interruption_scope.h"

namespace queries {

thread_local bool ReadingStep::reads_ = false;

bool ReadingStep::is_interrupted() {
  return reads_ && algebra3d::is_interrupted();
}

}  // namespace queries
