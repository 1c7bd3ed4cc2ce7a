#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/base/strong_id.h"

namespace algebra3d {

/// A std::vector indexed by ids of one kind, from 0. It cannot be indexed by integers or by other ids.
template <typename Id, typename T, typename Allocator = std::allocator<T>>
class IdVector {
 public:
  using Values = std::vector<T, Allocator>;
  using value_type = T;

  IdVector() = default;
  explicit IdVector(const Allocator& allocator) : values_(allocator) {}
  explicit IdVector(std::size_t size) : values_(size) {}
  IdVector(std::size_t size, const T& value) : values_(size, value) {}
  IdVector(std::initializer_list<T> values) : values_(values) {}
  explicit IdVector(Values values) : values_(std::move(values)) {}

  typename Values::reference operator[](Id id) { return values_[id.index()]; }
  typename Values::const_reference operator[](Id id) const { return values_[id.index()]; }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  /// The ids of all elements.
  IdRange<Id> ids() const { return IdRange<Id>(values_.size()); }
  /// The id of the next element.
  Id next_id() const { return Id(values_.size()); }

  auto begin() { return values_.begin(); }
  auto begin() const { return values_.begin(); }
  auto end() { return values_.end(); }
  auto end() const { return values_.end(); }
  typename Values::reference front() { return values_.front(); }
  typename Values::const_reference front() const { return values_.front(); }
  typename Values::reference back() { return values_.back(); }
  typename Values::const_reference back() const { return values_.back(); }

  /// Appends an element and returns its id.
  Id push_back(T value) {
    values_.push_back(std::move(value));
    return Id(values_.size() - 1);
  }
  void reserve(std::size_t size) { values_.reserve(size); }
  void resize(std::size_t size) { values_.resize(size); }
  void resize(std::size_t size, const T& value) { values_.resize(size, value); }
  void assign(std::size_t size, const T& value) { values_.assign(size, value); }
  void clear() { values_.clear(); }

  /// The elements as an ordinary vector, for algorithms that need no ids.
  Values& values() { return values_; }
  const Values& values() const { return values_; }

  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  Values values_;
};

/// A std::span indexed by ids of one kind, like IdVector.
template <typename Id, typename T>
class IdSpan {
 public:
  constexpr IdSpan() = default;
  constexpr explicit IdSpan(std::span<T> values) : values_(values) {}
  template <typename Element, typename Allocator>
  IdSpan(const IdVector<Id, Element, Allocator>& values) : values_(values.values()) {}  // NOLINT: as std::span does
  template <typename Element, typename Allocator>
  IdSpan(IdVector<Id, Element, Allocator>& values) : values_(values.values()) {}  // NOLINT: as std::span does

  constexpr T& operator[](Id id) const { return values_[id.index()]; }

  constexpr std::size_t size() const { return values_.size(); }
  constexpr bool empty() const { return values_.empty(); }
  constexpr IdRange<Id> ids() const { return IdRange<Id>(values_.size()); }
  constexpr auto begin() const { return values_.begin(); }
  constexpr auto end() const { return values_.end(); }

 private:
  std::span<T> values_;
};

}  // namespace algebra3d
