#include "base/diagnostics.h"

#include <algorithm>

#include <fmt/format.h>

namespace algebra3d {
namespace {

bool is_digit(char c) {
  return '0' <= c && c <= '9';
}

/// The text with one sign for each number.
std::string without_numbers(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool goes_on = !result.empty() && result.back() == '#';
    if (!is_digit(c) && !(goes_on && c == '.')) result.push_back(c);
    if (!is_digit(c) || goes_on) continue;
    if (!result.empty() && result.back() == '-') result.pop_back();
    result.push_back('#');
  }
  return result;
}

}  // namespace

/// The entry of `text`, made if there is room for it; null if not, with the report counted.
Diagnostics::Entry* Diagnostics::entry_of(std::string&& text, Kind* kind) {
  if (const auto found = position_of_.find(text); found != position_of_.end()) return &entries_[found->second];
  if (kind != nullptr && kind->kept == kAlikeKept) {
    ++entries_[kind->last].alike;
    return nullptr;
  }
  if (entries_.size() == kTextsKept) {
    ++dropped_count_;
    return nullptr;
  }
  position_of_.emplace(text, entries_.size());
  if (kind != nullptr) *kind = {kind->kept + 1, entries_.size()};
  return &entries_.emplace_back(Entry{std::move(text), {}, 0});
}

void Diagnostics::report(std::string text, std::string place, About about) {
  const std::scoped_lock lock(mutex_);
  ++counts_[static_cast<std::size_t>(about)];
  if (about == About::undefined || about == About::unreadable)
    last_reason_ = place.empty() ? text : text + " (" + place + ")";
  auto kind = kinds_.find(without_numbers(text));
  if (kind == kinds_.end() && entries_.size() < kTextsKept) kind = kinds_.emplace(without_numbers(text), Kind()).first;
  Entry* const entry = entry_of(std::move(text), kind == kinds_.end() ? nullptr : &kind->second);
  if (entry == nullptr) return;
  ++entry->count;
  if (!place.empty() && entry->places.size() < kPlacesKept) entry->places.push_back(std::move(place));
}

void Diagnostics::tally(std::string_view pattern) {
  const std::scoped_lock lock(mutex_);
  auto count = tallies_.find(pattern);
  if (count == tallies_.end()) count = tallies_.emplace(pattern, 0).first;
  ++count->second;
}

void Diagnostics::show(std::string text) {
  const std::scoped_lock lock(mutex_);
  if (Entry* const entry = entry_of(std::move(text), nullptr)) ++entry->count;
}

std::vector<Diagnostics::Entry> Diagnostics::entries() const {
  const std::scoped_lock lock(mutex_);
  return entries_;
}

std::uint64_t Diagnostics::dropped_count() const {
  const std::scoped_lock lock(mutex_);
  return dropped_count_;
}

std::uint64_t Diagnostics::count(About about) const {
  const std::scoped_lock lock(mutex_);
  return counts_[static_cast<std::size_t>(about)];
}

std::string Diagnostics::last_reason() const {
  const std::scoped_lock lock(mutex_);
  return last_reason_;
}

bool Diagnostics::empty() const {
  const std::scoped_lock lock(mutex_);
  return entries_.empty() && tallies_.empty();
}

void Diagnostics::clear() {
  const std::scoped_lock lock(mutex_);
  entries_.clear();
  position_of_.clear();
  kinds_.clear();
  dropped_count_ = 0;
  last_reason_.clear();
  tallies_.clear();
  counts_ = {};
}

std::vector<std::string> Diagnostics::summary() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> lines;
  for (const Entry& entry : entries_) {
    std::string line = entry.text;
    if (!entry.places.empty()) line += fmt::format(" ({})", fmt::join(entry.places, "; "));
    const std::uint64_t shown = std::max<std::uint64_t>(1, entry.places.size());
    if (entry.count > shown) line += fmt::format(" and {} more", entry.count - shown);
    if (entry.alike > 0) line += fmt::format("; {} more differ only in numbers", entry.alike);
    lines.push_back(std::move(line));
  }
  for (const auto& [pattern, count] : tallies_)
    lines.push_back(fmt::format(fmt::runtime(pattern), count, count == 1 ? "" : "s"));
  if (dropped_count_ > 0) lines.push_back(fmt::format("{} further diagnostics of other kinds", dropped_count_));
  return lines;
}

}  // namespace algebra3d
