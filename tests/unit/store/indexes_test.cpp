// R-tree objects: definitions follow their relation, frozen copies do not.
#include <random>
#include <set>

#include "unit/store/store_fixture.h"

namespace queries {
namespace {

using algebra3d::Box3;

class StoredIndexes : public StoreTest {
 protected:
  StoredIndexes() { reopen(); }

  Tuple box_tuple(const Box3& box) {
    Tuple result;
    result.attributes = {Value::of(box)};
    return result;
  }
  Box3 random_box() {
    std::uniform_real_distribution<double> place(0, 100);
    const algebra3d::Vec3 corner{place(random_), place(random_), place(random_)};
    return {corner, corner + algebra3d::Vec3{3, 3, 3}};
  }
  void let_boxes(int count) {
    std::vector<Tuple> content;
    for (int i = 0; i < count; ++i) content.push_back(box_tuple(random_box()));
    content.push_back(tuple({{"rect3", "undefined"}}));
    let_relation("R", "(tuple ((B rect3)))", content);
    let_index("I", "R", "B", "rect3");
  }
  /// The tree of an index.
  static SpatialIndex::Tree& tree_of(const SpatialIndex& index) {
    const auto tree = index.tree();
    EXPECT_TRUE(tree.ok()) << (tree ? "" : tree.error().text());
    return **tree;
  }
  /// The index gives for random windows what a scan gives.
  void expect_index_equals_scan(Store& store, const std::string& name = "I") {
    const auto stored = tuples(*store.read("R")->relation());
    const auto index = store.read(name)->index();
    EXPECT_TRUE(rtree::audit(tree_of(*index)).empty());
    for (int i = 0; i < 20; ++i) {
      Box3 window = random_box();
      window.extend(random_box());
      std::set<std::uint64_t> expected;
      for (const TuplePtr& each : stored)
        if (each->attributes[0].is_defined() && each->attributes[0].get<Box3>().intersects(window))
          expected.insert(static_cast<std::uint64_t>(each->id));
      std::set<std::uint64_t> found;
      for (const std::uint64_t id : tree_of(*index).window(window)) found.insert(id);
      EXPECT_EQ(found, expected);
    }
  }

  std::mt19937 random_{7};
};

TEST_F(StoredIndexes, a_definition_follows_inserts_updates_deletes_and_rollback) {
  write([&] { let_boxes(300); });
  read([&] { expect_index_equals_scan(*store_); });
  write([&] {
    for (int i = 0; i < 50; ++i) {
      ASSERT_TRUE(relation("R")->insert(box_tuple(random_box())).ok());
      ok(relation("R")->erase(2 * i + 1));
      ok(relation("R")->update(2 * i + 2, box_tuple(random_box())));
    }
    ok(relation("R")->update(200, tuple({{"rect3", "undefined"}})));
    expect_index_equals_scan(*store_);
  });
  read([&] { expect_index_equals_scan(*store_); });
  ok(store_->begin(true));
  for (int i = 0; i < 50; ++i) ok(relation("R")->erase(200 + i));
  expect_index_equals_scan(*store_);
  store_->rollback();
  read([&] { expect_index_equals_scan(*store_); });
  reopen(OpenMode::read_write);
  read([&] { expect_index_equals_scan(*store_); });
}

TEST_F(StoredIndexes, a_definition_follows_the_changes_of_another_process) {
  write([&] { let_boxes(100); });
  const auto other = opened(OpenMode::read_write);
  ok(other->begin(false));
  expect_index_equals_scan(*other);
  ok(other->commit());
  write([&] {
    for (int i = 1; i < 60; ++i) ok(relation("R")->erase(i));
  });
  ok(other->begin(false));
  expect_index_equals_scan(*other);
  ok(other->commit());
}

TEST_F(StoredIndexes, a_definition_follows_an_update_of_the_whole_relation) {
  write([&] { let_boxes(50); });
  read([&] { expect_index_equals_scan(*store_); });
  write([&] {
    std::vector<TuplePtr> content;
    for (int i = 0; i < 20; ++i) content.push_back(std::make_shared<const Tuple>(box_tuple(random_box())));
    const auto made = std::make_shared<MemoryRelation>(relation("R")->tuple_type(), TupleBuffer(content));
    ok(store_->assign("R", Datum{RelationPtr(made)}, context_));
    expect_index_equals_scan(*store_);
  });
  read([&] { expect_index_equals_scan(*store_); });
}

TEST_F(StoredIndexes, a_tree_in_use_does_not_change_under_its_user) {
  write([&] { let_boxes(100); });
  write([&] {
    const auto held = *index("I")->tree();
    const std::size_t before = held->size();
    auto cursor = held->window({{0, 0, 0}, {200, 200, 200}});
    std::size_t seen = 0;
    while (cursor.next()) {
      ok(relation("R")->erase(static_cast<TupleId>(++seen)));
    }
    EXPECT_EQ(seen, before);
    EXPECT_EQ(tree_of(*index("I")).size(), 0U);
  });
}

TEST_F(StoredIndexes, a_definition_goes_with_its_relation) {
  write([&] { let_boxes(5); });
  write([&] { ok(store_->remove("R")); });
  reopen(OpenMode::read_write);
  EXPECT_TRUE(store_->objects()->empty());
}

TEST_F(StoredIndexes, building_an_index_reads_no_geometry) {
  write([&] {
    let_parts(200);
    let_index("I", "Parts", "Solid", "volume3d");
  });
  reopen(OpenMode::read_write);
  read([&] {
    std::set<std::uint64_t> found;
    for (const std::uint64_t id : tree_of(*index("I")).window({{95, 0, 0}, {120, 1, 1}})) found.insert(id);
    EXPECT_EQ(found, (std::set<std::uint64_t>{11, 12, 13}));
    EXPECT_EQ(store_->geometry_loads(), 0U);
  });
}

TEST_F(StoredIndexes, a_frozen_copy_stays_as_it_was) {
  auto tree = std::make_shared<SpatialIndex::Tree>();
  for (std::uint64_t id = 1; id <= 1000; ++id) tree->insert(random_box(), id);
  std::set<std::uint64_t> expected;
  const Box3 window{{0, 0, 0}, {50, 50, 50}};
  for (const std::uint64_t id : tree->window(window)) expected.insert(id);
  write([&] {
    const TypeExpr tuple_type = type("(tuple ((B rect3)))");
    ok(store_->create("F", TypeExpr("rtree3", {tuple_type, "rect3", "FALSE"})));
    ok(store_->assign("F", Datum{std::make_shared<SpatialIndex>("", "B", tree)}, context_));
  });
  reopen(OpenMode::read_write);
  read([&] {
    const auto frozen = index("F");
    EXPECT_FALSE(frozen->is_definition());
    EXPECT_EQ(tree_of(*frozen).size(), 1000U);
    EXPECT_TRUE(rtree::audit(tree_of(*frozen)).empty());
    std::set<std::uint64_t> found;
    for (const std::uint64_t id : tree_of(*frozen).window(window)) found.insert(id);
    EXPECT_EQ(found, expected);
  });
}

}  // namespace
}  // namespace queries
