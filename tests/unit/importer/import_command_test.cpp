#include "queries/importer/import_command.h"

#include <string>

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

namespace queries {
namespace {

/// What the command line says of `options`, empty if it takes them.
std::string complaint_about_options(const std::string& options, ImportOptions* taken = nullptr) {
  ImportOptions parsed;
  CLI::App app;
  add_import_command(app, parsed);
  try {
    app.parse("import --db x.db --relation R " + options + " parts");
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  if (taken != nullptr) *taken = parsed;
  return {};
}

TEST(ImportCommand, takes_repair_options) {
  ImportOptions taken;
  EXPECT_EQ(complaint_about_options(
                "--gaps 0.5 --largest-hole=2e1 --smallest-shell 0 --work 7 --drop-cavities --strict", &taken),
            "");
  EXPECT_EQ(text_of(taken.repair), "cracks=0.5;holes=20.0;cavities=drop;work=7.0;strict");
  EXPECT_EQ(complaint_about_options("", &taken), "");
  EXPECT_EQ(text_of(taken.repair), "");
}

TEST(ImportCommand, refuses_options_that_make_no_sense_and_names_them) {
  for (const std::string option :
       {"--gaps", "--largest-hole", "--smallest-shell", "--work", "--batch-seconds", "--batch-megabytes"})
    for (const std::string value : {"-1", "nan", "inf", "1e999", "5mm", "''"}) {
      const std::string complaint = complaint_about_options(option + " " + value);
      EXPECT_NE(complaint.find(option), std::string::npos) << option << " " << value << ": " << complaint;
    }
  for (const std::string option : {"--strict", "--drop-cavities", "--quiet"}) {
    EXPECT_NE(complaint_about_options(option + "=no").find(option.substr(2)), std::string::npos) << option;
    EXPECT_NE(complaint_about_options(option + " " + option).find(option), std::string::npos) << option;
  }
  EXPECT_NE(complaint_about_options("--cracks -1").find("--gaps"), std::string::npos);  // the name of today
  EXPECT_NE(complaint_about_options("--cracks 1 --gaps 2").find("--gaps"), std::string::npos);
  EXPECT_NE(complaint_about_options("--jobs 0").find("--jobs"), std::string::npos);
  EXPECT_NE(complaint_about_options("--crack 1").find("--crack"), std::string::npos);
}

}  // namespace
}  // namespace queries
