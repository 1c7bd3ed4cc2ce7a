#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "queries/store/detail/checked_vfs.h"
#include "queries/store/store_options.h"
#include "queries/streams/relation.h"

namespace queries {

using algebra3d::Context;
using algebra3d::Diagnostics;
using algebra3d::NestedList;

/// A database in a folder of its own, with what tests do to it. Everything that must go right is expected here.
class StoreTest : public testing::Test {
 protected:
  StoreTest() {
    std::string name = (std::filesystem::temp_directory_path() / "store_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
    for (const algebra3d::Type* type : algebra3d::all_types()) registry_.add(*type);
  }
  ~StoreTest() override {
    store_.reset();
    std::error_code ignored;
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path path(std::string_view name = "test.db") const { return folder_ / name; }

  std::unique_ptr<Store> opened(OpenMode mode = OpenMode::open_or_create, const StoreOptions& options = {}) {
    auto store = open_store(path(), mode, registry_, options);
    EXPECT_TRUE(store.ok()) << (store ? "" : store.error().text());
    return store ? *std::move(store) : nullptr;
  }
  void reopen(OpenMode mode = OpenMode::open_or_create, const StoreOptions& options = {}) {
    store_.reset();
    store_ = opened(mode, options);
    ASSERT_NE(store_, nullptr);
  }
  /// The error that opening gives.
  Error open_error(const std::filesystem::path& file, OpenMode mode) {
    const auto store = Store::open(file, mode, registry_);
    EXPECT_FALSE(store.ok());
    return store ? Error(ErrorCode::internal, "opened") : store.error();
  }

  Value value(std::string_view type, std::string_view text) {
    const algebra3d::Type* const known = registry_.find_type(type);
    EXPECT_NE(known, nullptr) << type;
    const auto list = NestedList::parse(text);
    EXPECT_TRUE(list.ok()) << text;
    auto read = algebra3d::value_from_nested(*known, *list, context_);
    EXPECT_TRUE(read.ok()) << text;
    return *read;
  }
  static TypeExpr type(std::string_view text) { return *TypeExpr::from_nested(*NestedList::parse(text)); }

  static std::string text(const Value& value) {
    const auto loaded = value.loaded();
    return loaded ? loaded->to_nested().print() : loaded.error().text();
  }
  static std::string text(const Tuple& tuple) {
    std::string result;
    for (const Value& each : tuple.attributes) result += (result.empty() ? "" : " ") + text(each);
    return result;
  }

  /// Runs `work(store)` as one statement that writes.
  template <typename Work>
  void write(Work work) {
    ok(store_->begin(true));
    work();
    ok(store_->commit());
  }
  /// Pages that `work`, as a statement that writes, appends to the log.
  template <typename Work>
  std::uintmax_t logged_pages(Work work) {
    const auto log = path().string() + "-wal";
    const auto before = std::filesystem::exists(log) ? std::filesystem::file_size(log) : 0;
    write(work);
    constexpr std::uintmax_t kFrameBytes = 4096 + 24;
    return (std::filesystem::file_size(log) - before) / kFrameBytes;
  }
  /// Runs `work(store)` as one statement that reads at first.
  template <typename Work>
  void read(Work work) {
    ok(store_->begin(false));
    work();
    ok(store_->commit());
  }
  static void ok(const Status& status) { ASSERT_TRUE(status.ok()) << status.error().text(); }

  RelationPtr relation(const std::string& name) {
    auto datum = store_->read(name);
    EXPECT_TRUE(datum.ok()) << (datum ? "" : datum.error().text());
    return datum ? datum->relation() : nullptr;
  }
  std::shared_ptr<SpatialIndex> index(const std::string& name) {
    auto datum = store_->read(name);
    EXPECT_TRUE(datum.ok()) << (datum ? "" : datum.error().text());
    return datum ? datum->index() : nullptr;
  }
  static std::vector<TuplePtr> tuples(Relation& relation) {
    auto stream = relation.scan();
    EXPECT_TRUE(stream.ok());
    std::vector<TuplePtr> result;
    while (true) {
      auto tuple = (*stream)->next();
      EXPECT_TRUE(tuple.ok()) << (tuple ? "" : tuple.error().text());
      if (!tuple || *tuple == nullptr) return result;
      result.push_back(*tuple);
    }
  }
  /// The tuples of a stored relation as texts.
  std::vector<std::string> rows(const std::string& name) {
    std::vector<std::string> result;
    const RelationPtr stored = relation(name);
    if (stored == nullptr) return result;
    for (const TuplePtr& tuple : tuples(*stored)) result.push_back(text(*tuple));
    return result;
  }

  Tuple tuple(const std::vector<std::pair<std::string, std::string>>& values) {
    Tuple result;
    for (const auto& [type_name, list] : values) result.attributes.push_back(value(type_name, list));
    return result;
  }
  /// `let NAME = ` a relation of these tuples.
  void let_relation(const std::string& name, std::string_view tuple_type, const std::vector<Tuple>& content) {
    std::vector<TuplePtr> shared;
    for (const Tuple& each : content) shared.push_back(std::make_shared<const Tuple>(each));
    const TypeExpr tuple_expr = type(tuple_type);
    ok(store_->create(name, TypeExpr::rel(tuple_expr)));
    ok(store_->assign(name,
                      Datum{RelationPtr(std::make_shared<MemoryRelation>(tuple_expr, TupleBuffer(std::move(shared))))},
                      context_));
  }
  void let_index(const std::string& name, const std::string& relation_name, const std::string& attribute,
                 const std::string& attribute_type) {
    const TypeExpr tuple_expr = relation(relation_name)->tuple_type();
    ok(store_->create(name, TypeExpr("rtree3", {tuple_expr, TypeExpr(attribute_type), "FALSE"})));
    ok(store_->assign(
        name, Datum{std::make_shared<SpatialIndex>(relation_name, attribute, std::make_shared<SpatialIndex::Tree>())},
        context_));
  }

  /// A tetrahedron of edge length 1 at (x, 0, 0).
  std::string solid(int x) const {
    const std::string a = fmt::format("({} 0 0)", x);
    const std::string b = fmt::format("({} 0 0)", x + 1);
    const std::string c = fmt::format("({} 1 0)", x);
    const std::string d = fmt::format("({} 0 1)", x);
    return fmt::format("(({0} {2} {1}) ({0} {1} {3}) ({1} {2} {3}) ({2} {0} {3}))", a, b, c, d);
  }
  Tuple part(int number) { return tuple({{"int", std::to_string(number)}, {"volume3d", solid(10 * number)}}); }
  void let_parts(int count) {
    std::vector<Tuple> content;
    for (int i = 0; i < count; ++i) content.push_back(part(i));
    let_relation("Parts", "(tuple ((No int) (Solid volume3d)))", content);
  }

  std::string bytes(const std::filesystem::path& file) const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write_bytes(const std::filesystem::path& file, std::string_view content) const {
    std::ofstream(file, std::ios::binary) << content;
  }
  /// The bytes of a database file with right checksums of pages.
  static std::string stamped(std::string content) {
    constexpr std::size_t kPageBytes = 4096;
    const auto pages = std::as_writable_bytes(std::span(content.data(), content.size()));
    for (std::size_t at = 0; at + kPageBytes <= pages.size(); at += kPageBytes)
      set_page_sum(pages.subspan(at, kPageBytes), static_cast<std::uint32_t>(at / kPageBytes + 1));
    return content;
  }
  /// Runs SQL on the file, behind the back of the store, and leaves pages with right checksums: the first column of the
  /// first row as text.
  std::string sql(const std::string& statement) { return sql_in(checked_vfs(), statement); }
  /// Runs SQL as another SQLite client does, which knows nothing of checksums.
  std::string foreign_sql(const std::string& statement) { return sql_in(nullptr, statement); }
  std::string sql_in(const char* vfs, const std::string& statement) {
    sqlite3* handle = nullptr;
    EXPECT_EQ(sqlite3_open_v2(path().c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, vfs), SQLITE_OK);
    std::string result;
    char* message = nullptr;
    sqlite3_exec(
        handle, statement.c_str(),
        [](void* target, int count, char** columns, char**) {
          auto& text = *static_cast<std::string*>(target);
          if (text.empty() && count > 0 && columns[0] != nullptr) text = columns[0];
          return 0;
        },
        &result, &message);
    EXPECT_EQ(message, nullptr) << message;
    sqlite3_free(message);
    sqlite3_close(handle);
    return result;
  }

  std::filesystem::path folder_;
  algebra3d::Registry registry_;
  Diagnostics diagnostics_;
  Context context_{diagnostics_, nullptr, {}};
  std::unique_ptr<Store> store_;
};

}  // namespace queries
