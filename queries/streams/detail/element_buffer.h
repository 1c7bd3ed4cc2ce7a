#pragma once

#include <memory>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/detail/any_stream.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A TupleBuffer for the elements of streams of either kind: a value is kept as a tuple of its own.
template <typename Stream>
class ElementBuffer {
 public:
  explicit ElementBuffer(const Context& context) : tuples_(context) {}

  Status add(const ElementOf<Stream>& element) {
    if constexpr (std::is_same_v<Stream, TupleStream>)
      return tuples_.add(element);
    else
      return tuples_.add(std::make_shared<const Tuple>(Tuple{{*element}}));
  }
  std::size_t size() const { return tuples_.size(); }
  /// The elements from number `first` on.
  std::shared_ptr<Stream> scan(std::size_t first = 0) const {
    return make_stream_of<Stream>([tuples = tuples_.scan(), first]() mutable -> Result<ElementOf<Stream>> {
      for (; first > 0; --first) {
        A3D_ASSIGN(const TuplePtr passed_over, tuples->next());
        if (passed_over == nullptr) return ElementOf<Stream>();
      }
      A3D_ASSIGN(const TuplePtr next, tuples->next());
      if constexpr (std::is_same_v<Stream, TupleStream>)
        return next;
      else
        return next == nullptr ? std::optional<Value>() : std::optional(next->attributes.front());
    });
  }

 private:
  TupleBuffer tuples_;
};

}  // namespace queries
