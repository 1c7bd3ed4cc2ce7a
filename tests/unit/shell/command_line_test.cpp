// What is made of the description of the command line: manual page and completion.
#include "queries/shell/detail/command_line.h"

#include <CLI/CLI.hpp>

#include <gtest/gtest.h>

#include "algebra3d/operators/descriptions/all.h"
#include "queries/shell/detail/completion_script.h"
#include "queries/shell/detail/man_page.h"

namespace queries {
namespace {

using Names = std::vector<std::string>;

/// A small program with an option of each kind.
class CommandLines : public ::testing::Test {
 protected:
  CommandLines() {
    app_.footer("All's well.");
    app_.add_option("-o,--output", text_, "Where to")->type_name("FILE")->required();
    app_.add_option("--format", text_, "How")->check(CLI::IsMember({"list", "table"}))->type_name("NAME");
    app_.add_flag("--quiet", is_set_, "Say nothing");
    CLI::App* sub = app_.add_subcommand("mend", "Mend files");
    sub->add_option("FILE", texts_, "What to mend")->required();
    sub->add_option_group("Limits", "Limits")->add_option("--work", text_, "At most")->type_name("MILLIONS");
    line_ = command_line_of(app_);
  }

  CLI::App app_{"tool: does something"};
  std::string text_;
  std::vector<std::string> texts_;
  bool is_set_ = false;
  CommandLine line_;
};

const CommandLineArgument& named(const CommandLine& line, const std::string& name) {
  for (const CommandLineArgument& argument : line.arguments)
    if (argument.names.back() == name) return argument;
  throw std::runtime_error("no argument " + name);
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST_F(CommandLines, are_described_as_they_are_parsed) {
  const CommandLineArgument& output = named(line_, "--output");
  EXPECT_EQ(output.names, (Names{"-o", "--output"}));
  EXPECT_EQ(output.value, "FILE");
  EXPECT_TRUE(output.is_required);
  EXPECT_EQ(completed_as(output), "file");
  EXPECT_EQ(named(line_, "--format").choices, (Names{"list", "table"}));
  EXPECT_EQ(named(line_, "--format").value, "NAME");
  EXPECT_EQ(named(line_, "--quiet").value, "");
  ASSERT_EQ(line_.subcommands.size(), 1U);
  const CommandLine& mend = line_.subcommands.front();
  EXPECT_TRUE(named(mend, "FILE").is_positional);
  EXPECT_TRUE(named(mend, "FILE").is_repeated);
  EXPECT_EQ(named(mend, "--work").value, "MILLIONS");  // of a group
  EXPECT_EQ(line_.remarks, "All's well.");
  EXPECT_EQ(mend.remarks, "");
}

TEST_F(CommandLines, have_a_manual_page) {
  const std::string page = man_page(line_, algebra3d::make_registry());
  EXPECT_TRUE(page.starts_with(".TH ALGEBRA3D 1")) << page.substr(0, 80);
  EXPECT_TRUE(has(page, "\n.SH NAME\nalgebra3d \\- does something\n"));
  EXPECT_TRUE(has(page, "\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\nWhere to\n"));
  EXPECT_TRUE(has(page, "\nHow (one of: list, table)\n"));
  EXPECT_TRUE(has(page, "\\fBalgebra3d\\fR \\fBmend\\fR [\\fIOPTIONS\\fR] \\fIFILE\\fR...\n"));
  EXPECT_TRUE(has(page, "\nAll\\(aqs well.\n"));
  EXPECT_TRUE(has(page, "\\fBquery EXPRESSION\\fR"));  // of the language
  EXPECT_TRUE(has(page, "createSphere"));
}

TEST_F(CommandLines, are_completed_by_bash) {
  const std::string script = bash_completion(line_, algebra3d::make_registry());
  EXPECT_TRUE(has(script, "    --format) _algebra3d_words -W 'list table'; return ;;\n"));
  EXPECT_TRUE(has(script, "    -o|--output) _algebra3d_words -f; return ;;\n"));
  EXPECT_TRUE(has(script, "    mend) options='-h --help --work' ;;\n")) << script;
  EXPECT_TRUE(has(script, " createSphere "));
}

TEST_F(CommandLines, are_completed_by_zsh) {
  const std::string script = zsh_completion(line_, algebra3d::make_registry());
  EXPECT_TRUE(script.starts_with("#compdef algebra3d\n"));
  EXPECT_TRUE(has(script, "'--format[How]:NAME:(list table)'"));
  EXPECT_TRUE(has(script, "        mend) _arguments"));
  EXPECT_TRUE(has(script, "'*:FILE:_files' ;;\n"));
}

}  // namespace
}  // namespace queries
