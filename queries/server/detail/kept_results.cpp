#include "queries/server/detail/kept_results.h"

#include <algorithm>
#include <charconv>
#include <random>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/memory_limit.h"

namespace queries {
namespace {

constexpr std::chrono::minutes kLongestUnused(15);
// As long a result that was not asked yet is kept before others.
constexpr std::chrono::seconds kFresh(10);
// Bytes that each result counts at least, for its entry, and perhaps a file.
constexpr std::size_t kLeastHeld = std::size_t{64} << 10U;

// The number in an id; 0 for a text that is not an id.
std::uint64_t number_of(const std::string& id) {
  std::uint64_t number = 0;
  if (id.size() < 2 || id.front() != 'r' || id[1] == '0') return 0;
  const auto [end, error] = std::from_chars(id.data() + 1, id.data() + id.size(), number);
  return error == std::errc() && end == id.data() + id.size() ? number : 0;
}

// Ids are beyond this number: it distinguishes those of other runs of the server from numbers that were never an id.
constexpr std::uint64_t kLeastNumber = std::uint64_t{1} << 40U;

// Before the first id of this run: no other run is likely to have the same ids.
std::uint64_t random_start() {
  std::random_device device;
  return kLeastNumber + ((std::uint64_t{device()} << 16U) ^ device());
}

}  // namespace

KeptResults::KeptResults(const ServerLimits& limits) : limits_(limits), last_(random_start()) {}

KeptResults::~KeptResults() {
  drop_all();
}

std::vector<KeptResults::Results::iterator> KeptResults::those(const Choice& choice) {
  std::vector<Results::iterator> found;
  for (auto each = results_.begin(); each != results_.end(); ++each)
    if (choice(each->second)) found.push_back(each);
  return found;
}

// The one that was not used for longest; the end for none.
KeptResults::Results::iterator KeptResults::oldest(const Choice& choice) {
  const auto found = those(choice);
  const auto first = std::ranges::min_element(found, {}, [](const auto& each) { return each->second.used; });
  return first == found.end() ? results_.end() : *first;
}

// A result that was just made is one that its client is about to ask.
KeptResults::Results::iterator KeptResults::next_to_go(const Choice& choice) {
  std::map<std::string_view, std::size_t> held;  // by client
  const auto found = those(choice);
  for (const auto& each : found) {
    const Execution& execution = *each->second.execution;
    held[execution.request().client] += kLeastHeld + std::max(execution.held_bytes(), execution.copied_bytes());
  }
  const auto fresh = Execution::Clock::now() - kFresh;
  const auto first = std::ranges::min_element(found, {}, [&](const auto& each) {
    const Kept& kept = each->second;
    const bool is_awaited = !kept.is_asked && kept.used > fresh;
    const auto greed = static_cast<std::int64_t>(held[kept.execution->request().client]);
    return std::tuple(is_awaited, -greed, kept.used);
  });
  return first == found.end() ? results_.end() : *first;
}

void KeptResults::drop(Results::iterator result) {
  result->second.execution->drop();
  results_.erase(result);
}

void KeptResults::drop_what_is_too_much() {
  const std::lock_guard lock(mutex_);
  const auto longest_unused = Execution::Clock::now() - kLongestUnused;
  for (const auto& old : those([&](const Kept& kept) { return kept.used < longest_unused; })) drop(old);
  std::size_t bytes = 0;
  for (const auto& [number, kept] : results_) bytes += kept.execution->copied_bytes();
  while (bytes > limits_.copied_bytes) {
    const auto next = next_to_go([](const Kept& kept) { return kept.execution->copied_bytes() > 0; });
    if (next == results_.end()) return;
    bytes -= next->second.execution->copied_bytes();
    drop(next);
  }
}

void KeptResults::drop_oldest_reader() {
  const std::lock_guard lock(mutex_);
  if (const auto found = oldest(holds_session); found != results_.end()) drop(found);
}

void KeptResults::release_sessions() {
  const std::lock_guard lock(mutex_);
  for (const auto& each : those(holds_session))
    if (!std::exchange(each->second.was_to_leave, true)) each->second.execution->leave_database();
  const auto is_large = [](const Kept& kept) { return kept.execution->is_large(); };
  for (std::size_t count = those(is_large).size(); count > limits_.sessions_of_results; --count)
    drop(next_to_go(is_large));
}

// The thread of a result gives its memory back, soon after it was asked to.
void KeptResults::make_room() {
  constexpr std::chrono::milliseconds kStep(5), kLongest(500);
  const auto is_short = [] { return algebra3d::ProcessMemory::used() > algebra3d::ProcessMemory::limit() / 2; };
  while (is_short()) {
    {
      const std::lock_guard lock(mutex_);
      const auto next = next_to_go(is_any);
      if (next == results_.end()) return;
      drop(next);
    }
    const auto deadline = Execution::Clock::now() + kLongest;
    while (is_short() && Execution::Clock::now() < deadline) std::this_thread::sleep_for(kStep);
  }
}

void KeptResults::leave_database(Execution::Clock::time_point deadline) {
  std::vector<std::shared_ptr<Execution>> present;
  {
    const std::lock_guard lock(mutex_);
    are_to_leave_ = true;
    for (const auto& [number, kept] : results_) present.push_back(kept.execution);
  }
  for (const auto& execution : present) execution->leave_database();
  for (const auto& execution : present) execution->wait_until_left(deadline);
}

void KeptResults::may_stay() {
  const std::lock_guard lock(mutex_);
  are_to_leave_ = false;
}

std::string KeptResults::keep(std::shared_ptr<Execution> execution) {
  const std::lock_guard lock(mutex_);
  if (are_to_leave_) execution->leave_database();
  const auto is_of_same = [&client = execution->request().client](const Kept& kept) {
    return kept.execution->request().client == client;
  };
  for (std::size_t count = those(is_of_same).size(); count >= limits_.results_of_client; --count)
    drop(oldest(is_of_same));
  while (results_.size() >= limits_.results) drop(next_to_go(is_any));
  results_.emplace(++last_, Kept{std::move(execution), Execution::Clock::now()});
  return fmt::format("r{}", last_);
}

Reply<std::shared_ptr<Execution>> KeptResults::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t number = number_of(id);
  const auto found = results_.find(number);
  if (found != results_.end()) {
    found->second.used = Execution::Clock::now();
    found->second.is_asked = true;
    return found->second.execution;
  }
  if (number > kLeastNumber)
    return Refusal{410, "gone", fmt::format("the result '{}' was dropped, or is of another run of the server", id),
                   "Run the statement again."};
  return Refusal::not_found(fmt::format("there is no result '{}'", id));
}

bool KeptResults::drop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = results_.find(number_of(id));
  if (found == results_.end()) return false;
  drop(found);
  return true;
}

void KeptResults::drop_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, kept] : results_) kept.execution->drop();
  results_.clear();
}

}  // namespace queries
