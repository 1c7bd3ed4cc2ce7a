#include "algebra3d/database/rows.h"

#include <algorithm>
#include <new>
#include <ostream>

#include <fmt/format.h>

#include "algebra3d/operators/registry/registry.h"
#include "base/propagate.h"
#include "queries/database/detail/engine.h"
#include "queries/database/detail/value_content.h"

namespace algebra3d::database {
namespace {

const detail::ColumnsPtr& no_columns() {
  static const detail::ColumnsPtr none = std::make_shared<const std::vector<Column>>();
  return none;
}

}  // namespace

Row::Row(std::shared_ptr<const std::vector<Column>> columns, std::vector<Value> values)
    : columns_(std::move(columns)), values_(std::make_shared<const std::vector<Value>>(std::move(values))) {}

Value Row::operator[](std::string_view name) const {
  const auto found = std::ranges::find(*columns_, name, &Column::name);
  if (found != columns_->end()) return (*values_)[static_cast<std::size_t>(found - columns_->begin())];
  std::vector<std::string> names;
  for (const Column& column : *columns_) names.push_back(column.name);
  const std::string nearest = nearest_name(name, names);
  return detail::ValueAccess::missing(
      fmt::format("there is no column '{}'{}", name, nearest.empty() ? "" : ", did you mean '" + nearest + "'?"));
}

std::string Row::text() const {
  std::string text = "(";
  for (const Value& value : *values_) text += (text.size() > 1 ? " " : "") + value.text();
  return text + ")";
}

std::size_t Row::hash() const {
  std::size_t hash = values_->size();
  for (const Value& value : *values_) hash = hash * 31 + value.hash();
  return hash;
}

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << row.text();
}

Rows::Rows(std::shared_ptr<detail::Engine> engine, std::shared_ptr<detail::Handover> handover)
    : engine_(std::move(engine)), handover_(std::move(handover)), columns_(no_columns()) {}

Rows::~Rows() {
  close();
}

// The object that was moved from keeps its columns, and has no more rows.
Rows::Rows(Rows&& other) noexcept
    : engine_(std::move(other.engine_)),
      handover_(std::move(other.handover_)),
      columns_(other.columns_),  // NOLINT(performance-move-constructor-init)
      rows_(std::exchange(other.rows_, {})),
      next_(std::exchange(other.next_, 0)),
      outcome_(std::exchange(other.outcome_, {})) {}

Rows& Rows::operator=(Rows&& other) noexcept {
  if (this == &other) return *this;
  close();
  engine_ = std::move(other.engine_);
  handover_ = std::move(other.handover_);
  columns_ = other.columns_;
  rows_ = std::exchange(other.rows_, {});
  next_ = std::exchange(other.next_, 0);
  outcome_ = std::exchange(other.outcome_, {});
  return *this;
}

void Rows::close() {
  rows_.clear();
  next_ = 0;
  if (engine_ == nullptr) return;
  engine_->cancel();
  handover_->abandon();
  (void)finish();  // it was interrupted, and that was wanted
}

// The statement is over.
Status Rows::finish() {
  engine_->release(std::move(handover_->report()));
  Status status = std::move(handover_->status());
  engine_.reset();
  handover_.reset();
  return status;
}

Status Rows::wait_for_columns() {
  auto columns = handover_->wait_for_columns(engine_->progress());
  if (columns == nullptr) return outcome_ = finish();
  columns_ = std::move(columns);
  return {};
}

Status Rows::fetch() {
  if (engine_ == nullptr) return outcome_;
  next_ = 0;
  rows_.clear();
  auto rows = handover_->take_rows(engine_->progress());
  if (!rows) return outcome_ = finish();
  rows_ = *std::move(rows);
  return {};
}

Result<std::optional<Row>> Rows::next() {
  if (next_ == rows_.size()) A3D_TRY(fetch());
  if (next_ == rows_.size()) return std::optional<Row>();
  return std::optional<Row>(std::move(rows_[next_++]));
}

Status Rows::for_each(const std::function<void(const Row&)>& visit) {
  while (true) {
    A3D_ASSIGN(const std::optional<Row> row, next());
    if (!row) return {};
    visit(*row);
  }
}

void Rows::Iterator::take() {
  auto next = rows_->next();
  if (!next)
    row_.emplace(std::move(next).error());
  else if (*next)
    row_.emplace(**std::move(next));
  else
    row_.reset();
}

Rows::Iterator& Rows::Iterator::operator++() {
  if (row_->ok())
    take();
  else
    row_.reset();
  return *this;
}

Result<std::vector<Row>> Rows::all() {
  std::vector<Row> rows;
  try {
    while (true) {
      A3D_ASSIGN(std::optional<Row> row, next());
      if (!row) return rows;
      rows.push_back(*std::move(row));
    }
  } catch (const std::bad_alloc&) {  // of the host, which counts its memory itself, if at all
    close();
    return Error(ErrorCode::out_of_memory, "out of memory");
  }
}

}  // namespace algebra3d::database
