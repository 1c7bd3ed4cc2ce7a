#include "base/intrusive_pointer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/reference_count.h"

namespace algebra3d {
namespace {

// Incomplete where the pointer is a member, as in the classes that use it.
struct Counted;
void add_owner(const Counted& object) noexcept;
void remove_owner(const Counted& object) noexcept;
using CountedPointer = IntrusivePointer<const Counted>;
struct Holder {
  CountedPointer pointer;
};

int living_objects = 0, added_owners = 0;

struct Counted {
  Counted() { ++living_objects; }
  ~Counted() { --living_objects; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  mutable ReferenceCount<std::uint32_t> owners{0};
};
void add_owner(const Counted& object) noexcept {
  ++added_owners;
  object.owners.add();
}
void remove_owner(const Counted& object) noexcept {
  if (object.owners.remove()) delete &object;
}

static_assert(sizeof(CountedPointer) == sizeof(void*));
static_assert(std::is_nothrow_move_constructible_v<CountedPointer>);
static_assert(std::is_nothrow_copy_constructible_v<CountedPointer>);
static_assert(!std::is_convertible_v<const Counted*, CountedPointer>);

class IntrusivePointerTest : public ::testing::Test {
 protected:
  IntrusivePointerTest() { added_owners = 0; }
  ~IntrusivePointerTest() override { EXPECT_EQ(living_objects, 0); }
};

TEST_F(IntrusivePointerTest, NullOwnsNothing) {
  const CountedPointer null, copy = null;
  EXPECT_EQ(copy.get(), nullptr);
  EXPECT_EQ(CountedPointer(nullptr).get(), nullptr);
  EXPECT_EQ(added_owners, 0);
}

TEST_F(IntrusivePointerTest, TheLastOwnerDeletesTheObject) {
  std::optional<CountedPointer> first(new Counted), second(*first);
  EXPECT_EQ(first->get(), second->get());
  EXPECT_EQ(added_owners, 2);
  first.reset();
  EXPECT_EQ(living_objects, 1);
  second.reset();
  EXPECT_EQ(living_objects, 0);
}

TEST_F(IntrusivePointerTest, MovingCountsNoOwner) {
  CountedPointer first(new Counted);
  const Counted* const object = first.get();
  Holder holder{std::move(first)};
  EXPECT_EQ(first.get(), nullptr);  // NOLINT(bugprone-use-after-move): it is null by contract
  CountedPointer last;
  last = std::move(holder.pointer);
  EXPECT_EQ(last.get(), object);
  EXPECT_EQ(added_owners, 1);
}

TEST_F(IntrusivePointerTest, AssignmentLeavesTheObjectBefore) {
  CountedPointer first(new Counted);
  const CountedPointer second(new Counted);
  EXPECT_EQ(living_objects, 2);
  first = second;
  EXPECT_EQ(first.get(), second.get());
  EXPECT_EQ(living_objects, 1);
  const CountedPointer& same = first;
  first = same;
  EXPECT_EQ(first.get(), second.get());
  first = CountedPointer();
  EXPECT_EQ(living_objects, 1);
}

TEST_F(IntrusivePointerTest, AVectorThatGrowsMovesItsPointers) {
  std::vector<CountedPointer> pointers;
  for (int i = 0; i < 100; ++i) pointers.emplace_back(new Counted);
  EXPECT_EQ(added_owners, 100);
  EXPECT_EQ(living_objects, 100);
}

}  // namespace
}  // namespace algebra3d
