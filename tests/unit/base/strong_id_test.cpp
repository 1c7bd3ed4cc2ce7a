#include "algebra3d/base/strong_id.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <unordered_set>
#include <vector>

#include "base/id_vector.h"

namespace algebra3d {
namespace {

using AppleId = StrongId<struct AppleTag>;
using PearId = StrongId<struct PearTag>;

static_assert(sizeof(AppleId) == sizeof(std::uint32_t));
static_assert(std::is_trivially_copyable_v<AppleId>);
static_assert(std::is_nothrow_move_constructible_v<AppleId>);

static_assert(!std::is_constructible_v<AppleId, PearId>);
static_assert(!std::is_assignable_v<AppleId&, PearId>);
static_assert(!std::is_convertible_v<std::uint32_t, AppleId>);
static_assert(!std::is_convertible_v<int, AppleId>);
static_assert(!std::is_assignable_v<AppleId&, std::uint32_t>);
static_assert(std::is_constructible_v<AppleId, std::uint32_t>);
static_assert(std::is_constructible_v<AppleId, std::size_t>);
static_assert(!std::is_constructible_v<AppleId, double>);
static_assert(!std::is_convertible_v<AppleId, std::uint32_t>);
static_assert(!std::is_constructible_v<std::uint32_t, AppleId>);
static_assert(!std::is_constructible_v<bool, AppleId>);

template <typename A, typename B>
concept AreCompared = requires(A a, B b) {
  a == b;
};
template <typename Container, typename Index>
concept IsIndexedBy = requires(Container container, Index index) {
  container[index];
};

static_assert(AreCompared<AppleId, AppleId>);
static_assert(!AreCompared<AppleId, PearId>);
static_assert(!AreCompared<AppleId, std::uint32_t>);
static_assert(IsIndexedBy<IdVector<AppleId, int>, AppleId>);
static_assert(!IsIndexedBy<IdVector<AppleId, int>, PearId>);
static_assert(!IsIndexedBy<IdVector<AppleId, int>, std::size_t>);
static_assert(IsIndexedBy<IdSpan<AppleId, const int>, AppleId>);
static_assert(!IsIndexedBy<IdSpan<AppleId, const int>, PearId>);
static_assert(!IsIndexedBy<IdSpan<AppleId, const int>, std::size_t>);

constexpr AppleId kThird(2);
static_assert(kThird.index() == 2 && !kThird.is_none());
static_assert(AppleId().is_none() && AppleId::none() == AppleId());
static_assert(AppleId(1) < kThird && kThird < AppleId::none());
static_assert(std::forward_iterator<IdRange<AppleId>::Iterator>);

TEST(StrongId, hashes_like_its_index) {
  const std::unordered_set<AppleId> apples{AppleId(3), AppleId(5), AppleId(3)};
  EXPECT_EQ(apples.size(), 2U);
  EXPECT_TRUE(apples.contains(AppleId(5)));
}

TEST(StrongId, a_range_holds_the_first_and_not_the_last) {
  std::vector<AppleId> seen;
  for (const AppleId apple : IdRange(AppleId(2), AppleId(5))) seen.push_back(apple);
  EXPECT_EQ(seen, (std::vector{AppleId(2), AppleId(3), AppleId(4)}));
  EXPECT_EQ(IdRange<AppleId>(3).size(), 3U);
  EXPECT_TRUE(IdRange<AppleId>().empty());
}

TEST(IdVector, gives_ids_to_its_elements) {
  IdVector<AppleId, char> letters;
  EXPECT_EQ(letters.next_id(), AppleId(0));
  EXPECT_EQ(letters.push_back('a'), AppleId(0));
  EXPECT_EQ(letters.push_back('b'), AppleId(1));
  letters[AppleId(0)] = 'c';
  EXPECT_EQ(letters.values(), (std::vector<char>{'c', 'b'}));
  std::size_t count = 0;
  for (const AppleId id : letters.ids()) count += letters[id] != 'x' ? 1 : 0;
  EXPECT_EQ(count, 2U);
}

TEST(IdVector, holds_flags) {
  IdVector<AppleId, bool> flags(3);
  flags[AppleId(1)] = true;
  EXPECT_EQ(flags, (IdVector<AppleId, bool>{false, true, false}));
}

TEST(IdVector, a_span_looks_at_it) {
  IdVector<AppleId, int> numbers{7, 8};
  const IdSpan<AppleId, const int> seen = numbers;
  const IdSpan<AppleId, int> changed = numbers;
  changed[AppleId(1)] = 9;
  EXPECT_EQ(seen[AppleId(1)], 9);
  EXPECT_EQ(seen.size(), 2U);
}

}  // namespace
}  // namespace algebra3d
