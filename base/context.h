#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "base/read_guard.h"
#include "base/working_folder.h"

namespace algebra3d {

class FailedCalls;  // registry/failed_calls.h
class WorkMemory;   // work_memory.h

/// The environment of a running operator. The host (shell, server, PostgreSQL) owns all objects that it refers to; they
/// outlive the call.
struct Context {
  Diagnostics& diagnostics;
  /// Set by the host from another thread or a signal handler to end the statement; null: never.
  const std::atomic<bool>* cancel = nullptr;
  /// Folder of relative file names in operators; by default the process's working directory.
  WorkingFolder folder;
  /// Memory limit of operators that keep many values; null: no limit.
  WorkMemory* memory = nullptr;
  /// Receives the progress of the statement; may be null.
  const Monitor::Report* report = nullptr;
  /// Takes the calls of operators that end with the error internal; null: nobody wants to repeat them.
  FailedCalls* failed_calls = nullptr;
  /// Asked before a file is read; null: all files that the folder allows may be read.
  ReadGuard* reads = nullptr;
  /// Why what is evaluated must change nothing, neither files nor stored relations, as a clause for messages ("it is
  /// evaluated again at every restore"); empty: it may. The text outlives the context.
  std::string_view unchanging = {};

  /// A copy of these surroundings with other diagnostics; calls that fail are not kept.
  Context with(Diagnostics& other) const { return {other, cancel, folder, memory, report, nullptr, reads, unchanging}; }

  Monitor monitor() const { return {cancel, report}; }
  bool is_cancelled() const { return monitor().is_cancelled(); }
  /// The error `interrupted` if the host has cancelled the statement. Long loops call it every few thousand steps.
  Status check_cancelled() const { return monitor().check(); }

  /// Error wrong_usage where nothing must be changed. `doing` begins the message: "exportSTL writes a file".
  Status check_changing(std::string_view doing) const {
    if (unchanging.empty()) return {};
    return Error{ErrorCode::wrong_usage, "{}, which must not happen here: {}", doing, unchanging};
  }

  /// The file that `name` means, for reading. Errors: permission_denied.
  Result<std::filesystem::path> resolve(const std::filesystem::path& name) const {
    A3D_ASSIGN(std::filesystem::path file, folder.path_of(name));
    if (reads != nullptr) A3D_TRY(reads->check(file));
    return file;
  }
  /// The file that `name` means, for writing, which the host can cancel. Errors: permission_denied, also where the host
  /// does not allow it; wrong_usage where nothing must be changed.
  Result<OutputPath> resolve_output(const std::filesystem::path& name) const {
    A3D_TRY(check_changing("the file '" + name.string() + "' would be written"));
    A3D_ASSIGN(const OutputPath path, folder.output_path_of(name));
    return path.with_cancel(cancel);
  }
};

}  // namespace algebra3d
