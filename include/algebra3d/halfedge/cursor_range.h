#pragma once

#include <compare>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <utility>

namespace algebra3d {

/// A forward iterator over a cursor: a regular type with `value_type`, `get()`, `advance()` and `==`. Values are
/// computed, so for algorithms before C++20 it is an input iterator.
template <typename Cursor>
class CursorIterator {
 public:
  using value_type = typename Cursor::value_type;
  using difference_type = std::ptrdiff_t;
  using iterator_concept = std::forward_iterator_tag;
  using iterator_category = std::input_iterator_tag;

  CursorIterator() = default;
  explicit CursorIterator(Cursor cursor) : cursor_(std::move(cursor)) {}

  value_type operator*() const { return cursor_.get(); }
  CursorIterator& operator++() {
    cursor_.advance();
    return *this;
  }
  CursorIterator operator++(int) {
    CursorIterator before = *this;
    cursor_.advance();
    return before;
  }
  bool operator==(const CursorIterator& other) const { return cursor_ == other.cursor_; }

 private:
  Cursor cursor_;
};

/// The range of values from one cursor to another. A view; its iterators do not refer to it. (Not a
/// std::ranges::view_interface: Clang 14 rejects that of GCC 12's library.)
template <typename Cursor>
class CursorRange : public std::ranges::view_base {
 public:
  CursorRange() = default;
  CursorRange(Cursor first, Cursor last) : first_(std::move(first)), last_(std::move(last)) {}

  CursorIterator<Cursor> begin() const { return CursorIterator<Cursor>(first_); }
  CursorIterator<Cursor> end() const { return CursorIterator<Cursor>(last_); }
  bool empty() const { return first_ == last_; }
  typename Cursor::value_type front() const { return first_.get(); }

 private:
  Cursor first_;
  Cursor last_;
};

/// The range of handles with indices from `first` to `last`, exclusive. A view; its iterators do not refer to it.
template <typename Id>
class HandleRange : public std::ranges::view_base {
 public:
  class Iterator {
   public:
    using value_type = Id;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::random_access_iterator_tag;
    using iterator_category = std::input_iterator_tag;

    Iterator() = default;
    explicit Iterator(std::size_t index) : index_(static_cast<difference_type>(index)) {}

    Id operator*() const { return Id(static_cast<std::size_t>(index_)); }
    Id operator[](difference_type n) const { return *(*this + n); }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator operator++(int) { return std::exchange(*this, *this + 1); }
    Iterator operator--(int) { return std::exchange(*this, *this - 1); }
    Iterator& operator+=(difference_type n) {
      index_ += n;
      return *this;
    }
    Iterator& operator-=(difference_type n) { return *this += -n; }
    friend Iterator operator+(Iterator it, difference_type n) { return it += n; }
    friend Iterator operator+(difference_type n, Iterator it) { return it += n; }
    friend Iterator operator-(Iterator it, difference_type n) { return it -= n; }
    friend difference_type operator-(Iterator a, Iterator b) { return a.index_ - b.index_; }
    friend auto operator<=>(Iterator, Iterator) = default;

   private:
    difference_type index_ = 0;
  };

  HandleRange() = default;
  HandleRange(std::size_t first, std::size_t last) : first_(first), last_(last) {}

  Iterator begin() const { return Iterator(first_); }
  Iterator end() const { return Iterator(last_); }
  bool empty() const { return first_ == last_; }
  std::size_t size() const { return last_ - first_; }
  Id operator[](std::size_t n) const { return Id(first_ + n); }

 private:
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

}  // namespace algebra3d

template <typename Cursor>
inline constexpr bool std::ranges::enable_borrowed_range<algebra3d::CursorRange<Cursor>> = true;
template <typename Id>
inline constexpr bool std::ranges::enable_borrowed_range<algebra3d::HandleRange<Id>> = true;
