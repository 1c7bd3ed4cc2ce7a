#include "algebra3d/kernel/repair/repair_options.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/kernel/repair/detail/work_limits.h"

namespace algebra3d {
namespace {

/// What is wrong with the options.
std::string complaint_about(std::string_view text) {
  const auto options = parse_repair_options(text);
  EXPECT_FALSE(options.ok()) << text;
  if (options.ok()) return {};
  EXPECT_EQ(options.error().code, ErrorCode::invalid_value);
  return options.error().message;
}

TEST(RepairOptions, of_nothing_are_the_defaults) {
  for (const std::string_view text : {"", " ", ";", " ; ;\t\n"}) {
    const auto options = parse_repair_options(text);
    ASSERT_TRUE(options.ok()) << text;
    EXPECT_EQ(options->gap_tolerance, std::nullopt);
    EXPECT_EQ(options->largest_hole, std::nullopt);
    EXPECT_TRUE(options->keeps_cavities);
    EXPECT_EQ(options->smallest_shell, 0);
    EXPECT_FALSE(options->is_strict);
    EXPECT_EQ(options->work_limit, 500);
  }
}

TEST(RepairOptions, are_read_in_any_order_and_with_blanks) {
  for (const std::string_view text : {"gaps=0.001;holes=20;cavities=drop;smallest=0.5;work=1000;strict",
                                      " strict ; work = 1e3;smallest= .5e0 ;cavities\t=\tdrop; holes=2e1;gaps=1e-3;",
                                      "strict;work=1000;smallest=0.5;cavities=drop;holes=20;cracks=0.001"}) {
    const auto options = parse_repair_options(text);
    ASSERT_TRUE(options.ok()) << text << ": " << options.error().message;
    EXPECT_EQ(options->gap_tolerance, 0.001);
    EXPECT_EQ(options->largest_hole, 20.0);
    EXPECT_FALSE(options->keeps_cavities);
    EXPECT_EQ(options->smallest_shell, 0.5);
    EXPECT_TRUE(options->is_strict);
    EXPECT_EQ(options->work_limit, 1000);
  }
  EXPECT_TRUE(parse_repair_options("cavities=keep")->keeps_cavities);
  EXPECT_EQ(parse_repair_options("gaps=0")->gap_tolerance, 0.0);
  EXPECT_EQ(parse_repair_options("")->most_added, std::nullopt);
  EXPECT_EQ(parse_repair_options("added=1.5")->most_added, 1.5);
  EXPECT_EQ(text_of(*parse_repair_options("added=1.5")), "added=1.5");
  EXPECT_TRUE(RepairOptions::strict().is_strict);
}

TEST(RepairOptions, that_make_no_sense_are_refused_with_what_was_found_and_expected) {
  EXPECT_EQ(complaint_about("gap=1"),
            "there is no option 'gap'; expected gaps, holes, cavities, smallest, dropped, added, work or strict");
  EXPECT_EQ(complaint_about("=1"),
            "there is no option ''; expected gaps, holes, cavities, smallest, dropped, added, work or strict");
  EXPECT_EQ(complaint_about("holes=1;holes=1"), "option 'holes' is given twice");
  EXPECT_EQ(complaint_about("strict;strict"), "option 'strict' is given twice");
  EXPECT_EQ(complaint_about("cavities=fill"), "option 'cavities' is 'fill'; expected 'keep' or 'drop'");
  for (const std::string text : {"cavities", "cavities=", "cavities = "})
    EXPECT_EQ(complaint_about(text), "option 'cavities' has no value; expected 'keep' or 'drop'");
  for (const std::string value : {"", "yes", "false", "="})
    EXPECT_EQ(complaint_about("strict=" + value),
              "option 'strict' takes no value, not even an empty one; found 'strict=" + value + "'");
  for (const std::string value :
       {"-1",    "-0.001", "-1e-999x", "abc", "1,5", "1 2",  "nan", "NaN", "inf", "-inf", "infinity",
        "1e999", "0x10",   "1=",       "=1",  "5mm", "5 mm", "1%",  "++1", "1e",  "."})
    EXPECT_EQ(complaint_about("holes=" + value),
              "option 'holes' is '" + value + "'; expected a number of at least 0 without a unit");
  for (const std::string name : {"gaps", "cracks", "holes", "smallest", "work"})
    for (const std::string& text : {name, name + "=", name + " = ;strict"})
      EXPECT_EQ(complaint_about(text),
                "option '" + name + "' has no value; expected a number of at least 0 without a unit");
  EXPECT_EQ(complaint_about("gaps=1;;gaps"), "option 'gaps' is given twice");
  EXPECT_EQ(complaint_about("gaps=1;cracks=1"), "option 'cracks' is given twice");
  EXPECT_EQ(complaint_about("cracks=1;cracks=2"), "option 'cracks' is given twice");
  EXPECT_NE(complaint_about("STRICT"), "");
  EXPECT_NE(complaint_about(std::string("holes=1\0", 8)), "");
}

TEST(RepairOptions, are_written_as_they_are_read) {
  for (const std::string text :
       {"", "cracks=0.001", "cracks=0.0", "holes=20.0", "cavities=drop", "smallest=0.5", "work=1000.0", "strict",
        "cracks=1e-300;holes=1e+300;cavities=drop;smallest=0.1;work=0.0;strict"})
    EXPECT_EQ(text_of(*parse_repair_options(text)), text);
  // The first name of the option stays in what is written.
  EXPECT_EQ(text_of(*parse_repair_options("gaps=0.001")), "cracks=0.001");
  EXPECT_EQ(text_of(*parse_repair_options("cavities=keep; work=500; smallest=0; cracks=-0")), "cracks=0.0");
}

TEST(RepairOptions, pairs_are_counted_in_millions) {
  const auto limit = [](double millions) {
    RepairOptions options;
    options.work_limit = millions;
    return work_limits(options).max_pairs;
  };
  EXPECT_EQ(limit(0), 0U);
  EXPECT_EQ(limit(1e-7), 0U);
  EXPECT_EQ(limit(0.25), 250000U);
  EXPECT_EQ(limit(500), 500000000U);
  EXPECT_EQ(limit(9e12), 9000000000000000000U);
  EXPECT_EQ(limit(1e13), SIZE_MAX);
  EXPECT_EQ(limit(1e20), SIZE_MAX);
  EXPECT_EQ(limit(1.7e308), SIZE_MAX);
}

}  // namespace
}  // namespace algebra3d
