#pragma once

#include <atomic>
#include <filesystem>

#include "algebra3d/base/diagnostics.h"
#include "algebra3d/base/error.h"
#include "algebra3d/base/monitor.h"

namespace algebra3d {

class WorkMemory;  // work_memory.h

/// What a running operator may use of its surroundings, apart from its arguments.
/// The host (shell, server, PostgreSQL) owns everything that is referred to, for longer than the call.
struct Context {
  Diagnostics& diagnostics;
  /// Set by the host from another thread or a signal handler to end the statement; null: never.
  const std::atomic<bool>* cancel = nullptr;
  /// Relative file names in operators are taken from here; empty: the process's working directory.
  std::filesystem::path folder;
  /// What operators that keep many values may keep in memory; null: without a limit.
  WorkMemory* memory = nullptr;
  /// Takes how far the statement has come; null: nobody wants to know.
  const Monitor::Report* report = nullptr;

  Monitor monitor() const { return {cancel, report}; }
  bool is_cancelled() const { return monitor().is_cancelled(); }
  /// The error `interrupted` once the host has asked to stop. Long loops ask every few thousand steps.
  Status check_cancelled() const { return monitor().check(); }

  /// `name` as the file that it means here.
  std::filesystem::path resolve(const std::filesystem::path& name) const { return folder / name; }
};

}  // namespace algebra3d
