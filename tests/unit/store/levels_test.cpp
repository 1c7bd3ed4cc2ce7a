// Levels of detail beside stored values: found for the very bytes they were made of, and for no others.
#include "queries/store/levels.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include "algebra3d/values/types/face_blocks.h"
#include "base/interruption_scope.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class Levels : public StoreTest {
 protected:
  Levels() {
    reopen();
    write([&] { let_parts(3); });
  }

  /// The solid of a stored part. Call within a statement.
  Value solid_of(int number) {
    const RelationPtr parts = relation("Parts");
    return tuples(*parts)[static_cast<std::size_t>(number)]->attributes[1];
  }
  static std::string level(const Value& value, std::uint64_t number) {
    const auto found = level_of(value, number);
    EXPECT_TRUE(found.ok()) << (found ? "" : found.error().text());
    return found && *found ? **found : "nothing";
  }
  static bool keep(const Value& value, std::uint64_t number, std::string_view bytes) {
    const auto kept = keep_level(value, number, bytes);
    EXPECT_TRUE(kept.ok()) << (kept ? "" : kept.error().text());
    return kept && *kept;
  }
  /// Keeps a level of each part.
  void keep_levels() {
    read([&] {
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(keep(solid_of(i), 20000, "level of part " + std::to_string(i)));
    });
  }
  std::vector<std::string> findings() {
    std::vector<std::string> texts;
    read([&] {
      const auto found = store_->check(context_, {});
      ASSERT_TRUE(found.ok()) << found.error().text();
      for (const Finding& each : *found) texts.push_back(each.text());
    });
    return texts;
  }
  // From 2^62 on the numbers are those of face blocks.
  std::string level_count() { return sql("SELECT count(*) FROM shape_levels WHERE number < 4611686018427387904"); }
  std::string block_count() { return sql("SELECT count(*) FROM shape_levels WHERE number >= 4611686018427387904"); }

  /// Whether nothing was kept yet: the table is made for what is kept first.
  bool has_no_blocks() { return sql("SELECT count(*) FROM sqlite_master WHERE name = 'shape_levels'") == "0"; }

  /// A sphere that is stored in some hundred kilobytes.
  Value large_solid() {
    constexpr std::uint32_t kRings = 300, kColumns = 600;
    std::vector<algebra3d::Vec3> points;
    for (std::uint32_t i = 1; i < kRings; ++i)
      for (std::uint32_t j = 0; j < kColumns; ++j) {
        const double a = std::numbers::pi * i / kRings, b = 2 * std::numbers::pi * j / kColumns;
        points.push_back({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
      }
    const auto top = static_cast<std::uint32_t>(points.size());
    points.push_back({0, 0, 1});
    points.push_back({0, 0, -1});
    const auto at = [](std::uint32_t i, std::uint32_t j) { return (i - 1) * kColumns + j % kColumns; };
    std::vector<algebra3d::TriangleMesh::Triangle> triangles;
    for (std::uint32_t j = 0; j < kColumns; ++j) {
      triangles.push_back({top, at(1, j), at(1, j + 1)});
      triangles.push_back({top + 1, at(kRings - 1, j + 1), at(kRings - 1, j)});
      for (std::uint32_t i = 1; i + 1 < kRings; ++i) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
    return Value::of(algebra3d::Volume3d::trusted({algebra3d::PointArray(std::move(points)), triangles}));
  }
  void let_object(const std::string& name, const Value& value) {
    ok(store_->create(name, TypeExpr(std::string(value.type().name()))));
    ok(store_->assign(name, Datum{value}, context_));
  }
  Value object(const std::string& name) {
    const auto datum = store_->read(name);
    EXPECT_TRUE(datum.ok()) << (datum ? "" : datum.error().text());
    return datum->value();
  }
};

TEST_F(Levels, are_found_again_after_reopening) {
  read([&] { EXPECT_EQ(level(solid_of(0), 20000), "nothing"); });
  keep_levels();
  reopen(OpenMode::read_write);
  read([&] {
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(is_stored(solid_of(i)));
      EXPECT_EQ(level(solid_of(i), 20000), "level of part " + std::to_string(i));
      EXPECT_EQ(level(solid_of(i), 200000), "nothing");
    }
  });
  EXPECT_EQ(store_->geometry_loads(), 0U) << "without loading the values";
  EXPECT_EQ(findings(), std::vector<std::string>());
}

TEST_F(Levels, are_replaced) {
  keep_levels();
  read([&] {
    EXPECT_TRUE(keep(solid_of(1), 20000, "a better one"));
    EXPECT_TRUE(keep(solid_of(1), 200000, "a finer one"));
    EXPECT_EQ(level(solid_of(1), 20000), "a better one");
    EXPECT_EQ(level(solid_of(1), 200000), "a finer one");
    EXPECT_EQ(level(solid_of(0), 20000), "level of part 0");
  });
}

/// As a server does it: the result of a statement is held while another connection writes.
TEST_F(Levels, are_kept_beside_a_held_transaction_and_a_later_writer) {
  ok(store_->begin(false));
  const Value held = solid_of(0);
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(true));
  ok(other->create("n", TypeExpr("int")));
  ok(other->commit());
  EXPECT_TRUE(keep(held, 1, "kept"));
  EXPECT_EQ(level(held, 1), "kept") << "although its transaction is older";
  ok(store_->commit());
  EXPECT_EQ(level(held, 1), "kept") << "after its end, too";
}

TEST_F(Levels, are_not_kept_while_another_writes) {
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(true));
  read([&] { EXPECT_FALSE(keep(solid_of(0), 1, "kept")); });
  ok(other->commit());
}

TEST_F(Levels, go_with_their_tuples) {
  keep_levels();
  EXPECT_EQ(level_count(), "3");
  write([&] {
    const RelationPtr parts = relation("Parts");
    ok(parts->erase(2));
  });
  EXPECT_EQ(level_count(), "2");
  write([&] { ok(store_->remove("Parts")); });
  EXPECT_EQ(level_count(), "0");
  EXPECT_EQ(findings(), std::vector<std::string>());
}

TEST_F(Levels, go_when_the_value_changes_and_stay_when_another_attribute_does) {
  keep_levels();
  write([&] {
    const RelationPtr parts = relation("Parts");
    Tuple first = *tuples(*parts)[0];
    first.attributes[0] = value("int", "77");
    ok(parts->update(1, first));
    Tuple second = *tuples(*parts)[1];
    second.attributes[1] = value("volume3d", solid(5));
    ok(parts->update(2, second));
  });
  EXPECT_EQ(level_count(), "2");
  read([&] {
    EXPECT_EQ(level(solid_of(0), 20000), "level of part 0");
    EXPECT_EQ(level(solid_of(1), 20000), "nothing");
  });
}

TEST_F(Levels, stay_when_the_relation_is_renamed_and_when_a_change_is_undone) {
  keep_levels();
  write([&] { ok(store_->rename("Parts", "Pieces")); });
  write([&] { ok(store_->rename("Pieces", "Parts")); });
  ok(store_->begin(true));
  ok(relation("Parts")->erase(1));
  store_->rollback();
  read([&] {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(level(solid_of(i), 20000), "level of part " + std::to_string(i));
  });
}

/// A program that knows of no levels removes and changes values: then there are levels of other values.
TEST_F(Levels, of_other_values_are_not_found) {
  keep_levels();
  sql("UPDATE shape_levels SET tuple = tuple + 10");
  read([&] { EXPECT_EQ(level(solid_of(0), 20000), "nothing"); });
  sql("UPDATE shape_levels SET tuple = 2 WHERE tuple = 11");
  read([&] { EXPECT_EQ(level(solid_of(1), 20000), "nothing"); });
  EXPECT_EQ(findings(), std::vector<std::string>()) << "left over is not a defect";
}

TEST_F(Levels, of_a_value_that_is_gone_are_not_kept) {
  ok(store_->begin(false));
  const Value held = solid_of(0);
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(true));
  ok(other->remove("Parts"));
  ok(other->commit());
  EXPECT_FALSE(keep(held, 1, "too late"));
  ok(store_->commit());
}

TEST_F(Levels, that_are_damaged_are_not_found_and_reported) {
  keep_levels();
  sql("UPDATE shape_levels SET bytes = CAST('other' AS BLOB) WHERE tuple = 1");
  read([&] {
    EXPECT_EQ(level(solid_of(0), 20000), "nothing");
    EXPECT_EQ(level(solid_of(1), 20000), "level of part 1");
  });
  const auto found = findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].substr(0, found[0].find("owner")),
            "the table shape_levels, which holds levels of detail: the level 20000 of ");
}

TEST_F(Levels, of_files_that_cannot_be_written_are_read) {
  keep_levels();
  reopen(OpenMode::read_only);
  read([&] {
    EXPECT_EQ(level(solid_of(2), 20000), "level of part 2");
    EXPECT_FALSE(keep(solid_of(2), 1, "no"));
  });
  store_.reset();
  std::filesystem::permissions(path(), std::filesystem::perms::owner_read);
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  reopen(OpenMode::read_only);
  read([&] { EXPECT_EQ(level(solid_of(2), 20000), "level of part 2"); });
}

TEST_F(Levels, can_be_asked_for_by_several_threads) {
  keep_levels();
  read([&] {
    const Value first = solid_of(0), second = solid_of(1);
    std::atomic<int> right = 0;
    const auto ask = [&](const Value& value, const std::string& expected) {
      for (int i = 0; i < 20; ++i) right += level(value, 20000) == expected ? 1 : 0;
    };
    std::thread other(ask, first, "level of part 0");
    ask(second, "level of part 1");
    other.join();
    EXPECT_EQ(right, 40);
  });
}

TEST_F(Levels, of_values_in_memory_are_nothing) {
  const Value made = value("volume3d", solid(0));
  EXPECT_FALSE(is_stored(made));
  EXPECT_EQ(level(made, 1), "nothing");
  EXPECT_FALSE(keep(made, 1, "no"));
}

/// Large objects are read when their geometry is needed; before, box and number of triangles are known.
TEST_F(Levels, of_large_objects) {
  const Value solid = large_solid();
  write([&] {
    let_object("sphere", solid);
    let_object("small", value("volume3d", this->solid(0)));
  });
  reopen(OpenMode::read_write);
  read([&] {
    EXPECT_FALSE(is_stored(object("small"))) << "read at once";
    const Value sphere = object("sphere");
    ASSERT_TRUE(is_stored(sphere));
    EXPECT_EQ(sphere.header().size, solid.header().size);
    EXPECT_EQ(sphere.header().box, solid.header().box);
    EXPECT_TRUE(keep(sphere, 20000, "coarse"));
    const auto loaded = sphere.loaded();
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(compare(*loaded, solid), std::strong_ordering::equal);
    const auto restored = sphere.deferred()->source()->value(std::string(1, '\0'));
    EXPECT_EQ(compare(*restored.loaded(), solid), std::strong_ordering::equal);
  });
  reopen(OpenMode::read_write);
  read([&] { EXPECT_EQ(level(object("sphere"), 20000), "coarse"); });
  EXPECT_EQ(level_count(), "1");
  write([&] { ok(store_->assign("sphere", Datum{value("volume3d", this->solid(1))}, context_)); });
  EXPECT_EQ(level_count(), "0");
}

std::string found_text(const Result<std::shared_ptr<const algebra3d::FaceBlocks>>& found) {
  return !found ? found.error().text() : *found == nullptr ? "none" : "blocks";
}

TEST_F(Levels, face_blocks_are_written_at_the_end_of_a_statement_that_asks_and_go_with_their_object) {
  const Value solid = large_solid();
  write([&] { let_object("sphere", solid); });
  EXPECT_TRUE(has_no_blocks());
  reopen(OpenMode::read_only);
  read([&] { EXPECT_EQ(found_text(object("sphere").deferred()->face_blocks()), "none"); });
  EXPECT_TRUE(has_no_blocks());
  reopen(OpenMode::read_write);
  read([&] { EXPECT_EQ(found_text(object("sphere").deferred()->face_blocks()), "none"); });
  const std::size_t blocks = (solid.header().size + algebra3d::kFacesOfBlock - 1) / algebra3d::kFacesOfBlock;
  EXPECT_GT(std::stoul(block_count()), blocks) << "with their list";
  EXPECT_LT(std::stoul(block_count()), 4 * blocks);
  EXPECT_EQ(findings(), std::vector<std::string>());
  reopen(OpenMode::read_write);
  read([&] {
    const auto found = object("sphere").deferred()->face_blocks();
    ASSERT_EQ(found_text(found), "blocks");
    const std::vector<std::uint32_t> some{3, 5};
    const auto faces = (*found)->faces(some);
    ASSERT_TRUE(faces.ok()) << faces.error().text();
    EXPECT_EQ(faces->face_count(), (*found)->face_count(some));
    EXPECT_GT(faces->face_count(), 0U);
    EXPECT_EQ(store_->faces_in_blocks(), faces->face_count());
    const Value loaded_before = object("sphere");
    ASSERT_TRUE(loaded_before.loaded().ok());
    EXPECT_EQ(found_text(loaded_before.deferred()->face_blocks()), "none");
  });
  write([&] { ok(store_->assign("sphere", Datum{value("volume3d", this->solid(1))}, context_)); });
  EXPECT_EQ(block_count(), "0");
}

TEST_F(Levels, face_blocks_that_are_interrupted_are_made_by_the_next_statement_that_asks) {
  write([&] { let_object("sphere", large_solid()); });
  reopen(OpenMode::read_write);
  std::atomic<bool> interrupted = false;
  const algebra3d::InterruptionScope scope(&interrupted);
  const auto ask = [&] { return found_text(object("sphere").deferred()->face_blocks()); };
  read([&] {
    EXPECT_EQ(ask(), "none");
    interrupted = true;
  });
  interrupted = false;
  EXPECT_TRUE(has_no_blocks());
  read([&] { EXPECT_EQ(ask(), "none"); });
  read([&] { EXPECT_EQ(ask(), "blocks"); });
}

TEST_F(Levels, damaged_face_blocks_are_errors) {
  write([&] { let_object("sphere", large_solid()); });
  reopen(OpenMode::read_write);
  read([&] { static_cast<void>(object("sphere").deferred()->face_blocks()); });
  const auto with_damage = [&](const std::string& statement) {
    store_.reset();
    sql(statement);
    reopen(OpenMode::read_write);
    std::string text;
    read([&] {
      const auto found = object("sphere").deferred()->face_blocks();
      const std::vector<std::uint32_t> first{0};
      if (!found) text = found.error().text();
      if (!found || *found == nullptr) return;
      const auto faces = (*found)->faces(first);
      text = faces ? "read" : faces.error().text();
    });
    return text;
  };
  EXPECT_EQ(with_damage("SELECT 1"), "read");
  EXPECT_NE(with_damage("UPDATE shape_levels SET bytes = zeroblob(9) WHERE number = 4611686018427387905")
                .find("a level of detail, or a block of faces, is not what was written"),
            std::string::npos);
  ASSERT_EQ(findings().size(), 1U);
  EXPECT_NE(findings()[0].find("the face block 4611686018427387905 of owner 0"), std::string::npos) << findings()[0];
  EXPECT_NE(with_damage("DELETE FROM shape_levels WHERE number = 4611686018427387905").find("is missing"),
            std::string::npos);
  EXPECT_NE(with_damage("UPDATE shape_levels SET bytes = zeroblob(9) WHERE number = 4611686018427387904")
                .find("a level of detail, or a block of faces, is not what was written"),
            std::string::npos);
}

TEST_F(Levels, a_large_object_can_be_its_own_new_value) {
  const Value solid = large_solid();
  write([&] { let_object("sphere", solid); });
  reopen(OpenMode::read_write);
  write([&] {
    const Value sphere = object("sphere");
    ok(store_->assign("sphere", Datum{sphere}, context_));
    let_object("copy", object("sphere"));
  });
  read([&] { EXPECT_EQ(compare(*object("copy").loaded(), solid), std::strong_ordering::equal); });
}

TEST_F(Levels, a_large_object_is_not_read_after_its_statement) {
  write([&] { let_object("sphere", large_solid()); });
  reopen(OpenMode::read_write);
  std::optional<Value> late, early;
  read([&] {
    late = object("sphere");
    early = object("sphere");
    ASSERT_TRUE(early->loaded().ok());
  });
  ASSERT_FALSE(late->loaded().ok());
  EXPECT_EQ(late->loaded().error().code, ErrorCode::internal);
  EXPECT_TRUE(early->loaded().ok()) << "it was loaded before";
}

TEST_F(Levels, damage_of_a_large_object_is_found_when_it_is_loaded) {
  write([&] { let_object("sphere", large_solid()); });
  store_.reset();
  sql("UPDATE object_values SET value = CAST(substr(value, 1, length(value) - 1) || 'x' AS BLOB)");
  reopen(OpenMode::read_write);
  read([&] {
    const auto loaded = object("sphere").loaded();
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().text(), "sphere: the stored value is not what was written");
  });
}

}  // namespace
}  // namespace queries
