#include "base/interruption_scope.h"

namespace algebra3d::detail {

constinit thread_local const InterruptionScope* interruption_scope = nullptr;

void poll_thread() {
  poll_interruption();
}

void throw_interrupted() {
  throw Interrupted();
}

}  // namespace algebra3d::detail
