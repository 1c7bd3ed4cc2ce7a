#include "queries/server/detail/kept_results.h"

#include <algorithm>
#include <charconv>
#include <random>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "base/memory_limit.h"

namespace queries {
namespace {

constexpr std::chrono::minutes kLongestUnused(15);

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

KeptResults::KeptResults(std::size_t most) : most_(most), last_(random_start()) {}

KeptResults::~KeptResults() {
  drop_all();
}

std::map<std::uint64_t, KeptResults::Kept>::iterator KeptResults::oldest() {
  return std::ranges::min_element(results_, {}, [](const auto& result) { return result.second.used; });
}

void KeptResults::drop(std::map<std::uint64_t, Kept>::iterator result) {
  result->second.execution->drop();
  results_.erase(result);
}

void KeptResults::drop_what_is_old() {
  const std::lock_guard lock(mutex_);
  const auto longest_unused = Execution::Clock::now() - kLongestUnused;
  while (!results_.empty() && oldest()->second.used < longest_unused) drop(oldest());
}

void KeptResults::drop_oldest() {
  const std::lock_guard lock(mutex_);
  if (!results_.empty()) drop(oldest());
}

// The thread of a result gives its memory back, soon after it was asked to.
void KeptResults::make_room() {
  constexpr std::chrono::milliseconds kStep(5), kLongest(500);
  const auto is_short = [] { return algebra3d::ProcessMemory::used() > algebra3d::ProcessMemory::limit() / 2; };
  while (is_short()) {
    {
      const std::lock_guard lock(mutex_);
      if (results_.empty()) return;
      drop(oldest());
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
  while (results_.size() >= most_) drop(oldest());
  results_.emplace(++last_, Kept{std::move(execution), Execution::Clock::now()});
  return fmt::format("r{}", last_);
}

Reply<std::shared_ptr<Execution>> KeptResults::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t number = number_of(id);
  const auto found = results_.find(number);
  if (found != results_.end()) {
    found->second.used = Execution::Clock::now();
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
