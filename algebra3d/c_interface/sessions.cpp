#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include <fmt/format.h>

#include "algebra3d/c_interface/detail/functions.h"
#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/kernel/exact/number_memory.h"
#include "algebra3d/kernel/exact/rational_text.h"
#include "algebra3d/version.h"

namespace {

using algebra3d::MemoryUser;
using algebra3d::ProcessMemory;

/// Copies a text into an array, cut at the end of a character where it is too long.
template <std::size_t kSize>
void copy_text(std::string_view text, char (&to)[kSize]) noexcept {
  std::size_t size = std::min(text.size(), kSize - 1);
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; };
  if (size < text.size())
    while (size > 0 && continues(text[size])) --size;
  std::memcpy(to, text.data(), size);
  to[size] = '\0';
}

/// The owner of an a3d_bytes.
struct HeldBytes : algebra3d::c_interface::Held {
  HeldBytes(const a3d_session& session, std::string its_content) : Held(session), content(std::move(its_content)) {}

  std::string content;
};

std::size_t memory_limit(std::uint64_t bytes) {
  return bytes == 0 || bytes > MemoryUser::kNoLimit ? MemoryUser::kNoLimit : static_cast<std::size_t>(bytes);
}

}  // namespace

a3d_status a3d_session::fail(const algebra3d::Error& failure, bool is_of_memory) noexcept {
  const bool is_memory_limit = is_of_memory && failure.code == algebra3d::ErrorCode::limit_exceeded;
  const algebra3d::ErrorDescription& kind =
      describe(is_memory_limit ? algebra3d::ErrorCode::out_of_memory : failure.code);
  copy_text(kind.sql_state, error.sql_state);
  copy_text(kind.name, error.name);
  // Literals. That of the library is about its language.
  error.remedy = failure.code == algebra3d::ErrorCode::type_error
                     ? "Compare the types with those of the parameters of the function."
                     : kind.remedy.data();
  error.place[0] = '\0';
  try {
    if (failure.place.is_known())
      copy_text(fmt::format("line {}, column {}", failure.place.line, failure.place.column), error.place);
    copy_text(algebra3d::c_interface::in_host_names(failure.text()), error.message);
  } catch (...) {
    copy_text(failure.message, error.message);
  }
  return A3D_ERROR;
}

void a3d_guard_numbers(void) {
  algebra3d::count_number_memory();
}

void a3d_limit_digits(size_t digits) {
  algebra3d::set_max_digits_read(digits);
}

uint32_t a3d_interface(void) {
  return A3D_INTERFACE;
}

const char* a3d_version(void) {
  return algebra3d::kVersion;
}

a3d_session* a3d_open(const a3d_options* options) {
  try {
    algebra3d::c_interface::operators();
    auto session = std::make_unique<a3d_session>();
    if (options != nullptr) {
      session->memory->set_limit(memory_limit(options->memory));
      session->threads = options->threads;
      if (options->folder != nullptr) session->folder = options->folder;
    }
    return session.release();
  } catch (...) {
    return nullptr;
  }
}

void a3d_close(a3d_session* session) {
  delete session;
}

void a3d_cancel(a3d_session* session) {
  session->is_cancelled.store(true, std::memory_order_relaxed);
}

void a3d_resume(a3d_session* session) {
  session->is_cancelled.store(false, std::memory_order_relaxed);
}

void a3d_set_memory(a3d_session* session, uint64_t bytes) {
  session->memory->set_limit(memory_limit(bytes));
}

void a3d_set_threads(a3d_session* session, uint32_t threads) {
  session->threads = threads;
}

uint64_t a3d_memory_used(const a3d_session* session) {
  return session->memory->used();
}

void a3d_set_memory_used(a3d_session* session, uint64_t bytes) {
  session->memory->set_used(static_cast<std::size_t>(bytes));
}

int a3d_counts_memory(void) {
  return ProcessMemory::used() > 0 ? 1 : 0;
}

const a3d_error* a3d_last_error(const a3d_session* session) {
  return &session->error;
}

size_t a3d_notice_count(a3d_session* session) {
  try {
    session->notices = session->diagnostics.summary();
    for (std::string& notice : session->notices) notice = algebra3d::c_interface::in_host_names(notice);
  } catch (...) {
    session->notices.clear();
  }
  return session->notices.size();
}

const char* a3d_notice(a3d_session* session, size_t number) {
  return number < session->notices.size() ? session->notices[number].c_str() : nullptr;
}

const char* a3d_reason(a3d_session* session) {
  try {
    session->reason = algebra3d::c_interface::in_host_names(session->diagnostics.last_reason());
  } catch (...) {
    session->reason.clear();
  }
  return session->reason.c_str();
}

void a3d_clear_notices(a3d_session* session) {
  session->notices.clear();
  session->diagnostics.clear();
}

void a3d_free_bytes(a3d_bytes* bytes) {
  algebra3d::c_interface::give_up(static_cast<HeldBytes*>(bytes->owner));
  *bytes = {};
}

namespace algebra3d::c_interface {

void give(const a3d_session& session, std::string bytes, a3d_bytes* result) {
  auto* const owner = new HeldBytes(session, std::move(bytes));
  *result = {owner->content.data(), owner->content.size(), owner};
}

}  // namespace algebra3d::c_interface
