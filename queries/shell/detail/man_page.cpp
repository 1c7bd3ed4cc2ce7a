#include "queries/shell/detail/man_page.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/version.h"
#include "queries/language/command_list.h"
#include "queries/language/documentation.h"
#include "queries/shell/detail/command_table.h"

namespace queries {
namespace {

// A text as roff shows it unchanged. A hyphen is one that can be typed.
std::string roff_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '\'':
        result += "\\(aq";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string bold(std::string_view text) {
  return "\\fB" + roff_text(text) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + roff_text(text) + "\\fR";
}

std::string section(std::string_view title) {
  return fmt::format(".SH {}\n", title);
}

std::string paragraph(std::string_view head, std::string_view text) {
  return fmt::format(".TP\n{}\n{}\n", head, roff_text(text));
}

// An empty line begins a paragraph; the others are shown as they stand.
std::string remarks(std::string_view text) {
  std::string result = ".nf\n";
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    result += line.empty() ? std::string(".PP\n") : roff_text(line) + "\n";
    begin = end + 1;
  }
  return result + ".fi\n";
}

std::string head_of(const CommandLineArgument& argument) {
  if (argument.is_positional) return italic(argument.names.front()) + (argument.is_repeated ? " ..." : "");
  std::string head;
  for (const std::string& name : argument.names) head += (head.empty() ? "" : ", ") + bold(name);
  if (!argument.value.empty()) head += " " + italic(argument.value);
  return head;
}

std::string argument_text(const CommandLineArgument& argument) {
  std::string meaning = argument.meaning;
  if (!argument.choices.empty()) meaning += fmt::format(" (one of: {})", fmt::join(argument.choices, ", "));
  return paragraph(head_of(argument), meaning);
}

std::string arguments_text(const CommandLine& line) {
  std::string text;
  for (const CommandLineArgument& argument : line.arguments) text += argument_text(argument);
  return text;
}

// Positional arguments, and the options that must be given.
std::string synopsis(const CommandLine& line, std::string_view before) {
  std::string text = fmt::format("{}{}", before, bold(line.name));
  for (const CommandLineArgument& argument : line.arguments)
    if (!argument.is_positional && argument.is_required)
      text += " " + bold(argument.names.back()) + " " + italic(argument.value);
  text += " [" + italic("OPTIONS") + "]";
  for (const CommandLineArgument& argument : line.arguments) {
    if (!argument.is_positional) continue;
    const std::string name = italic(argument.names.front()) + (argument.is_repeated ? "..." : "");
    text += argument.is_required ? " " + name : " [" + name + "]";
  }
  return text + "\n";
}

std::string subcommand_text(const CommandLine& line) {
  std::string text = fmt::format(".SS {}\n{}.\n", line.name, roff_text(line.meaning)) + arguments_text(line);
  return line.remarks.empty() ? text : text + ".PP\n" + remarks(line.remarks);
}

std::string language_text(const algebra3d::Registry& registry) {
  std::string text = section("COMMANDS OF THE LANGUAGE") + "Commands end with a semicolon or an empty line.\n" +
                     fmt::format("{} explains one of them, or an operator.\n", bold("algebra3d help NAME"));
  for (const auto& [syntax, meaning] : command_list()) text += paragraph(bold(syntax), meaning);
  text += section("OPERATORS");
  for (const algebra3d::Family& family : registry.families()) {
    std::vector<std::string_view> names;
    for (const algebra3d::Operator* op : registry.operators_of(family.name)) names.push_back(op->name);
    text += paragraph(italic(family.name), fmt::format("{}", fmt::join(names, ", ")));
  }
  return text;
}

}  // namespace

std::string man_page(const CommandLine& program, const algebra3d::Registry& registry) {
  const std::size_t colon = program.meaning.find(": ");
  const std::string meaning = colon == std::string::npos ? program.meaning : program.meaning.substr(colon + 2);
  std::string text = fmt::format(".TH ALGEBRA3D 1 \"\" \"algebra3d {}\" \"User Commands\"\n", algebra3d::kVersion);
  text += section("NAME") + "algebra3d \\- " + roff_text(meaning) + "\n";
  CommandLine named = program;
  named.name = "algebra3d";
  text += section("SYNOPSIS") + synopsis(named, "");
  for (const CommandLine& subcommand : program.subcommands)
    text += ".br\n" + synopsis(subcommand, bold("algebra3d") + " ");
  text += section("OPTIONS") + arguments_text(program);
  text += section("SUBCOMMANDS");
  for (const CommandLine& subcommand : program.subcommands) text += subcommand_text(subcommand);
  return text + language_text(registry) + section("NOTES") + remarks(program.remarks);
}

}  // namespace queries
