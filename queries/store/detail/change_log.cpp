#include "queries/store/detail/change_log.h"

#include <algorithm>

namespace queries {

void ChangeLog::clear() {
  now_ = 0;
  tuples_.clear();
  first_new_.clear();
  gone_since_.clear();
  renamed_.clear();
}

void ChangeLog::note_tuple(std::int64_t table_number, std::int64_t tuple) {
  note_tuples(table_number, {&tuple, 1});
}

void ChangeLog::note_tuples(std::int64_t table_number, std::span<const std::int64_t> tuples) {
  if (tuples.empty()) return;
  ++now_;
  auto& noted = tuples_[table_number];
  auto place = noted.lower_bound(tuples.front());
  for (const std::int64_t tuple : tuples) {
    place = noted.try_emplace(place, tuple, Span{now_, now_});
    place->second.last = now_;
    ++place;
  }
}

void ChangeLog::note_renamed(std::int64_t table_number) {
  gone_since_.insert_or_assign(table_number, ++now_);
  renamed_.insert(table_number);
}

const ChangeLog::Span* ChangeLog::find(std::int64_t table_number, std::int64_t tuple) const {
  const auto table = tuples_.find(table_number);
  if (table == tuples_.end()) return nullptr;
  const auto found = table->second.find(tuple);
  return found == table->second.end() ? nullptr : &found->second;
}

bool ChangeLog::is_new(std::int64_t table_number, std::int64_t tuple) const {
  const auto first = first_new_.find(table_number);
  return first != first_new_.end() && tuple >= first->second;
}

std::set<std::int64_t> ChangeLog::tables() const {
  std::set<std::int64_t> tables;
  for (const auto& [table, tuples] : tuples_) tables.insert(table);
  for (const auto& [table, since] : gone_since_) tables.insert(table);
  return tables;
}

bool ChangeLog::is_gone(std::int64_t table_number, ChangeTime time) const {
  const auto gone = gone_since_.find(table_number);
  return gone != gone_since_.end() && gone->second > time;
}

bool ChangeLog::is_untouched(std::int64_t table_number, std::int64_t tuple) const {
  return find(table_number, tuple) == nullptr && !is_new(table_number, tuple);
}

ChangeLog::Whereabouts ChangeLog::where(std::int64_t table_number, std::int64_t tuple, ChangeTime time) const {
  if (renamed_.contains(table_number) && is_gone(table_number, time)) return Whereabouts::lost;
  const Span* const span = find(table_number, tuple);
  if (span == nullptr || span->last <= time) return Whereabouts::current;
  return span->first > time && !is_new(table_number, tuple) ? Whereabouts::original : Whereabouts::lost;
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

void TransactionLog::clear() {
  changed_.clear();
  first_new_.clear();
}

void TransactionLog::add(const ChangeLog& statement) {
  for (const auto& [table, tuples] : statement.tuples_)
    for (const auto& [tuple, span] : tuples) changed_[table].insert(tuple);
  for (const auto& [table, first] : statement.first_new_) {
    const auto [known, is_first] = first_new_.emplace(table, first);
    if (!is_first) known->second = std::min(known->second, first);
  }
  // To the other connection a renamed table still has its old name.
  for (const std::int64_t table : statement.renamed_) first_new_.insert_or_assign(table, 0);
}

bool TransactionLog::is_original(std::int64_t table_number, std::int64_t tuple) const {
  const auto first = first_new_.find(table_number);
  if (first != first_new_.end() && tuple >= first->second) return false;
  const auto table = changed_.find(table_number);
  return table == changed_.end() || !table->second.contains(tuple);
}

}  // namespace queries
