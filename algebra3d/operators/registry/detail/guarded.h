#pragma once

#include <exception>
#include <new>
#include <type_traits>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/operator.h"
#include "base/interruption_scope.h"

namespace algebra3d {

/// The result of `work`, a Result or a Status of the operator. An exception becomes the error internal, so that the
/// call can be reported with its arguments; exhausted memory is left to the host.
template <typename Work>
std::invoke_result_t<const Work&> guarded(const Operator& op, const Work& work) {
  try {
    return work();
  } catch (const Interrupted&) {
    return Monitor::interrupted();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    return Error(ErrorCode::internal, "unexpected exception: {}", exception.what()).about(op.name);
  }
}

}  // namespace algebra3d
