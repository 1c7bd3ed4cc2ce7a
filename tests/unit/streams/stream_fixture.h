#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"
#include "queries/streams/mapping.h"

namespace queries {

using Row = std::vector<std::optional<std::int64_t>>;
using Rows = std::vector<Row>;

/// Streams of tuples of ints from tables, and back.
class StreamTest : public testing::Test {
 protected:
  static TupleStreamPtr stream(Rows rows) {
    return make_stream([rows = std::move(rows), position = std::size_t{0}]() mutable -> Result<TuplePtr> {
      if (position == rows.size()) return TuplePtr();
      Tuple tuple;
      for (const auto& cell : rows[position])
        tuple.attributes.push_back(cell ? Value::of(*cell) : Value(algebra3d::TypeOf<std::int64_t>::type()));
      ++position;
      return TuplePtr(std::make_shared<const Tuple>(std::move(tuple)));
    });
  }
  static Row row(const Tuple& tuple) {
    Row result;
    for (const Value& value : tuple.attributes)
      result.push_back(value.is_defined() ? std::optional(value.get<std::int64_t>()) : std::nullopt);
    return result;
  }
  Rows rows(TupleStream& tuples) {
    Rows result;
    const Status status = for_each_tuple(tuples, context, [&](const TuplePtr& tuple) -> Status {
      result.push_back(row(*tuple));
      return {};
    });
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().text());
    return result;
  }

  algebra3d::Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
};

}  // namespace queries
