#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {

// Operators on streams of tuples and of values alike are written once, over Stream = TupleStream or ValueStream.
// An element, TuplePtr or std::optional<Value>, converts to false at the end.

template <typename Stream>
using ElementOf = typename decltype(std::declval<Stream&>().next())::value_type;

/// A stream of the kind of `Stream` whose `next` is a function object.
template <typename Stream, typename Next>
std::shared_ptr<Stream> make_stream_of(Next next) {
  if constexpr (std::is_same_v<Stream, TupleStream>)
    return make_stream(std::move(next));
  else
    return make_value_stream(std::move(next));
}

/// Calls `visit` with the operand as std::shared_ptr<TupleStream> or std::shared_ptr<ValueStream>.
template <typename Visit>
auto visit_stream(const Datum& operand, Visit visit) {
  if (const auto* values = std::get_if<ValueStreamPtr>(&operand.content)) return visit(*values);
  return visit(operand.tuples());
}

/// A stream of the elements of the first stream, then those of the second.
template <typename Stream>
std::shared_ptr<Stream> one_after_the_other(std::shared_ptr<Stream> first, std::shared_ptr<Stream> second) {
  return make_stream_of<Stream>(
      [first = std::move(first), second = std::move(second), is_first = true]() mutable -> Result<ElementOf<Stream>> {
        if (is_first) {
          A3D_ASSIGN(ElementOf<Stream> next, first->next());
          if (next) return next;
          is_first = false;
        }
        return second->next();
      });
}

/// Converts an element to an argument of a function.
inline Datum element_datum(const TuplePtr& tuple) {
  return Datum{tuple};
}
inline Datum element_datum(const std::optional<Value>& value) {
  return Datum{*value};
}

/// Calls `visit(element)` for each element until the end or an error. Interruptible.
template <typename Stream, typename Visit>
Status for_each_element(Stream& stream, const Context& context, Visit visit) {
  if constexpr (std::is_same_v<Stream, TupleStream>) return for_each_tuple(stream, context, visit);
  for (std::uint32_t step = 1;; ++step) {
    A3D_ASSIGN(const auto element, stream.next());
    if (!element) return {};
    if (step % 1024 == 0) A3D_TRY(context.check_cancelled());
    A3D_TRY(visit(element));
  }
}

/// Loads all values of an element: the attributes of a tuple, or the value itself.
Result<std::vector<Value>> loaded_values(const TuplePtr& tuple);
Result<std::vector<Value>> loaded_values(const std::optional<Value>& value);

}  // namespace queries
