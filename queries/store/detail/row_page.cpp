#include "queries/store/detail/row_page.h"

#include <algorithm>

namespace queries {
namespace {

constexpr std::size_t kPageRows = 256;
/// A page ends early when texts and small values fill it.
constexpr std::size_t kPageBytes = std::size_t{4} << 20;

}  // namespace

void RowPage::clear(TupleId after) {
  // One long text must not keep its memory until the scan ends.
  if (bytes_.capacity() > 2 * kPageBytes) bytes_ = std::string();
  bytes_.clear();
  rows_.clear();
  last_ = after;
  status_ = {};
}

bool RowPage::is_full() const {
  return rows_.size() >= kPageRows || bytes_.size() >= kPageBytes;
}

bool RowPage::take(std::span<Cell> row) {
  const TupleId id = row[0].integer;
  const std::size_t begin = bytes_.size();
  if (!append_proved(row, bytes_)) {
    status_ = damaged_row(*layout_, id);
  } else if (id <= last_) {
    // A damaged tree could lead round in circles.
    status_ = Error{ErrorCode::database_corrupt, "{}: the tuples are not in order", layout_->relation()};
  } else {
    rows_.push_back({id, as_unsigned(row[1].integer), begin});
    last_ = id;
  }
  return !status_.ok() || is_full();
}

Status RowPage::add(std::span<Cell> row) {
  const TupleId id = row[0].integer;
  const std::size_t begin = bytes_.size();
  if (!append_proved(row, bytes_)) return damaged_row(*layout_, id);
  const auto behind = std::ranges::upper_bound(rows_, id, {}, &Row::id);
  rows_.insert(behind, {id, as_unsigned(row[1].integer), begin});
  return {};
}

void RowPage::erase(const std::vector<TupleId>& ids) {
  std::erase_if(rows_, [&](const Row& row) { return std::ranges::binary_search(ids, row.id); });
}

}  // namespace queries
