// Damaged files: an error or the right answer, never wrong data and never a crash.
#include <random>

#include "base/propagate.h"
#include "support/rounds.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoreDamage : public StoreTest {
 protected:
  /// Everything that is stored, as text, or the error.
  Result<std::string> contents() {
    A3D_ASSIGN(const auto store, Store::open(path(), OpenMode::read_write, registry_));
    A3D_TRY(store->begin(false));
    return contents(*store);
  }
  Result<std::string> contents(Store& store) {
    A3D_ASSIGN(const auto objects, store.objects());
    A3D_ASSIGN(const auto types, store.types());
    std::string result;
    for (const NamedType& each : types) result += each.name + " = " + each.type.text() + "\n";
    for (const ObjectInfo& info : objects) {
      result += info.name + " " + info.type.text() + " " + info.function_text + info.derived_text + "\n";
      if (info.type.is_function()) continue;
      A3D_ASSIGN(const Datum datum, store.read(info.name));
      if (info.type.is("rtree3")) {
        A3D_ASSIGN(const std::size_t size, datum.index()->size());
        result += fmt::format("{}\n", size);
      } else if (info.type.is_relation()) {
        A3D_TRY(append(*datum.relation(), result));
      } else {
        result += text(datum.value()) + "\n";
      }
    }
    return result;
  }
  static Status append(Relation& relation, std::string& result) {
    A3D_ASSIGN(const auto count, relation.count());
    result += fmt::format("{} tuples\n", count);
    A3D_ASSIGN(const auto stream, relation.scan());
    while (true) {
      A3D_ASSIGN(const auto tuple, stream->next());
      if (tuple == nullptr) return {};
      for (const Value& value : tuple->attributes) {
        A3D_ASSIGN(const Value loaded, value.loaded());
        result += loaded.to_nested().print() + "\n";
      }
    }
  }
  /// Makes the file `content`, without a log.
  void put(std::string_view content) {
    write_bytes(path(), content);
    std::filesystem::remove(path().string() + "-wal");
    std::filesystem::remove(path().string() + "-shm");
  }
  void let_everything(int tuple_count = 30) {
    reopen();
    write([&] {
      std::vector<Tuple> content;
      for (int i = 0; i < tuple_count; ++i)
        content.push_back(tuple({{"int", std::to_string(i)},
                                 {"string", fmt::format("\"part number {}\"", i)},
                                 {"volume3d", solid(i)},
                                 {"point3d", fmt::format("({}/3 0.0 1.0)", 3 * i + 1)}}));
      let_relation("R", "(tuple ((No int) (Name string) (Solid volume3d) (P point3d)))", content);
      let_index("I", "R", "Solid", "volume3d");
      ok(store_->create_function("f", type("(map int int)"), "fun(x: int) x + 1"));
      ok(store_->create("v", "volume3d"));
      ok(store_->assign("v", Datum{value("volume3d", solid(4))}, context_));
      ok(store_->create_type("t", type("(rel (tuple ((A int))))")));
      ok(store_->create_derived("d", "int", "1 + 1"));
      ok(store_->assign("d", Datum{Value::of(std::int64_t{2})}, context_));
    });
    store_.reset();
  }
  static bool is_fair(ErrorCode code) {
    return code == ErrorCode::database_corrupt || code == ErrorCode::database_foreign ||
           code == ErrorCode::database_version;
  }
};

TEST_F(StoreDamage, random_bits_and_truncations_give_an_error_or_the_right_answer) {
  let_everything(25);
  const std::string whole = bytes(path());
  const auto expected = contents();
  ASSERT_TRUE(expected.ok()) << expected.error().text();
  std::mt19937 random(11);
  int errors = 0;
  for (int round = 0; round < algebra3d::rounds(250); ++round) {
    std::string damaged = whole;
    const std::size_t byte = random() % damaged.size();
    const bool is_cut = round % 10 == 9;
    if (is_cut)
      damaged.resize(byte);
    else
      damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << random() % 8));
    const std::string where = fmt::format("{} byte {}", is_cut ? "cut at" : "changed", byte);
    put(damaged);
    const auto store = Store::open(path(), round % 2 == 0 ? OpenMode::read_write : OpenMode::read_only, registry_);
    Status status = store ? (*store)->begin(false) : Status(store.error());
    const auto found = status ? contents(**store) : Result<std::string>(status.error());
    const auto checked = status ? (*store)->check(context_, {}) : Result<std::vector<Finding>>(status.error());
    EXPECT_TRUE(found ? *found == *expected : is_fair(found.error().code))
        << where << ": " << (found ? *found : found.error().text());
    EXPECT_TRUE(checked || is_fair(checked.error().code)) << where << ": " << checked.error().text();
    EXPECT_TRUE(found || !checked || !checked->empty()) << where << " is damage that the check does not see";
    errors += found ? 0 : 1;
    if (HasFailure()) return;
  }
  // Most of the file is data that no change leaves as it is; the rest is free space, which nobody misses.
  EXPECT_GT(errors, algebra3d::rounds(62));
}

TEST_F(StoreDamage, a_changed_value_is_named) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("UPDATE " + table + " SET a2_Name = 'other' WHERE id = 7");
  auto found = contents();
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::database_corrupt);
  EXPECT_EQ(found.error().text(), "R: the row of tuple 7 is not what was written");
}

TEST_F(StoreDamage, exchanged_geometry_is_found) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("UPDATE " + table + " SET a3_Solid = (SELECT a3_Solid FROM " + table + " WHERE id = 2) WHERE id = 5");
  EXPECT_EQ(contents().error().text(), "R: tuple 5: the bytes of 'Solid' are not what was written");
}

TEST_F(StoreDamage, lost_tuples_are_missed) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("DELETE FROM " + table + " WHERE id = 5");
  EXPECT_EQ(contents().error().text(), "R: the tuples that were read are not all those that were written");
}

TEST_F(StoreDamage, a_changed_catalogue_is_named) {
  let_everything();
  sql("UPDATE catalogue SET function_text = 'fun(x: int) x + 2' WHERE name = 'f'");
  EXPECT_EQ(contents().error().text(),
            path().string() + ": the catalogue's row of the object 'f' is not what was written");
}

TEST_F(StoreDamage, lost_objects_are_missed) {
  let_everything();
  sql("DELETE FROM catalogue WHERE name = 'v'");
  EXPECT_EQ(contents().error().text(),
            path().string() + ": the catalogue is not what was written: objects are missing or there are too many");
}

TEST_F(StoreDamage, a_lost_table_is_an_error) {
  let_everything();
  sql("DROP TABLE " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'"));
  EXPECT_EQ(contents().error().code, ErrorCode::database_corrupt);
}

}  // namespace
}  // namespace queries
