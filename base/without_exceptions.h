#pragma once

#include <exception>
#include <new>
#include <type_traits>

#include "algebra3d/base/error.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/nearest_rounding.h"

namespace algebra3d {

/// Calls `work`, which returns a Result or Status; exceptions become the error interrupted, limit_exceeded,
/// out_of_memory or internal. Numbers are rounded to nearest meanwhile. For functions of the public library.
template <typename Work>
std::invoke_result_t<const Work&> without_exceptions(const Work& work) noexcept {
  const NearestRounding rounding;
  try {
    return work();
  } catch (const Interrupted&) {
    return Monitor::interrupted();
  } catch (const MemoryLimitReached& failure) {
    return memory_error(failure);
  } catch (const std::bad_alloc&) {
    return Error(ErrorCode::out_of_memory, "out of memory");  // short enough to be stored without allocation
  } catch (const std::exception& exception) {
    return Error(ErrorCode::internal, exception.what());
  } catch (...) {
    return Error(ErrorCode::internal, "an exception that is not a std::exception");
  }
}

}  // namespace algebra3d
