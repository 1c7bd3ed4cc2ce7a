// Databases from the time when ints had 32 bits.
#include "unit/store/store_fixture.h"

#include <filesystem>

#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

namespace fs = std::filesystem;

// data/ints32.database was written by the program at commit 72d4a97:
//   let small = -2147483648; let large = 2147483647; let Numbers = [const rel(tuple([No: int, N: int, R: real, Name:
//   string, Note: text])) value ((1 2147483647 0.5 "a" 'x') (2 -2147483648 1.5 "b" 'y') (3 undefined 2.5 "c" 'z')
//   (4 0 9007199254740992.0 "d" 'w') (5 -1 -0.5 "e" 'v'))]; let Numbers_N = Numbers createbtree[N]; let Frozen_N =
//   Numbers feed addid createbtree[N]; let twice = fun (x: int) x * 2; derive total = Numbers feed sum[No];
//   let Stamps = [const rel(tuple([Id: tid, D: duration])) value ((1 (3 5)) (4294967297 (-7 1)))];
class OlderInts : public StoreTest {
 protected:
  OlderInts() { fs::copy_file(fs::path(ALGEBRA3D_SOURCE) / "tests/unit/store/data/ints32.database", path()); }

  std::string ids(const OrderedIndex& index, std::int64_t low, std::int64_t high) {
    std::string text;
    const auto found = index.entries().range(Value::of(low), Value::of(high));
    for (const TupleId id : *found) text += std::to_string(id) + " ";
    return text;
  }
};

TEST_F(OlderInts, are_read) {
  reopen(OpenMode::read_only);
  EXPECT_EQ(store_->opening_notice(), "");
  read([&] {
    EXPECT_EQ(text(store_->read("small")->value()), "-2147483648");
    EXPECT_EQ(text(store_->read("large")->value()), "2147483647");
    EXPECT_EQ(text(store_->read("total")->value()), "15");
    EXPECT_EQ(rows("Numbers"), (std::vector<std::string>{"1 2147483647 0.5 \"a\" 'x'", "2 -2147483648 1.5 \"b\" 'y'",
                                                         "3 undefined 2.5 \"c\" 'z'",
                                                         "4 0 9007199254740992.0 \"d\" 'w'", "5 -1 -0.5 \"e\" 'v'"}));
    EXPECT_EQ(rows("Stamps"), (std::vector<std::string>{"1 (3 5)", "4294967297 (-7 1)"}));
    EXPECT_EQ(ids(*store_->read("Numbers_N")->ordered_index(), INT64_MIN, INT64_MAX), "2 5 4 1 ");
    EXPECT_EQ(ids(*store_->read("Frozen_N")->ordered_index(), -1, 2147483647), "5 4 1 ");
  });
}

TEST_F(OlderInts, take_larger_ones) {
  reopen();
  write([&] {
    for (const char* number : {"5000000000", "-9223372036854775808"})
      EXPECT_TRUE(
          relation("Numbers")
              ->insert(tuple({{"int", "6"}, {"int", number}, {"real", "0.5"}, {"string", "\"f\""}, {"text", "'u'"}}))
              .ok());
    ok(store_->assign("large", Datum{Value::of(INT64_MAX)}, context_));
  });
  reopen();
  read([&] {
    EXPECT_EQ(text(store_->read("large")->value()), "9223372036854775807");
    EXPECT_EQ(rows("Numbers").back(), "6 -9223372036854775808 0.5 \"f\" 'u'");
    EXPECT_EQ(ids(*store_->read("Numbers_N")->ordered_index(), INT64_MIN, INT64_MAX), "7 2 5 4 1 6 ");
  });
  EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
}

}  // namespace
}  // namespace queries
