#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/c.h"
#include "algebra3d/values/types/value.h"
#include "base/context.h"
#include "base/diagnostics.h"
#include "base/memory_limit.h"
#include "base/scheduler.h"
#include "base/without_exceptions.h"

struct a3d_session {
  /// Also of what the session made, which may live longer. How the limit is raised is said by the host.
  std::shared_ptr<algebra3d::MemoryUser> memory =
      std::make_shared<algebra3d::MemoryUser>(algebra3d::MemoryUser::kNoLimit, "");
  std::atomic<bool> is_cancelled = false;
  std::uint32_t threads = 1;
  std::filesystem::path folder;
  algebra3d::Diagnostics diagnostics;
  std::vector<std::string> notices;
  std::string reason;
  a3d_error error = {};

  algebra3d::Context context() { return {diagnostics, &is_cancelled, algebra3d::WorkingFolder(folder)}; }
  /// `is_of_memory`: the failure is that of the limit of memory.
  a3d_status fail(const algebra3d::Error& failure, bool is_of_memory) noexcept;
};

namespace algebra3d::c_interface {

/// An object that C code holds and gives up without a session: its memory counts for the session that made it.
struct Held {
  explicit Held(const a3d_session& session) : memory(session.memory) {}

  std::shared_ptr<MemoryUser> memory;
};

/// Deletes what C code held, which may be null.
template <std::derived_from<Held> T>
void give_up(T* held) noexcept {
  if (held == nullptr) return;
  const std::shared_ptr<MemoryUser> memory = held->memory;
  const MemoryUserScope scope(memory.get());
  delete held;
}

}  // namespace algebra3d::c_interface

/// Counted by its owners.
struct a3d_value : algebra3d::c_interface::Held {
  a3d_value(const a3d_session& session, algebra3d::Value its_content)
      : Held(session), content(std::move(its_content)) {}

  const algebra3d::Value content;
  std::atomic<std::size_t> owners = 1;
};

namespace algebra3d::c_interface {

/// Does the work of a session: `work(context)` returns a Status, or a Result, whose value `take` gets. Nothing is
/// thrown; an error becomes that of the session.
template <typename Work, typename Take>
a3d_status done(a3d_session* session, const Work& work, const Take& take) noexcept {
  const MemoryUserScope memory(session->memory.get());
  const std::size_t refusals = session->memory->refusals();
  using Returned = std::invoke_result_t<const Work&, Context&>;
  const Status status = without_exceptions([&]() -> Status {
    const InterruptionScope interruption(&session->is_cancelled);
    std::optional<Returned> returned;
    const auto call = [&] {
      Context context = session->context();
      returned.emplace(work(context));
    };
    if (session->threads == 0)
      call();
    else
      with_threads(static_cast<int>(session->threads), call);
    if (!returned->ok()) return std::move(*returned).error();
    if constexpr (!std::is_same_v<Returned, Status>) take(std::move(*returned).value());
    return {};
  });
  return status.ok() ? A3D_OK : session->fail(status.error(), session->memory->refusals() > refusals);
}

template <typename Work>
a3d_status done(a3d_session* session, const Work& work) noexcept {
  return done(session, work, [](const auto&) {});
}

/// For work that returns a Value.
template <typename Work>
a3d_status made(a3d_session* session, a3d_value** result, const Work& work) noexcept {
  // NOLINTNEXTLINE(bugprone-unhandled-exception-at-new): `done` handles it.
  return done(session, work, [&](Value value) { *result = new a3d_value(*session, std::move(value)); });
}

/// The type of that name. Errors: unknown_name.
Result<const Type*> type_named(std::string_view name);

/// The bytes for C code; `*result` owns them.
void give(const a3d_session& session, std::string bytes, a3d_bytes* result);

}  // namespace algebra3d::c_interface
