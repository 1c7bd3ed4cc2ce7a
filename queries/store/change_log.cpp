#include "queries/store/change_log.h"

namespace queries {

void ChangeLog::clear() {
  now_ = 0;
  tuples_.clear();
  dropped_.clear();
  created_.clear();
}

void ChangeLog::note_tuple(std::int64_t table_number, std::int64_t tuple) {
  ++now_;
  const auto [place, is_first] = tuples_[table_number].try_emplace(tuple, Span{now_, now_});
  if (!is_first) place->second.last = now_;
}

void ChangeLog::note_dropped(std::int64_t table_number) {
  ++now_;
  dropped_.insert(table_number);
}

ChangeLog::Whereabouts ChangeLog::where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const {
  const Span* span = nullptr;
  if (const auto table = tuples_.find(table_number); table != tuples_.end())
    if (const auto found = table->second.find(tuple); found != table->second.end()) span = &found->second;
  const bool is_changed = span != nullptr && span->last > time;
  if (!is_changed && !is_dropped(table_number)) return Whereabouts::current;
  const bool was_original = (span == nullptr || span->first > time) && !created_.contains(table_number);
  return was_original ? Whereabouts::original : Whereabouts::lost;
}

std::vector<std::int64_t> ChangeLog::changed_tuples(std::int64_t table_number, std::int64_t after, std::int64_t last,
                                                    ChangeTime time) const {
  std::vector<std::int64_t> result;
  const auto table = tuples_.find(table_number);
  if (table == tuples_.end()) return result;
  for (auto span = table->second.upper_bound(after); span != table->second.end() && span->first <= last; ++span)
    if (span->second.last > time) result.push_back(span->first);
  return result;
}

}  // namespace queries
