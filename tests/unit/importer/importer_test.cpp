#include "queries/importer/importer.h"

#include <unistd.h>

#include <cmath>
#include <new>

#include "import_folder.h"
#include "queries/importer/detail/file_loader.h"

namespace queries {
namespace {

using Importer = ImportFolder;

TEST_F(Importer, takes_every_file_of_a_folder_and_says_what_is_wrong_with_bad_ones) {
  write("box.stl", box_stl(1, 2, 3));
  write("sub/deeper/BOX2.STL", box_stl(2, 2, 2));
  write("open.stl", open_box_stl());
  write("empty.stl", "");
  write("picture.stl", std::string("\x89PNG\r\n\x1a\n") + std::string(200, '\0'));
  write("readme.txt", "no mesh");
  EXPECT_EQ(import(strict()), 0) << err_;

  const auto found = rows();
  ASSERT_EQ(found.size(), 5);
  EXPECT_EQ(found.at("box.stl").name, "box");
  EXPECT_EQ(found.at("box.stl").status, "ok");
  EXPECT_EQ(found.at("box.stl").size, 12);
  EXPECT_EQ(found.at("sub/deeper/BOX2.STL").name, "BOX2");
  EXPECT_TRUE(found.at("sub/deeper/BOX2.STL").is_defined);
  EXPECT_FALSE(found.at("open.stl").is_defined);
  EXPECT_NE(found.at("open.stl").status.find("3 boundary edges"), std::string::npos) << found.at("open.stl").status;
  EXPECT_FALSE(found.at("empty.stl").is_defined);
  EXPECT_NE(found.at("empty.stl").status, "");
  EXPECT_FALSE(found.at("picture.stl").is_defined);
  EXPECT_NE(out_.find("why undefined"), std::string::npos) << out_;
  EXPECT_EQ(err_, "");
}

TEST_F(Importer, repairs_what_is_no_solid_and_counts_that) {
  write("box.stl", box_stl(1, 2, 3));
  write("open.stl", open_box_stl());
  EXPECT_EQ(import(options()), 0) << err_;
  EXPECT_TRUE(rows().at("open.stl").is_defined);
  EXPECT_TRUE(rows().at("open.stl").status.starts_with("repaired: 1 hole closed (near ("))
      << rows().at("open.stl").status;
  EXPECT_EQ(rows().at("box.stl").status, "ok");
  EXPECT_NE(out_.find("of these repaired                      1"), std::string::npos) << out_;
}

TEST_F(Importer, takes_a_named_file_whatever_its_extension_and_each_file_once) {
  write("box.mesh", box_stl(1, 1, 1));
  write("other.stl", box_stl(1, 1, 1));
  ImportOptions twice = options();
  const std::string file = (parts() / "box.mesh").string();
  twice.paths = {file, parts().string(), (parts() / "." / "sub" / ".." / "box.mesh").string(), file};
  std::filesystem::create_directory(parts() / "sub");
  EXPECT_EQ(import(twice), 0) << err_;
  EXPECT_EQ(rows().size(), 2);
}

TEST_F(Importer, takes_what_a_pattern_matches) {
  write("a1.stl", box_stl(1, 1, 1));
  write("a2.stl", box_stl(1, 1, 1));
  write("b1.stl", box_stl(1, 1, 1));
  ImportOptions pattern = options();
  pattern.paths = {(parts() / "a*.stl").string()};
  EXPECT_EQ(import(pattern), 0) << err_;
  EXPECT_EQ(rows().size(), 2);
}

TEST_F(Importer, refuses_a_path_that_does_not_exist_and_makes_no_database) {
  write("box.stl", box_stl(1, 1, 1));
  ImportOptions missing = options();
  missing.paths.push_back((parts() / "nothing").string());
  EXPECT_EQ(import(missing), 1);
  EXPECT_EQ(err_, "error: import: " + (parts() / "nothing").string() + ": no such file or folder\n");
  EXPECT_FALSE(std::filesystem::exists(database()));
  missing.paths.back() = (parts() / "q*").string();
  EXPECT_EQ(import(missing), 1);
  EXPECT_NE(err_.find("no file matches this pattern"), std::string::npos) << err_;
  EXPECT_FALSE(std::filesystem::exists(database()));
}

TEST_F(Importer, counts_what_it_skips_by_ending) {
  write("box.stl", box_stl(1, 2, 3));
  write("a.TXT", "x");
  write("sub/b.txt", "x");
  write("c.ply", "x");
  write("Makefile", "x");
  std::filesystem::create_directory_symlink(parts() / "sub", parts() / "link");
  ImportOptions twice = options();
  twice.paths.push_back((parts() / "sub").string());
  EXPECT_EQ(import(twice), 0) << err_;
  EXPECT_NE(out_.find("ignored because of their endings: 2 .txt, 1 .ply, 1 link to a folder, 1 no ending\n"),
            std::string::npos)
      << out_;
}

TEST_F(Importer, drops_tuples_of_files_that_are_gone_if_told) {
  write("kept.stl", box_stl(1, 2, 3));
  write("gone.stl", box_stl(1, 2, 3));
  write("sub/a1.stl", box_stl(1, 2, 3));
  write("sub/a2.stl", box_stl(1, 2, 3));
  EXPECT_EQ(import(options()), 0) << err_;
  std::filesystem::remove(parts() / "gone.stl");
  std::filesystem::remove(parts() / "sub" / "a1.stl");
  EXPECT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().size(), 4);

  ImportOptions pattern = options();
  pattern.drops_gone = true;
  pattern.paths = {(parts() / "sub" / "a*.stl").string()};
  EXPECT_EQ(import(pattern), 0) << err_;
  EXPECT_EQ(rows().size(), 3);
  EXPECT_NE(out_.find("  deleted with their files                 1\n"), std::string::npos) << out_;

  ImportOptions folder = options();
  folder.drops_gone = true;
  EXPECT_EQ(import(folder), 0) << err_;
  EXPECT_EQ(rows().size(), 2);
  EXPECT_TRUE(rows().contains("kept.stl"));
  // A file that comes back is imported again.
  write("gone.stl", box_stl(1, 2, 3));
  EXPECT_EQ(import(folder), 0) << err_;
  EXPECT_EQ(rows().size(), 3);
  EXPECT_TRUE(rows().at("gone.stl").is_defined);
}

TEST_F(Importer, a_file_that_changed_while_it_was_read_is_tried_again) {
  write("box.stl", box_stl(1, 2, 3));
  const SolidReader changing = [](const std::filesystem::path&, const std::atomic<bool>*) -> Result<SolidOrReason> {
    return SolidOrReason{std::nullopt, "the file was changed while it was read", false};
  };
  EXPECT_EQ(import(options(), changing), 0) << err_;
  EXPECT_EQ(rows().at("box.stl").status, "the file was changed while it was read");
  EXPECT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().at("box.stl").status, "ok");
}

TEST_F(Importer, says_that_a_folder_has_no_files_to_import) {
  write("readme.txt", "no mesh");
  EXPECT_EQ(import(options()), 1);
  EXPECT_NE(err_.find("(but 1 .txt)"), std::string::npos) << err_;
  EXPECT_NE(err_.find("there is no file to import"), std::string::npos) << err_;
  EXPECT_FALSE(std::filesystem::exists(database()));
}

TEST_F(Importer, refuses_what_cannot_name_a_relation) {
  write("box.stl", box_stl(1, 1, 1));
  ImportOptions wrong = options();
  for (const std::string name : {"two words", "1st", "", "a;b"}) {
    wrong.relation = name;
    EXPECT_EQ(import(wrong), 2) << name;
    EXPECT_NE(err_.find("'" + name + "' cannot name a relation"), std::string::npos) << err_;
  }
  wrong.relation = "query";
  EXPECT_EQ(import(wrong), 2);
  EXPECT_NE(err_.find("'query' is a word of the language"), std::string::npos) << err_;
}

TEST_F(Importer, refuses_an_object_of_another_type) {
  write("box.stl", box_stl(1, 1, 1));
  {
    auto store = Store::open(database(), OpenMode::create, registry());
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->begin(true));
    ASSERT_TRUE((*store)->create("Parts", "int"));
    ASSERT_TRUE((*store)->commit());
  }
  EXPECT_EQ(import(options()), 1);
  EXPECT_EQ(err_,
            "error: import: 'Parts' is of type int; an import needs (rel (tuple ((Name string) (File text) "
            "(Solid volume3d) (Status text) (FacetsDropped int) (AreaSeen real) (AreaDropped real) (AreaAdded real) "
            "(DroppedDistance real) (AddedDistance real) (VolumeBefore real) (VolumeAfter real))))\n");
}

TEST_F(Importer, takes_over_a_relation_that_was_created_without_a_value) {
  write("box.stl", box_stl(1, 1, 1));
  {
    auto store = Store::open(database(), OpenMode::create, registry());
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->begin(true));
    ASSERT_TRUE((*store)->create(
        "Parts", TypeExpr::rel(TypeExpr::tuple(
                     {{"Name", "string"}, {"File", "text"}, {"Solid", "volume3d"}, {"Status", "text"}}))));
    ASSERT_TRUE((*store)->commit());
  }
  EXPECT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().size(), 1);
  EXPECT_EQ(err_,
            "note: 'Parts' was made by an earlier version and has no attributes for areas, distances and volumes; an "
            "import into a new relation has them\n");
  // And again, now that it has a tuple.
  write("box.stl", box_stl(1, 1, 2));
  write("bad.stl", "");
  EXPECT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().size(), 2);
}

TEST_F(Importer, tells_in_numbers_what_was_left_out_and_added) {
  write("box.stl", box_stl(1, 2, 3));
  write("open.stl", open_box_stl());
  write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 x\n");
  EXPECT_EQ(import(options()), 0) << err_;
  const auto found = rows();
  // FacetsDropped, AreaSeen, AreaDropped, AreaAdded, DroppedDistance, AddedDistance, VolumeBefore, VolumeAfter
  EXPECT_EQ(found.at("box.stl").numbers, (std::vector<double>{0, 22, 0, 0, 0, 0, 6, 6}));
  const std::vector<double> open = found.at("open.stl").numbers;
  EXPECT_EQ(std::vector(open.begin(), open.begin() + 5), (std::vector<double>{0, 5.5, 0, 0.5, 0}));
  // The radius of the circle within the missing triangle, and what is told above it.
  EXPECT_GE(open[5], (1 - 1e-12) * (1 - std::sqrt(0.5)));
  EXPECT_LE(open[5], 1.011 * (1 - std::sqrt(0.5)));
  EXPECT_EQ(open[6], kUndefinedNumber);
  EXPECT_EQ(open[7], 1);
  EXPECT_EQ(found.at("bad.off").numbers, std::vector<double>(8, kUndefinedNumber));
  EXPECT_EQ(found.at("bad.off").status, "byte 26, line 5: vertex 3 of 3: expected a number, found 'x'");
}

TEST_F(Importer, stores_no_number_that_a_double_cannot_hold) {
  const auto box_and_sheet = [](const std::string& e) {
    const std::string unit = "1" + e, twice = "2" + e, triple = "3" + e;
    return "OFF\n12 8 0\n0 0 0\n0 " + unit + " 0\n" + unit + " " + unit + " 0\n" + unit + " 0 0\n0 0 " + unit + "\n0 " +
           unit + " " + unit + "\n" + unit + " " + unit + " " + unit + "\n" + unit + " 0 " + unit + "\n" + twice +
           " 0 0\n" + triple + " 0 0\n" + triple + " " + triple + " 0\n" + twice + " " + triple +
           " 0\n4 0 1 2 3\n4 4 7 6 5\n4 0 3 7 4\n4 3 2 6 7\n4 2 1 5 6\n4 1 0 4 5\n3 8 9 10\n3 8 10 11\n";
  };
  write("large.off", box_and_sheet("e200"));
  write("small.off", box_and_sheet("e-200"));
  EXPECT_EQ(import(options()), 0) << err_;
  for (const auto& [name, row] : rows()) {
    EXPECT_TRUE(row.is_defined) << row.status;
    const double unit = name == "large.off" ? 1e200 : 1e-200;
    const std::vector<double>& found = row.numbers;
    EXPECT_EQ(std::vector(found.begin(), found.begin() + 4),
              (std::vector<double>{2, kUndefinedNumber, kUndefinedNumber, 0}));
    EXPECT_NEAR(found[4] / unit, std::sqrt(8.0), 0.03);
    EXPECT_EQ(std::vector(found.begin() + 5, found.end()),
              (std::vector<double>{0, kUndefinedNumber, kUndefinedNumber}));
    EXPECT_NE(row.status.find("area beyond the range of doubles (33.3 %)"), std::string::npos) << row.status;
  }
}

TEST_F(Importer, says_that_the_database_file_is_foreign) {
  write("box.stl", box_stl(1, 1, 1));
  std::ofstream(database()) << "this is a letter, and it is longer than the header of a database file would be.";
  EXPECT_EQ(import(options()), 1);
  EXPECT_NE(err_.find("test.db"), std::string::npos) << err_;
}

TEST_F(Importer, passes_over_unchanged_files_and_replaces_changed_ones_in_place) {
  write("a.stl", box_stl(1, 1, 1));
  write("b.stl", box_stl(2, 2, 2));
  write("c.stl", open_box_stl());
  ASSERT_EQ(import(strict()), 0) << err_;
  const auto before = rows();

  ASSERT_EQ(import(strict()), 0) << err_;
  EXPECT_NE(out_.find("imported before"), std::string::npos) << out_;
  EXPECT_EQ(rows().size(), 3);

  write("b.stl", open_box_stl());
  write("c.stl", box_stl(3, 3, 3));
  write("d.stl", box_stl(4, 4, 4));
  ASSERT_EQ(import(strict()), 0) << err_;
  const auto after = rows();
  ASSERT_EQ(after.size(), 4);
  EXPECT_EQ(after.at("a.stl").id, before.at("a.stl").id);
  EXPECT_EQ(after.at("b.stl").id, before.at("b.stl").id);
  EXPECT_FALSE(after.at("b.stl").is_defined);
  EXPECT_EQ(after.at("c.stl").id, before.at("c.stl").id);
  EXPECT_EQ(after.at("c.stl").status, "ok");
}

TEST_F(Importer, imports_again_with_other_repair_options) {
  write("a.stl", box_stl(1, 1, 1));
  write("open.stl", open_box_stl());
  ASSERT_EQ(import(strict()), 0) << err_;
  const auto before = rows();
  EXPECT_FALSE(before.at("open.stl").is_defined);

  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(out_.find("imported before"), std::string::npos) << out_;
  EXPECT_NE(out_.find("of these replaced                      2"), std::string::npos) << out_;
  EXPECT_TRUE(rows().at("open.stl").is_defined);
  EXPECT_EQ(rows().at("open.stl").id, before.at("open.stl").id);

  ImportOptions other = options();
  other.repair.largest_hole = 0.5;
  ASSERT_EQ(import(other), 0) << err_;
  EXPECT_FALSE(rows().at("open.stl").is_defined);
  ASSERT_EQ(import(other), 0) << err_;
  EXPECT_NE(out_.find("imported before                        2"), std::string::npos) << out_;
}

TEST_F(Importer, imports_into_a_second_relation_of_the_same_database) {
  write("a.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  ImportOptions second = options();
  second.relation = "More";
  ASSERT_EQ(import(second), 0) << err_;
  EXPECT_EQ(rows("More").size(), 1);
}

TEST_F(Importer, imports_again_after_the_relation_was_deleted) {
  write("a.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  {
    auto store = Store::open(database(), OpenMode::read_write, registry());
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->begin(true));
    ASSERT_TRUE((*store)->remove("Parts"));
    ASSERT_TRUE((*store)->commit());
  }
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().size(), 1);
}

TEST_F(Importer, a_file_that_may_not_be_read_has_a_reason_and_is_tried_again) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read every file";
  write("a.stl", box_stl(1, 1, 1));
  std::filesystem::permissions(parts() / "a.stl", std::filesystem::perms::none);
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_NE(rows().at("a.stl").status.find("Permission denied"), std::string::npos);
  std::filesystem::permissions(parts() / "a.stl", std::filesystem::perms::owner_all);
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().at("a.stl").status, "ok");
}

TEST_F(Importer, a_link_to_nowhere_has_a_reason_and_is_tried_again) {
  std::filesystem::create_symlink(parts() / "nowhere", parts() / "a.stl");
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().at("a.stl").status,
            "it is a link to '" + (parts() / "nowhere").string() + "', which does not exist");
  write("nowhere", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().at("a.stl").status, "ok");
}

TEST_F(Importer, a_file_that_cannot_be_read_any_more_does_not_cost_its_solid) {
  write("a.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  std::filesystem::remove(parts() / "a.stl");
  std::filesystem::create_symlink(parts() / "nowhere", parts() / "a.stl");
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_NE(out_.find("unreadable, left as before"), std::string::npos) << out_;
  EXPECT_EQ(rows().at("a.stl").status, "ok");
}

TEST_F(Importer, a_file_that_is_changed_back_is_imported_again) {
  write("a.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  write("a.stl", open_box_stl());
  ASSERT_EQ(import(strict()), 0) << err_;
  ASSERT_FALSE(rows().at("a.stl").is_defined);
  write("a.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_TRUE(rows().at("a.stl").is_defined);
}

TEST_F(Importer, a_file_whose_loading_throws_or_fails_stops_no_other_and_is_tried_again) {
  for (const char* name : {"a.stl", "b.stl", "c.stl"}) write(name, box_stl(1, 1, 1));
  const SolidReader reader = [](const std::filesystem::path& file, const std::atomic<bool>*) -> Result<SolidOrReason> {
    if (file.stem() == "a") throw std::bad_alloc();
    if (file.stem() == "b") return Error{ErrorCode::internal, "the disk is on fire"};
    return SolidOrReason{algebra3d::Volume3d(), "ok"};
  };
  ASSERT_EQ(import(options(), reader), 0) << err_;
  auto found = rows();
  EXPECT_EQ(found.at("a.stl").status, "memory is exhausted");
  EXPECT_EQ(found.at("b.stl").status, "the disk is on fire");
  EXPECT_TRUE(found.at("c.stl").is_defined);
  ASSERT_EQ(import(options()), 0) << err_;
  found = rows();
  EXPECT_EQ(found.at("a.stl").status, "ok");
  EXPECT_EQ(found.at("b.stl").status, "ok");
  EXPECT_EQ(found.at("c.stl").size, 0) << "it was imported before";
}

TEST_F(Importer, the_relation_does_not_depend_on_the_number_of_threads) {
  for (int i = 0; i < 60; ++i) write(std::to_string(i) + ".stl", i % 7 == 0 ? open_box_stl() : box_stl(i, 1, 1));
  ImportOptions one = options();
  one.jobs = 1;
  one.relation = "One";
  ASSERT_EQ(import(one), 0) << err_;
  ImportOptions many = options();
  many.jobs = 8;
  many.relation = "Many";
  many.batch_megabytes = 0;  // every file is a batch
  ASSERT_EQ(import(many), 0) << err_;
  const auto a = rows("One");
  const auto b = rows("Many");
  ASSERT_EQ(a.size(), 60);
  ASSERT_EQ(b.size(), 60);
  for (const auto& [file, row] : a) {
    EXPECT_EQ(row.id, b.at(file).id) << file;
    EXPECT_EQ(row.status, b.at(file).status);
    EXPECT_EQ(row.size, b.at(file).size);
  }
}

TEST_F(Importer, a_cancel_flag_that_is_set_imports_nothing_and_a_second_run_completes_it) {
  write("a.stl", box_stl(1, 1, 1));
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(import(options(), {}, &cancel), 130);
  EXPECT_EQ(err_, "interrupted: 0 of 1 files are in 'Parts'; run the same import again to go on from there\n");
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().size(), 1);
}

TEST_F(Importer, an_interrupted_import_keeps_what_is_complete) {
  for (const char* name : {"a.stl", "b.stl", "c.stl", "d.stl"}) write(name, box_stl(1, 1, 1));
  std::atomic<bool> cancel = false;
  std::atomic<int> others = 3;
  ImportOptions all_at_once = options();
  all_at_once.jobs = 4;
  const SolidReader reader = [&](const std::filesystem::path& file,
                                 const std::atomic<bool>* stop) -> Result<SolidOrReason> {
    if (file.stem() == "c") {
      while (others.load() > 0) usleep(1000);
      cancel.store(true);
      while (!stop->load()) usleep(1000);
      return Error{ErrorCode::interrupted, "interrupted"};
    }
    --others;
    return SolidOrReason{algebra3d::Volume3d(), "ok"};
  };
  EXPECT_EQ(import(all_at_once, reader, &cancel), 130);
  EXPECT_EQ(err_, "interrupted: 3 of 4 files are in 'Parts'; run the same import again to go on from there\n");
  const auto found = rows();
  ASSERT_EQ(found.size(), 3);
  EXPECT_TRUE(found.contains("a.stl") && found.contains("b.stl") && found.contains("d.stl"));
  ASSERT_EQ(import(all_at_once), 0) << err_;
  EXPECT_EQ(rows().size(), 4);
}

TEST_F(Importer, others_overtake_a_slow_file) {
  std::vector<ListedFile> files;
  for (const char* name : {"a.stl", "b.stl", "c.stl", "d.stl"}) {
    write(name, box_stl(1, 1, 1));
    files.push_back({parts() / name, 1000});
  }
  std::atomic<bool> may_end = false;
  const SolidReader reader = [&](const std::filesystem::path& file, const std::atomic<bool>*) -> Result<SolidOrReason> {
    while (file.stem() == "a" && !may_end.load()) usleep(1000);
    return SolidOrReason{algebra3d::Volume3d(), "ok"};
  };
  FileLoader loader(files, reader, [](const Store::ImportedFile&) { return false; },
                    {.jobs = 2, .hold = std::chrono::milliseconds(50)});
  const auto next_name = [&] {
    while (true) {
      const auto next = loader.next(std::chrono::milliseconds(10));
      if (next->state != FileLoader::State::not_yet) return next->file.name;
    }
  };
  EXPECT_EQ(next_name(), "b");
  EXPECT_EQ(next_name(), "c");
  EXPECT_EQ(next_name(), "d");
  const auto slow = loader.longest_at_work();
  ASSERT_TRUE(slow);
  EXPECT_EQ(slow->path, (parts() / "a.stl").string());
  EXPECT_GE(slow->time, std::chrono::milliseconds(50));
  may_end = true;
  EXPECT_EQ(next_name(), "a");
  EXPECT_EQ(loader.next(std::chrono::milliseconds(10))->state, FileLoader::State::finished);
}

TEST_F(Importer, a_file_may_be_given_a_limit_of_time) {
  for (const char* name : {"a.stl", "b.stl", "c.stl"}) write(name, box_stl(1, 1, 1));
  const SolidReader reader = [](const std::filesystem::path& file,
                                const std::atomic<bool>* stop) -> Result<SolidOrReason> {
    while (file.stem() == "b" && !stop->load()) usleep(1000);
    if (file.stem() == "b") return Error{ErrorCode::interrupted, "interrupted"};
    return SolidOrReason{algebra3d::Volume3d(), "ok"};
  };
  ImportOptions limited = options();
  limited.file_seconds = 0.25;
  ASSERT_EQ(import(limited, reader), 0) << err_;
  const auto found = rows();
  ASSERT_EQ(found.size(), 3);
  EXPECT_FALSE(found.at("b.stl").is_defined);
  EXPECT_EQ(found.at("b.stl").status, "it took longer than 0.25 s (option file-seconds)");
  EXPECT_TRUE(found.at("a.stl").is_defined && found.at("c.stl").is_defined);
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().at("b.stl").status, "ok");
}

// The thread that all need is taken for longer than the limit of each.
TEST_F(Importer, waiting_for_a_thread_does_not_count_against_the_limit) {
  for (const char* name : {"a.stl", "b.stl", "c.stl", "d.stl", "e.stl"}) write(name, box_stl(1, 1, 1));
  const SolidReader reader = [](const std::filesystem::path& file,
                                const std::atomic<bool>* stop) -> Result<SolidOrReason> {
    const bool is_slow = file.stem() == "a" || file.stem() == "b";
    while (is_slow && !stop->load()) usleep(1000);
    if (is_slow) return Error{ErrorCode::interrupted, "interrupted"};
    return SolidOrReason{algebra3d::Volume3d(), "ok"};
  };
  ImportOptions limited = options();
  limited.file_seconds = 0.25;
  limited.jobs = 1;
  ASSERT_EQ(import(limited, reader), 0) << err_;
  const auto found = rows();
  EXPECT_FALSE(found.at("a.stl").is_defined || found.at("b.stl").is_defined);
  for (const char* name : {"c.stl", "d.stl", "e.stl"}) EXPECT_TRUE(found.at(name).is_defined) << found.at(name).status;
}

TEST_F(Importer, quiet_means_no_output) {
  write("a.stl", box_stl(1, 1, 1));
  ImportOptions quiet = options();
  quiet.quiet = true;
  EXPECT_EQ(import(quiet), 0);
  EXPECT_EQ(out_ + err_, "");
}

TEST_F(Importer, a_file_name_that_is_no_utf8_is_written_so_that_it_is) {
  write("p\xE9.stl", box_stl(1, 1, 1));
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().begin()->first, "p\\xe9.stl");
}

TEST_F(Importer, nor_has_the_status_of_such_a_file_its_bytes) {
  write("p\xE9.stl", "solid\nfac\xE9t\n");
  ASSERT_EQ(import(options()), 0) << err_;
  EXPECT_EQ(rows().begin()->second.status, R"(byte 6, line 2: expected 'facet' or 'endsolid', found 'fac\xe9t')");
}

}  // namespace
}  // namespace queries
