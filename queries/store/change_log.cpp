#include "queries/store/change_log.h"

namespace queries {

void ChangeLog::clear() {
  now_ = 0;
  tuples_.clear();
  dropped_.clear();
}

void ChangeLog::note_tuple(std::int64_t table_number, std::int64_t tuple) {
  ++now_;
  const auto [place, is_first] = tuples_[table_number].try_emplace(tuple, Span{now_, now_});
  if (!is_first) place->second.last = now_;
}

void ChangeLog::note_dropped(std::int64_t table_number) {
  dropped_.emplace(table_number, ++now_);
}

ChangeLog::Whereabouts ChangeLog::where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const {
  bool is_changed = false;
  const auto table = tuples_.find(table_number);
  if (table != tuples_.end()) {
    const auto span = table->second.find(tuple);
    if (span != table->second.end() && span->second.last > time) {
      if (span->second.first <= time) return Whereabouts::lost;
      is_changed = true;
    }
    // A tuple that was changed before `time` cannot be found any more once its table is gone.
    if (span != table->second.end() && span->second.last <= time && is_dropped(table_number)) return Whereabouts::lost;
  }
  return is_changed || is_dropped(table_number) ? Whereabouts::original : Whereabouts::current;
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
