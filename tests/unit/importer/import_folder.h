#pragma once

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/types/scalars.h"
#include "queries/importer/importer.h"
#include "queries/store/store.h"
#include "queries/streams/all.h"
#include "queries/streams/relation.h"

namespace queries {

inline const algebra3d::Registry& registry() {
  static const algebra3d::Registry the_registry = [] {
    algebra3d::Registry made = algebra3d::make_registry();
    register_stream_operators(made);
    return made;
  }();
  return the_registry;
}

/// The box from the origin to (x, y, z) as ASCII STL, written by hand: 12 facets, outward.
inline std::string box_stl(double x, double y, double z) {
  constexpr std::array<std::array<int, 3>, 12> kFacets{{{0, 2, 1},
                                                        {0, 3, 2},
                                                        {4, 5, 6},
                                                        {4, 6, 7},
                                                        {0, 1, 5},
                                                        {0, 5, 4},
                                                        {1, 2, 6},
                                                        {1, 6, 5},
                                                        {2, 3, 7},
                                                        {2, 7, 6},
                                                        {3, 0, 4},
                                                        {3, 4, 7}}};
  const std::array<std::array<double, 3>, 8> corners{
      {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}, {0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}}};
  std::ostringstream stl;
  stl << "solid box\n";
  for (const auto& facet : kFacets) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : facet)
      stl << "vertex " << corners[corner][0] << " " << corners[corner][1] << " " << corners[corner][2] << "\n";
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid box\n";
  return stl.str();
}

/// The box without its first facet: not closed.
inline std::string open_box_stl() {
  const std::string box = box_stl(1, 1, 1);
  const std::size_t first = box.find("facet");
  return box.substr(0, first) + box.substr(box.find("facet normal", first + 1));
}

/// A tuple of the relation, as plain text.
struct ImportedRow {
  TupleId id = 0;
  std::string name;
  std::string status;
  std::uint32_t size = 0;  ///< of the solid
  bool is_defined = false;
  std::vector<double> numbers;  ///< after Status; kUndefinedNumber where there is none
};

constexpr double kUndefinedNumber = -1;

/// A folder that goes away with the test, the database beside it, and imports into its relation Parts.
class ImportFolder : public ::testing::Test {
 protected:
  ImportFolder() {
    static std::atomic<int> number = 0;
    root_ = std::filesystem::temp_directory_path() /
            ("algebra3d_import_" + std::to_string(getpid()) + "_" + std::to_string(++number));
    std::filesystem::create_directories(root_ / "parts");
  }
  ~ImportFolder() override { std::filesystem::remove_all(root_); }

  std::filesystem::path parts() const { return root_ / "parts"; }
  std::filesystem::path database() const { return root_ / "test.db"; }

  void write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((parts() / name).parent_path());
    std::ofstream(parts() / name, std::ios::binary) << content;
  }

  ImportOptions options() const {
    ImportOptions options;
    options.database = database();
    options.relation = "Parts";
    options.paths = {parts().string()};
    options.jobs = 2;
    return options;
  }
  /// The options without repair.
  ImportOptions strict() const {
    ImportOptions given = options();
    given.repair.is_strict = true;
    return given;
  }

  /// Imports; the texts are in out_ and err_.
  int import(const ImportOptions& options, SolidReader reader = {}, const std::atomic<bool>* cancel = nullptr) {
    std::ostringstream out;
    std::ostringstream err;
    const int status = run_import(
        options, {.registry = registry(), .out = out, .err = err, .cancel = cancel, .reader = std::move(reader)});
    out_ = out.str();
    err_ = err.str();
    return status;
  }

  /// The relation by the value of File, relative to the folder; a file that is there twice fails the test.
  std::map<std::string, ImportedRow> rows(const std::string& relation = "Parts") const {
    std::map<std::string, ImportedRow> rows;
    auto store = Store::open(database(), OpenMode::read_only, registry());
    if (!store || !(*store)->begin(false)) return ADD_FAILURE() << "no database", rows;
    auto datum = (*store)->read(relation);
    if (!datum) return ADD_FAILURE() << datum.error().text(), rows;
    auto tuples = datum->relation()->scan();
    if (!tuples) return ADD_FAILURE() << tuples.error().text(), rows;
    for (;;) {
      auto tuple = (*tuples)->next();
      if (!tuple) return ADD_FAILURE() << tuple.error().text(), rows;
      if (*tuple == nullptr) break;
      add_row(**tuple, rows);
    }
    (*store)->rollback();
    return rows;
  }

  std::string out_;
  std::string err_;

 private:
  void add_row(const Tuple& tuple, std::map<std::string, ImportedRow>& rows) const {
    ImportedRow row;
    row.id = tuple.id;
    row.name = tuple.attributes[0].loaded().value().get<std::string>();
    row.is_defined = tuple.attributes[2].is_defined();
    if (row.is_defined) row.size = tuple.attributes[2].header().size;
    row.status = tuple.attributes[3].loaded().value().get<algebra3d::Text>().content;
    for (std::size_t i = 4; i < tuple.attributes.size(); ++i) {
      const auto value = tuple.attributes[i].loaded().value();
      const bool is_count = i == 4;
      row.numbers.push_back(!value.is_defined() ? kUndefinedNumber
                            : is_count          ? static_cast<double>(value.get<std::int64_t>())
                                                : value.get<double>());
    }
    const auto file = tuple.attributes[1].loaded().value().get<algebra3d::Text>().content;
    EXPECT_TRUE(rows.emplace(file.substr(parts().string().size() + 1), row).second) << file << " is there twice";
  }

  std::filesystem::path root_;
};

}  // namespace queries
