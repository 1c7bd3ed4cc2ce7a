// What does not fit into the work memory goes through temporary files, and nothing else changes. The oracle is a loop
// over a plain table.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/spatial.h"
#include "base/work_memory.h"
#include "queries/streams/detail/adjacent_groups.h"
#include "queries/streams/detail/block_join.h"
#include "queries/streams/detail/element_buffer.h"
#include "queries/streams/detail/hash_join.h"
#include "queries/streams/detail/hash_table.h"
#include "queries/streams/detail/sorting.h"
#include "queries/streams/relation.h"
#include "unit/streams/stream_fixture.h"

namespace queries {
namespace {

using algebra3d::WorkMemory;

/// Every account has the least that there is: 64 KB, some 300 tuples.
class Spilling : public StreamTest {
 protected:
  Spilling() { context.memory = &memory_; }
  ~Spilling() override { EXPECT_EQ(memory_.used(), 0U) << "an account was not given back"; }

  Rows random_rows(std::size_t count, std::int64_t keys) {
    Rows result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto key = static_cast<std::int64_t>(random_() % static_cast<unsigned>(keys));
      result.push_back({key == 0 ? std::nullopt : std::optional(key - keys / 2), static_cast<std::int64_t>(i)});
    }
    return result;
  }

  WorkMemory memory_{1, WorkMemory::default_folder()};

 private:
  std::mt19937 random_{17};
};

TEST_F(Spilling, a_buffer_gives_everything_in_its_order_and_finds_by_id) {
  TupleBuffer buffer(context);
  for (std::int64_t i = 0; i < 5000; ++i)
    ASSERT_TRUE(buffer.add(std::make_shared<const Tuple>(Tuple{{Value::of(i)}, i + 1})).ok());
  EXPECT_LT(memory_.used(), 70'000U);
  const TupleStreamPtr one = buffer.scan();
  const TupleStreamPtr other = buffer.scan();
  for (std::int64_t i = 0; i < 5000; ++i) {
    const auto next = one->next();
    ASSERT_TRUE(next.ok() && *next != nullptr);
    EXPECT_EQ((*next)->attributes[0].get<std::int64_t>(), i);
    EXPECT_EQ((*next)->id, i + 1);
    EXPECT_TRUE(i % 2 == 1 || other->next().ok());
  }
  EXPECT_EQ(*one->next(), nullptr);
  EXPECT_EQ((*buffer.find(1))->attributes[0].get<std::int64_t>(), 0);
  EXPECT_EQ((*buffer.find(4999))->attributes[0].get<std::int64_t>(), 4998);
  EXPECT_EQ(*buffer.find(5001), nullptr);
}

TEST_F(Spilling, sorting_is_stable_over_any_number_of_runs) {
  for (const std::size_t count : {0U, 1U, 400U, 20'000U}) {
    Rows table = random_rows(count, 50);
    for (const bool descends : {false, true}) {
      const auto result = sorted(*stream(table), {{0, descends}}, context);
      ASSERT_TRUE(result.ok());
      Rows expected = table;
      std::ranges::stable_sort(expected,
                               [&](const Row& a, const Row& b) { return descends ? a[0] > b[0] : a[0] < b[0]; });
      EXPECT_EQ(rows(**result), expected) << count;
    }
  }
}

TEST_F(Spilling, sorting_compares_all_keys_where_the_beginnings_are_equal) {
  Rows table = random_rows(5000, 10);
  const auto result = sorted(*stream(table), {{0, false}, {1, true}}, context);
  ASSERT_TRUE(result.ok());
  std::ranges::sort(table, [](const Row& a, const Row& b) { return a[0] != b[0] ? a[0] < b[0] : a[1] > b[1]; });
  EXPECT_EQ(rows(**result), table);
}

TEST_F(Spilling, a_block_join_finds_every_pair_once) {
  for (const std::size_t build_count : {0U, 100U, 3000U}) {
    const Rows build = random_rows(build_count, 400);
    const Rows probe_side = random_rows(2000, 400);
    const auto combine = [](const Tuple& a, const Tuple& b) { return concatenated(a, b); };
    Rows found = rows(*block_join(stream(build), stream(probe_side), HashTable(0, 0, context), combine, context));
    std::multimap<std::int64_t, Row> by_key;
    for (const Row& each : build)
      if (each[0]) by_key.emplace(*each[0], each);
    Rows expected;
    for (const Row& probe : probe_side) {
      if (!probe[0]) continue;
      const auto [first, last] = by_key.equal_range(*probe[0]);
      for (auto partner = first; partner != last; ++partner)
        expected.push_back({partner->second[0], partner->second[1], probe[0], probe[1]});
    }
    std::ranges::sort(found);
    std::ranges::sort(expected);
    EXPECT_EQ(found, expected) << build_count;
  }
}

TEST_F(Spilling, a_hash_join_finds_every_pair_once) {
  // 20 keys: files that do not fit into memory either.
  for (const std::int64_t keys : {20, 3000}) {
    const Rows build = random_rows(3000, keys);
    const Rows probe_side = random_rows(1000, keys);
    HashJoin join(stream(probe_side), stream(build), {{0, 0}}, context);
    Rows found = rows(join);
    Rows expected;
    for (const Row& a : probe_side)
      for (const Row& b : build)
        if (a[0] && a[0] == b[0]) expected.push_back({a[0], a[1], b[0], b[1]});
    std::ranges::sort(found);
    std::ranges::sort(expected);
    EXPECT_EQ(found, expected) << keys;
  }
}

TEST_F(Spilling, a_set_of_keys_that_was_full_takes_no_smaller_ones) {
  SeenKeys seen(context);
  EXPECT_EQ(seen.add({Value::of(std::string(60'000, 'x'))}), SeenKeys::Answer::is_new);
  EXPECT_EQ(seen.add({Value::of(std::string(60'000, 'y'))}), SeenKeys::Answer::no_room);
  EXPECT_EQ(seen.add({Value::of(std::string("y"))}), SeenKeys::Answer::no_room);
  EXPECT_EQ(seen.add({Value::of(std::string(60'000, 'x'))}), SeenKeys::Answer::was_seen);
  seen.clear();
  EXPECT_EQ(seen.add({Value::of(std::string("y"))}), SeenKeys::Answer::is_new);
}

TEST_F(Spilling, groups_larger_than_the_memory_are_whole) {
  Rows table = random_rows(6000, 3);
  std::ranges::stable_sort(table, {}, [](const Row& row) { return row[0]; });
  AdjacentGroups groups(stream(table), {0});
  Rows found;
  while (true) {
    const auto group = groups.next(context);
    ASSERT_TRUE(group.ok());
    if (!*group) break;
    const Rows members = rows(*(*group)->tuples.scan());
    found.insert(found.end(), members.begin(), members.end());
  }
  EXPECT_EQ(found, table);
}

TEST_F(Spilling, tuples_of_every_type_come_back_equal) {
  std::vector<const algebra3d::Type*> types = {&algebra3d::TypeOf<std::int64_t>::type(),
                                               &algebra3d::TypeOf<double>::type(),
                                               &algebra3d::TypeOf<bool>::type(),
                                               &algebra3d::TypeOf<std::string>::type(),
                                               &algebra3d::TypeOf<algebra3d::Text>::type(),
                                               &algebra3d::TypeOf<algebra3d::Box3>::type(),
                                               &algebra3d::TypeOf<algebra3d::Point3d>::type(),
                                               &algebra3d::TypeOf<algebra3d::Vector3d>::type(),
                                               &algebra3d::TypeOf<algebra3d::Plane3d>::type(),
                                               &algebra3d::TypeOf<algebra3d::Points3d>::type(),
                                               &algebra3d::TypeOf<algebra3d::Surface3d>::type(),
                                               &algebra3d::TypeOf<algebra3d::Volume3d>::type()};
  Tuple defined{{}, 7};
  Tuple undefined{{}, 8};
  for (const algebra3d::Type* type : types) {
    const auto list = algebra3d::NestedList::parse(type->example());
    ASSERT_TRUE(list.ok());
    auto value = type->from_nested(*list, context);
    ASSERT_TRUE(value.ok() && value->is_defined()) << type->name();
    defined.attributes.push_back(*value);
    undefined.attributes.emplace_back(*type);
  }
  const auto file = TupleFile::make(context);
  ASSERT_TRUE(file.ok());
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE((*file)->append(defined).ok());
    ASSERT_TRUE((*file)->append(undefined).ok());
  }
  const auto scan = (*file)->scan(0, (*file)->end());
  for (int i = 0; i < 2000; ++i) {
    const Tuple& expected = i % 2 == 0 ? defined : undefined;
    const auto found = scan->next();
    ASSERT_TRUE(found.ok() && *found != nullptr);
    EXPECT_EQ((*found)->id, expected.id);
    for (std::size_t k = 0; k < types.size(); ++k) {
      EXPECT_EQ(compare((*found)->attributes[k], expected.attributes[k]), std::strong_ordering::equal);
      EXPECT_EQ((*found)->attributes[k].to_nested(), expected.attributes[k].to_nested());
    }
  }
  EXPECT_EQ(*scan->next(), nullptr);
}

TEST_F(Spilling, a_value_larger_than_the_memory_passes) {
  const std::string large(1'000'000, 'x');
  TupleBuffer buffer(context);
  for (int i = 0; i < 3; ++i)
    ASSERT_TRUE(buffer.add(std::make_shared<const Tuple>(Tuple{{Value::of(large + std::to_string(i))}})).ok());
  const TupleStreamPtr scan = buffer.scan();
  for (int i = 0; i < 3; ++i) EXPECT_EQ((*scan->next())->attributes[0].get<std::string>(), large + std::to_string(i));
  EXPECT_EQ(*scan->next(), nullptr);
}

Value point_at(int x) {
  const std::string text = fmt::format("(({} 0 0))", x);
  algebra3d::Diagnostics unheard;
  Context context{unheard, nullptr, {}};
  return *algebra3d::value_from_nested(algebra3d::TypeOf<algebra3d::Points3d>::type(),
                                       *algebra3d::NestedList::parse(text), context);
}

class PointSource final : public algebra3d::DeferredSource {
 public:
  bool is_same_as(const DeferredSource& other) const override { return &other == this; }
  Value value(std::string_view reference) const override { return point_at(std::stoi(std::string(reference))); }
};

/// A deferred set of one point, of which nothing but its reference survives.
class DeferredPoint final : public algebra3d::DeferredValue {
 public:
  DeferredPoint(int x, std::shared_ptr<const PointSource> source) : x_(x), source_(std::move(source)) {}
  algebra3d::GeometryHeader header() const override { return {}; }
  Result<Value> load() const override { return point_at(x_); }
  std::shared_ptr<const algebra3d::DeferredSource> source() const override { return source_; }
  void append_reference(std::string& bytes) const override { bytes += std::to_string(x_); }

 private:
  int x_;
  std::shared_ptr<const PointSource> source_;
};

TEST_F(Spilling, deferred_values_are_put_aside_by_reference_and_sorted_by_content) {
  const auto source = std::make_shared<PointSource>();
  int next = 0;
  const TupleStreamPtr tuples = make_stream([&]() -> Result<TuplePtr> {
    if (next == 3000) return TuplePtr();
    const auto deferred = std::make_shared<DeferredPoint>((next++ * 7) % 3000, source);
    return TuplePtr(
        std::make_shared<const Tuple>(Tuple{{Value(algebra3d::TypeOf<algebra3d::Points3d>::type(), deferred)}}));
  });
  const auto result = sorted(*tuples, {{0, false}}, context);
  ASSERT_TRUE(result.ok());
  for (int i = 0; i < 3000; ++i) {
    const auto found = (*result)->next();
    ASSERT_TRUE(found.ok() && *found != nullptr);
    const auto loaded = (*found)->attributes[0].loaded();
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(compare(*loaded, point_at(i)), std::strong_ordering::equal) << i;
  }
}

TEST_F(Spilling, a_folder_that_is_not_there_is_an_error_with_a_remedy) {
  WorkMemory nowhere(1, "/no/such/folder");
  context.memory = &nowhere;
  const auto result = sorted(*stream(random_rows(5000, 10)), {{0, false}}, context);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "temporary file in /no/such/folder: No such file or directory; the environment variable TMPDIR names "
            "another folder, and `set \"memory\" = ...` the megabytes to keep in memory");
}

}  // namespace
}  // namespace queries
