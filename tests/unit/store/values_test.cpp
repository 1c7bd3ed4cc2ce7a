// What is stored comes back: values of every type, relations of them, functions, names.
#include <bit>
#include <limits>

#include "algebra3d/values/types/codec.h"
#include "queries/store/stored_form.h"
#include "unit/store/store_fixture.h"

namespace queries {
namespace {

class StoredValues : public StoreTest {
 protected:
  StoredValues() { reopen(); }
};

const std::vector<std::pair<std::string, std::string>> kValues = {
    {"int", "-2147483648"},
    {"int", "2147483647"},
    {"int", "9223372036854775807"},
    {"int", "-9223372036854775808"},
    {"int", "undefined"},
    {"real", "0.1"},
    {"real", "-0.0"},
    {"real", "5e-324"},
    {"real", "3.0"},
    {"real", "undefined"},
    {"bool", "TRUE"},
    {"bool", "FALSE"},
    {"bool", "undefined"},
    {"string", "\"\""},
    {"string", "\"M\xc3\xbcller 'n' co\""},
    {"string", "undefined"},
    {"text", "'two\nlines'"},
    {"text", "undefined"},
    {"bytes", "'00ff27'"},
    {"bytes", "''"},
    {"bytes", "undefined"},
    {"point3d", "(0.1 -0.0 1e+300)"},
    {"point3d", "(1/3 2.0 -7/9)"},
    {"point3d", "undefined"},
    {"vector3d", "(1.0 2.0 3.0)"},
    {"vector3d", "undefined"},
    {"plane3d", "(1.0 0.0 0.0 2.0)"},
    {"plane3d", "undefined"},
    {"rect3", "(0.0 1.0 -2.0 2.0 3.0 3.0)"},
    {"rect3", "undefined"},
    {"points3d", "()"},
    {"points3d", "((0.0 0.0 0.0) (1/3 0.0 0.0) (1.0 0.0 0.0))"},
    {"points3d", "undefined"},
    {"surface3d", "()"},
    {"surface3d", "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0)))"},
    {"surface3d", "undefined"},
    {"volume3d", "()"},
    {"volume3d", "undefined"},
};

TEST_F(StoredValues, objects_of_every_type_come_back_after_reopening) {
  write([&] {
    for (std::size_t i = 0; i < kValues.size(); ++i) {
      const auto& [type_name, list] = kValues[i];
      const std::string name = "o" + std::to_string(i);
      ok(store_->create(name, TypeExpr(type_name)));
      ok(store_->assign(name, Datum{value(type_name, list)}, context_));
    }
  });
  reopen(OpenMode::read_write);
  read([&] {
    for (std::size_t i = 0; i < kValues.size(); ++i) {
      const auto datum = store_->read("o" + std::to_string(i));
      ASSERT_TRUE(datum.ok()) << datum.error().text();
      EXPECT_EQ(datum->value().type().name(), kValues[i].first);
      EXPECT_EQ(text(datum->value()), text(value(kValues[i].first, kValues[i].second)));
    }
  });
}

TEST_F(StoredValues, attributes_of_every_type_come_back_after_reopening) {
  std::string tuple_type = "(tuple (";
  for (std::size_t i = 0; i < kValues.size(); ++i) tuple_type += fmt::format("(A{} {})", i, kValues[i].first);
  tuple_type += "))";
  Tuple undefined;
  for (const auto& each : kValues) undefined.attributes.push_back(value(each.first, "undefined"));
  write([&] { let_relation("All", tuple_type, {tuple(kValues), undefined}); });
  reopen(OpenMode::read_write);
  read([&] {
    const auto stored = tuples(*relation("All"));
    ASSERT_EQ(stored.size(), 2U);
    for (std::size_t i = 0; i < kValues.size(); ++i) {
      EXPECT_EQ(text(stored[0]->attributes[i]), text(value(kValues[i].first, kValues[i].second)));
      EXPECT_FALSE(stored[1]->attributes[i].is_defined());
    }
  });
}

TEST_F(StoredValues, the_sign_of_zero_and_bytes_of_zero_survive) {
  write([&] {
    Tuple row;
    row.attributes = {Value::of(-0.0), Value::of(std::string("a\0b", 3)),
                      Value::of(algebra3d::Text{std::string(1, '\0')})};
    let_relation("R", "(tuple ((A real) (B string) (C text)))", {row});
  });
  reopen(OpenMode::read_write);
  read([&] {
    const auto stored = tuples(*relation("R"));
    ASSERT_EQ(stored.size(), 1U);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(stored[0]->attributes[0].get<double>()), std::uint64_t{1} << 63);
    EXPECT_EQ(stored[0]->attributes[1].get<std::string>(), std::string("a\0b", 3));
    EXPECT_EQ(stored[0]->attributes[2].get<algebra3d::Text>().content, std::string(1, '\0'));
  });
}

TEST_F(StoredValues, names_that_differ_in_case_are_different) {
  write([&] {
    for (const std::string name : {"cube", "Cube", "CUBE"}) {
      ok(store_->create(name, "string"));
      ok(store_->assign(name, Datum{Value::of(name)}, context_));
    }
    let_relation("r", "(tuple ((A int) (a int)))", {tuple({{"int", "1"}, {"int", "2"}})});
    let_relation("R", "(tuple ((a int) (A int)))", {tuple({{"int", "3"}, {"int", "4"}})});
  });
  reopen(OpenMode::read_write);
  read([&] {
    for (const std::string name : {"cube", "Cube", "CUBE"})
      EXPECT_EQ(store_->read(name)->value().get<std::string>(), name);
    EXPECT_EQ(rows("r"), std::vector<std::string>{"1 2"});
    EXPECT_EQ(rows("R"), std::vector<std::string>{"3 4"});
    EXPECT_FALSE(store_->find("cUBE")->has_value());
  });
}

TEST_F(StoredValues, functions_keep_their_text_and_objects_their_types) {
  const TypeExpr function = type("(map int real)");
  write([&] {
    ok(store_->create_function("half", function, "fun(x: int) x * 0.5"));
    ok(store_->create("later", "volume3d"));
  });
  reopen(OpenMode::read_write);
  const auto info = store_->objects();
  ASSERT_TRUE(info.ok());
  ASSERT_EQ(info->size(), 2U);
  EXPECT_EQ((*info)[0].name, "half");
  EXPECT_EQ((*info)[0].function_text, "fun(x: int) x * 0.5");
  EXPECT_TRUE((*info)[0].type == function);
  EXPECT_FALSE((*info)[1].has_value);
  read([&] {
    const auto later = store_->read("later");
    ASSERT_FALSE(later.ok());
    EXPECT_EQ(later.error().code, ErrorCode::not_evaluable);
    EXPECT_EQ(later.error().text(), "the object 'later' has no value yet; give it one with update");
  });
}

TEST_F(StoredValues, a_name_is_given_once_and_free_again_after_removal) {
  write([&] {
    ok(store_->create("x", "int"));
    const auto again = store_->create("x", "real");
    ASSERT_FALSE(again.ok());
    EXPECT_EQ(again.error().code, ErrorCode::name_exists);
    ok(store_->remove("x"));
    ok(store_->create("x", "real"));
    EXPECT_EQ(store_->remove("y").error().text(), "there is no object 'y'");
    EXPECT_EQ(store_->create("s", type("(stream int)")).error().code, ErrorCode::type_error);
    EXPECT_EQ(store_->create("r", type("(rel (tuple ((A (stream int)))))")).error().code, ErrorCode::type_error);
  });
}

TEST_F(StoredValues, values_beyond_the_limit_of_a_row_are_cut_and_joined) {
  const StoreOptions tiny{.inline_bytes = 200, .chunk_bytes = 70};
  reopen(OpenMode::open_or_create, tiny);
  write([&] {
    let_relation("R", "(tuple ((A volume3d) (B points3d)))",
                 {tuple({{"volume3d", solid(1)}, {"points3d", "((1.0 2.0 3.0))"}}),
                  tuple({{"volume3d", solid(2)}, {"points3d", "((4.0 5.0 6.0))"}})});
    ok(store_->create("v", "volume3d"));
    ok(store_->assign("v", Datum{value("volume3d", solid(3))}, context_));
  });
  EXPECT_NE(sql("SELECT count(*) FROM chunks"), "0");
  reopen(OpenMode::read_write);
  read([&] {
    EXPECT_EQ(rows("R"), (std::vector<std::string>{text(value("volume3d", solid(1))) + " ((1.0 2.0 3.0))",
                                                   text(value("volume3d", solid(2))) + " ((4.0 5.0 6.0))"}));
    EXPECT_EQ(text(store_->read("v")->value()), text(value("volume3d", solid(3))));
  });
  write([&] {
    ok(relation("R")->erase(1));
    ok(store_->remove("v"));
    ok(store_->remove("R"));
  });
  EXPECT_EQ(sql("SELECT count(*) FROM chunks"), "0");
}

TEST_F(StoredValues, other_clients_read_numbers_boxes_and_texts) {
  write([&] {
    let_relation("Parts", "(tuple ((Name string) (Solid volume3d) (Weight real)))",
                 {tuple({{"string", "\"bolt\""}, {"volume3d", solid(5)}, {"real", "2.5"}})});
  });
  const std::string table = sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_Parts'");
  EXPECT_EQ(sql("SELECT a1_Name FROM " + table), "bolt");
  EXPECT_EQ(sql("SELECT a3_Weight FROM " + table), "2.5");
  EXPECT_EQ(sql("SELECT a2_Solid_minx || ' ' || a2_Solid_maxx || ' ' || a2_Solid_size FROM " + table), "5.0 6.0 4");
  EXPECT_EQ(sql("PRAGMA integrity_check"), "ok");
}

TEST_F(StoredValues, imported_files_are_known_by_path_size_and_hash) {
  write([&] {
    let_parts(1);
    ok(store_->remember_imported("Parts", {"a/b.stl", 10, 0xffffffffffffffffU}));
  });
  reopen(OpenMode::read_write);
  EXPECT_TRUE(*store_->is_imported("Parts", {"a/b.stl", 10, 0xffffffffffffffffU}));
  EXPECT_FALSE(*store_->is_imported("Parts", {"a/b.stl", 11, 0xffffffffffffffffU}));
  EXPECT_FALSE(*store_->is_imported("Parts", {"a/b.stl", 10, 0}));
  write([&] {
    ok(store_->remove("Parts"));
    let_parts(1);
  });
  EXPECT_FALSE(*store_->is_imported("Parts", {"a/b.stl", 10, 0xffffffffffffffffU}));
}

TEST_F(StoredValues, tables_that_were_pulled_are_remembered_with_their_relation) {
  const auto pulled = [&] {
    std::string text;
    const auto tables = store_->pulled_tables("Parts");
    EXPECT_TRUE(tables.ok());
    for (const Store::PulledTable& each : *tables)
      text += fmt::format("{} {} {} {:x};", each.source, each.place, each.count, each.checksum);
    return text;
  };
  write([&] { let_parts(1); });
  EXPECT_EQ(pulled(), "");  // also without the table
  write([&] {
    ok(store_->remember_pulled("Parts", {"d.s.t", "(0,1)", 1, 5}));
    ok(store_->remember_pulled("Parts", {"d.s.u", "(7,3)", 2, 0xffffffffffffffffU}));
    ok(store_->remember_pulled("Parts", {"d.s.t", "(1,9)", 3, 6}));
  });
  reopen(OpenMode::read_write);
  EXPECT_EQ(pulled(), "d.s.t (1,9) 3 6;d.s.u (7,3) 2 ffffffffffffffff;");
  write([&] {
    ok(store_->remove("Parts"));
    let_parts(1);
  });
  EXPECT_EQ(pulled(), "");
  EXPECT_EQ(sql("SELECT count(*) FROM pulled_tables"), "0");
}

TEST_F(StoredValues, a_value_is_written_in_the_form_that_it_came_in) {
  const Value cube = value("volume3d", solid(1));
  const std::string form = algebra3d::encode(cube);
  EXPECT_EQ(*stored_form(cube), form);
  EXPECT_EQ(*stored_form(with_form(cube, form)), form);
  // What is in the file is copied: bytes that no encoding gives stay.
  write([&] { let_relation("R", "(tuple ((Solid volume3d)))", {Tuple{{with_form(cube, form + "x")}, 0}}); });
  EXPECT_EQ(sql("SELECT length(a1_Solid) FROM " + sql("SELECT name FROM sqlite_schema WHERE name LIKE 'rel_%_R'")),
            std::to_string(form.size() + 1));
  read([&] {
    const Datum datum = *store_->read("R");
    const auto tuples = *datum.relation()->scan();
    const Value stored = (*tuples->next())->attributes[0];
    ASSERT_TRUE(stored.is_deferred());
    EXPECT_EQ(*stored_form(stored), form + "x");
  });
}

}  // namespace
}  // namespace queries
