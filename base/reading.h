#pragma once

#include <atomic>
#include <optional>
#include <string_view>
#include <utility>

#include "algebra3d/base/error.h"
#include "base/file_error.h"

namespace mesh_formats {

/// The common base of the readers: the bytes of the file, its name for messages, the cancel flag, and the error, if
/// any. Functions of readers set the error and return false: a Result per token would cost more than the token.
class Reading {
 protected:
  Reading(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel)
      : bytes_(bytes), file_name_(file_name), cancel_(cancel) {}

  bool fail(algebra3d::Error error) {
    error_ = std::move(error);
    return false;
  }
  /// True if the host has cancelled reading; sets the error.
  bool is_cancelled() {
    if (cancel_ == nullptr || !cancel_->load(std::memory_order_relaxed)) return false;
    error_ = algebra3d::interrupted_reading(file_name_);
    return true;
  }
  bool has_failed() const { return error_.has_value(); }
  algebra3d::Error take_error() { return *std::move(error_); }

  std::string_view bytes_;
  std::string_view file_name_;

 private:
  const std::atomic<bool>* cancel_;
  std::optional<algebra3d::Error> error_;
};

}  // namespace mesh_formats
