#include "algebra3d/base/diagnostics.h"

#include <algorithm>

#include <fmt/format.h>

namespace algebra3d {

void Diagnostics::report(std::string text, std::string place) {
  const std::scoped_lock lock(mutex_);
  auto entry = std::ranges::find(entries_, text, &Entry::text);
  if (entry == entries_.end()) {
    if (entries_.size() == kTextsKept) {
      ++dropped_count_;
      return;
    }
    entry = entries_.insert(entries_.end(), Entry{std::move(text), {}, 0});
  }
  ++entry->count;
  if (!place.empty() && entry->places.size() < kPlacesKept) entry->places.push_back(std::move(place));
}

std::vector<Diagnostics::Entry> Diagnostics::entries() const {
  const std::scoped_lock lock(mutex_);
  return entries_;
}

std::uint64_t Diagnostics::dropped_count() const {
  const std::scoped_lock lock(mutex_);
  return dropped_count_;
}

bool Diagnostics::empty() const {
  const std::scoped_lock lock(mutex_);
  return entries_.empty();
}

void Diagnostics::clear() {
  const std::scoped_lock lock(mutex_);
  entries_.clear();
  dropped_count_ = 0;
}

std::vector<std::string> Diagnostics::summary() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::string> lines;
  for (const Entry& entry : entries_) {
    std::string line = entry.text;
    if (!entry.places.empty()) line += fmt::format(" ({})", fmt::join(entry.places, "; "));
    const std::uint64_t shown = std::max<std::uint64_t>(1, entry.places.size());
    if (entry.count > shown) line += fmt::format(" and {} more", entry.count - shown);
    lines.push_back(std::move(line));
  }
  if (dropped_count_ > 0) lines.push_back(fmt::format("{} further diagnostics of other kinds", dropped_count_));
  return lines;
}

}  // namespace algebra3d
