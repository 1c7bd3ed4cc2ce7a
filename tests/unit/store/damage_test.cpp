// Damaged files: an error or the right answer, never wrong data and never a crash.
#include <random>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoreDamage : public StoreTest {
 protected:
  /// Everything that is stored, as text, or the error.
  Result<std::string> contents() {
    auto opened = Store::open(path(), OpenMode::read_write, registry_);
    if (!opened) return opened.error();
    Store& store = **opened;
    RETURN_IF_ERROR(store.begin(false));
    ASSIGN_OR_RETURN(const auto objects, store.objects());
    std::string result;
    for (const ObjectInfo& info : objects) {
      result += info.name + " " + info.type.text() + " " + info.function_text + "\n";
      if (info.type.is_function()) continue;
      ASSIGN_OR_RETURN(const Datum datum, store.read(info.name));
      if (info.type.is("rtree3")) {
        result += fmt::format("{}\n", datum.index()->tree().size());
      } else if (info.type.is_relation()) {
        RETURN_IF_ERROR(append(*datum.relation(), result));
      } else {
        result += text(datum.value()) + "\n";
      }
    }
    return result;
  }
  static Status append(Relation& relation, std::string& result) {
    ASSIGN_OR_RETURN(const auto count, relation.count());
    result += fmt::format("{} tuples\n", count);
    ASSIGN_OR_RETURN(const auto stream, relation.scan());
    while (true) {
      ASSIGN_OR_RETURN(const auto tuple, stream->next());
      if (tuple == nullptr) return {};
      for (const Value& value : tuple->attributes) {
        ASSIGN_OR_RETURN(const Value loaded, value.loaded());
        result += loaded.to_nested().print() + "\n";
      }
    }
  }
  void let_everything() {
    reopen();
    write([&] {
      std::vector<Tuple> content;
      for (int i = 0; i < 30; ++i)
        content.push_back(tuple({{"int", std::to_string(i)},
                                 {"string", fmt::format("\"part number {}\"", i)},
                                 {"volume3d", solid(i)},
                                 {"point3d", fmt::format("({}/3 0.0 1.0)", 3 * i + 1)}}));
      let_relation("R", "(tuple ((No int) (Name string) (Solid volume3d) (P point3d)))", content);
      let_index("I", "R", "Solid", "volume3d");
      ok(store_->create_function("f", type("(map int int)"), "fun(x: int) x + 1"));
      ok(store_->create("v", "volume3d"));
      ok(store_->assign("v", Datum{value("volume3d", solid(4))}, context_));
    });
    store_.reset();
  }
  static bool is_fair(ErrorCode code) {
    return code == ErrorCode::database_corrupt || code == ErrorCode::database_foreign ||
           code == ErrorCode::database_version;
  }
};

TEST_F(StoreDamage, random_bits_give_an_error_or_the_right_answer) {
  let_everything();
  const std::string whole = bytes(path());
  const auto expected = contents();
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  std::mt19937 random(11);
  int errors = 0;
  for (int round = 0; round < 200; ++round) {
    std::string damaged = whole;
    const std::size_t byte = random() % damaged.size();
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << random() % 8));
    write_bytes(path(), damaged);
    std::filesystem::remove(path().string() + "-wal");
    std::filesystem::remove(path().string() + "-shm");
    const auto found = contents();
    if (found)
      EXPECT_EQ(*found, *expected) << "byte " << byte;
    else
      EXPECT_TRUE(is_fair(found.error().code)) << "byte " << byte << ": " << found.error().message;
    errors += found ? 0 : 1;
  }
  // Most of the file is data that no change leaves as it is.
  EXPECT_GT(errors, 50);
}

TEST_F(StoreDamage, a_changed_value_is_named) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("UPDATE " + table + " SET a2_Name = 'other' WHERE id = 7");
  auto found = contents();
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::database_corrupt);
  EXPECT_EQ(found.error().message, "R: the row of tuple 7 is not what was written");
}

TEST_F(StoreDamage, exchanged_geometry_is_found) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("UPDATE " + table + " SET a3_Solid = (SELECT a3_Solid FROM " + table + " WHERE id = 2) WHERE id = 5");
  EXPECT_EQ(contents().error().message, "R: tuple 5: the bytes of 'Solid' are not what was written");
}

TEST_F(StoreDamage, lost_tuples_are_missed) {
  let_everything();
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'");
  sql("DELETE FROM " + table + " WHERE id = 5");
  EXPECT_EQ(contents().error().message, "R: the tuples that were read are not all those that were written");
}

TEST_F(StoreDamage, a_changed_catalogue_is_named) {
  let_everything();
  sql("UPDATE catalogue SET function_text = 'fun(x: int) x + 2' WHERE name = 'f'");
  EXPECT_EQ(contents().error().message,
            path().string() + ": the catalogue's row of the object 'f' is not what was written");
}

TEST_F(StoreDamage, lost_objects_are_missed) {
  let_everything();
  sql("DELETE FROM catalogue WHERE name = 'v'");
  EXPECT_EQ(contents().error().message,
            path().string() + ": the catalogue is not what was written: objects are missing or there are too many");
}

TEST_F(StoreDamage, a_lost_table_is_an_error) {
  let_everything();
  sql("DROP TABLE " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'"));
  EXPECT_EQ(contents().error().code, ErrorCode::database_corrupt);
}

}  // namespace
}  // namespace queries
