// What an update of a stored tuple writes: the values that differ, and the pages that they are on.
#include <random>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoredUpdates : public StoreTest {
 protected:
  static constexpr int kPoints = 20000;

  /// Points that take many pages; another number gives others.
  std::string cloud(int number, int count = kPoints) {
    std::mt19937 random(static_cast<unsigned>(number));
    std::string result = "(";
    for (int i = 0; i < count; ++i) result += fmt::format("({}.5 {}.25 {}.125) ", random(), random(), random());
    return result + ")";
  }
  void let_clouds(const StoreOptions& options = {}) {
    reopen(OpenMode::open_or_create, options);
    write([&] {
      std::vector<Tuple> content;
      for (int i = 1; i <= 3; ++i)
        content.push_back(tuple({{"int", std::to_string(i)}, {"points3d", cloud(i)}, {"string", "\"a\""}}));
      let_relation("R", "(tuple ((No int) (Cloud points3d) (Name string)))", content);
    });
    reopen(OpenMode::read_write);
  }
  /// The tuple with another number.
  Tuple numbered(TupleId id, std::int64_t number) {
    Tuple changed = **relation("R")->fetch(id);
    changed.attributes[0] = Value::of(number);
    return changed;
  }
  void expect_sound() {
    read([&] {
      const auto findings = store_->check(context_, {});
      ASSERT_TRUE(findings.ok()) << findings.error().text();
      EXPECT_TRUE(findings->empty()) << findings->front().text();
    });
  }
};

// The row, the catalogue with its index of names, and the sum of the catalogue.
constexpr std::uintmax_t kPagesOfANumber = 5;

TEST_F(StoredUpdates, of_a_number_does_not_write_the_geometry_again) {
  let_clouds();
  for (const std::int64_t number : {std::int64_t{5}, std::int64_t{300}, INT64_MIN, std::int64_t{0}})
    EXPECT_LE(logged_pages([&] { ok(relation("R")->update(2, numbered(2, number))); }), kPagesOfANumber);
  EXPECT_EQ(store_->geometry_loads(), 0U);
  read([&] {
    EXPECT_EQ(text(**relation("R")->fetch(2)),
              text(tuple({{"int", "0"}, {"points3d", cloud(2)}, {"string", "\"a\""}})));
  });
  expect_sound();
}

TEST_F(StoredUpdates, of_a_number_to_itself_writes_nothing_of_the_row) {
  let_clouds();
  EXPECT_LE(logged_pages([&] { ok(relation("R")->update(2, numbered(2, 2))); }), kPagesOfANumber - 1);
  expect_sound();
}

TEST_F(StoredUpdates, equal_geometry_is_not_written_again) {
  let_clouds();
  const Tuple same = tuple({{"int", "9"}, {"points3d", cloud(2)}, {"string", "\"b\""}});
  EXPECT_LE(logged_pages([&] { ok(relation("R")->update(2, same)); }), kPagesOfANumber);
  const Tuple other = tuple({{"int", "9"}, {"points3d", cloud(7)}, {"string", "\"b\""}});
  EXPECT_GT(logged_pages([&] { ok(relation("R")->update(2, other)); }), 2 * kPagesOfANumber);
  read([&] { EXPECT_EQ(text(**relation("R")->fetch(2)), text(other)); });
  expect_sound();
}

TEST_F(StoredUpdates, geometry_of_the_old_tuple_can_still_be_read) {
  let_clouds();
  write([&] {
    const RelationPtr stored = relation("R");
    EXPECT_TRUE(stored->keeps(1));
    const TuplePtr old = *stored->fetch(1);
    Tuple changed = *old;
    changed.attributes[0] = Value::of(std::int64_t{77});
    ok(stored->update(1, changed));
    EXPECT_FALSE(stored->keeps(1));
    EXPECT_EQ(text(old->attributes[1]), text(value("points3d", cloud(1))));
    EXPECT_EQ(text(changed.attributes[1]), text(value("points3d", cloud(1))));
    EXPECT_EQ(text((*stored->fetch(1))->attributes[1]), text(value("points3d", cloud(1))));
  });
  expect_sound();
}

TEST_F(StoredUpdates, geometry_comes_goes_and_changes_its_place) {
  let_clouds();
  const auto update = [&](const std::string& geometry) {
    const Tuple changed = tuple({{"int", "4"}, {"points3d", geometry}, {"string", "\"c\""}});
    write([&] { ok(relation("R")->update(3, changed)); });
    read([&] { EXPECT_EQ(text(**relation("R")->fetch(3)), text(changed)); });
    expect_sound();
  };
  update(cloud(5, 3));
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "2");
  update("undefined");
  update("()");
  update(cloud(5, 300));
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "3");
  update(cloud(6, 300));
  update("undefined");
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "2");
}

// Rows of programs that kept geometry in them.
TEST_F(StoredUpdates, of_rows_with_their_geometry_inside) {
  let_clouds({.inline_bytes = std::uint64_t{256} << 20});
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "0");
  write([&] { ok(relation("R")->update(2, numbered(2, 1000000))); });
  EXPECT_EQ(store_->geometry_loads(), 0U);
  read([&] {
    EXPECT_EQ(text(**relation("R")->fetch(2)),
              text(tuple({{"int", "1000000"}, {"points3d", cloud(2)}, {"string", "\"a\""}})));
  });
  write([&] { ok(relation("R")->update(1, tuple({{"int", "1"}, {"points3d", cloud(8)}, {"string", "\"a\""}}))); });
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "1");
  expect_sound();
}

}  // namespace
}  // namespace queries
