#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <ranges>

namespace algebra3d {

/// The index of an object of one kind; invalid by default. Ids of different kinds are different types without
/// conversions to each other; conversions from and to integers are explicit. `Tag` is a type that names the kind and
/// may be incomplete. Same cost as std::uint32_t.
///
///     using FacetId = StrongId<struct FacetTag>;
template <typename Tag>
class StrongId {
 public:
  constexpr StrongId() = default;
  /// `index` must be below 2^32 - 1, the invalid index.
  template <std::integral Integer>
  constexpr explicit StrongId(Integer index) : index_(static_cast<std::uint32_t>(index)) {}

  static constexpr StrongId none() { return {}; }

  constexpr std::uint32_t index() const { return index_; }
  constexpr bool is_none() const { return index_ == kInvalid; }
  constexpr bool is_valid() const { return index_ != kInvalid; }

  /// Order by index; the invalid id is last.
  friend constexpr auto operator<=>(StrongId, StrongId) = default;  // NOLINT(modernize-use-nullptr)
  /// For boost::hash.
  friend constexpr std::size_t hash_value(StrongId id) { return id.index_; }

 private:
  static constexpr std::uint32_t kInvalid = 0xFFFFFFFF;

  std::uint32_t index_ = kInvalid;
};

/// The range of ids from `first` to `last`, exclusive.
template <typename Id>
class IdRange {
 public:
  class Iterator {
   public:
    using value_type = Id;
    using difference_type = std::ptrdiff_t;

    constexpr Iterator() = default;
    constexpr explicit Iterator(std::uint32_t index) : index_(index) {}

    constexpr Id operator*() const { return Id(index_); }
    constexpr Iterator& operator++() {
      ++index_;
      return *this;
    }
    constexpr Iterator operator++(int) {
      const Iterator before = *this;
      ++index_;
      return before;
    }
    friend constexpr bool operator==(Iterator, Iterator) = default;

   private:
    std::uint32_t index_ = 0;
  };

  constexpr IdRange() = default;
  constexpr IdRange(Id first, Id last) : first_(first.index()), last_(last.index()) {}
  /// All ids below `count`.
  constexpr explicit IdRange(std::size_t count) : last_(static_cast<std::uint32_t>(count)) {}

  constexpr Iterator begin() const { return Iterator(first_); }
  constexpr Iterator end() const { return Iterator(last_); }
  constexpr std::size_t size() const { return last_ - first_; }
  constexpr bool empty() const { return first_ == last_; }
  constexpr Id front() const { return Id(first_); }

 private:
  std::uint32_t first_ = 0, last_ = 0;
};

}  // namespace algebra3d

/// Its iterators do not refer to it.
template <typename Id>
inline constexpr bool std::ranges::enable_borrowed_range<algebra3d::IdRange<Id>> = true;

template <typename Tag>
struct std::hash<algebra3d::StrongId<Tag>> {
  std::size_t operator()(algebra3d::StrongId<Tag> id) const noexcept { return id.index(); }
};
