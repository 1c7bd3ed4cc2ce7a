#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/work_memory.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// The elements that an operator must hold in memory at the same time, within the work memory.
template <typename Stream>
class KeptElements {
 public:
  /// `op` names the operator in the error.
  KeptElements(std::string op, const Context& context)
      : op_(std::move(op)), limit_(context.memory == nullptr ? 0 : context.memory->limit()), account_(context.memory) {}

  /// Errors: limit_exceeded.
  Status add(ElementOf<Stream> element) {
    if (!account_.take(bytes_of(element)))
      return Error{ErrorCode::limit_exceeded,
                   "{}: {} elements and more do not fit into its part of the {} MB of work memory; `set \"memory\"` "
                   "allows more",
                   op_, elements_.size(), limit_ >> 20U};
    elements_.push_back(std::move(element));
    return {};
  }
  std::vector<ElementOf<Stream>>& elements() { return elements_; }

 private:
  static std::size_t bytes_of(const TuplePtr& tuple) { return sizeof(TuplePtr) + heap_bytes(*tuple); }
  static std::size_t bytes_of(const std::optional<Value>& value) {
    return sizeof value + algebra3d::heap_bytes(*value);
  }

  std::string op_;
  std::size_t limit_;
  algebra3d::MemoryAccount account_;
  std::vector<ElementOf<Stream>> elements_;
};

}  // namespace queries
