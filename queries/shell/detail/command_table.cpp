#include "queries/shell/detail/command_table.h"

#include <array>
#include <cctype>
#include <vector>

#include <fmt/format.h>

#include "algebra3d/operators/registry/operator.h"
#include "queries/language/command_list.h"
#include "queries/language/documentation.h"

namespace queries {
namespace {

constexpr std::string_view kPromptHelp =
    "  Tab completes commands, operators, objects, types, attributes after a dot, and files in 'quotes'.\n"
    "  Up, Down and Ctrl-R find earlier commands. A command may take several lines, up to its ';' or an empty line.\n"
    "  Ctrl-C discards the command that is being typed, or ends the running one.\n";

constexpr std::string_view kTableHelp =
    "A table is a relation: tuples (rows) with named attributes (columns), of a type such as\n"
    "rel(tuple([Name: string, Solid: volume3d])).\n"
    "  query Parts            shows all of it\n"
    "  Parts feed             makes a stream of its tuples, for operators such as filter, project and sortby\n"
    "  STREAM consume         makes a relation of a stream, as in\n"
    "                         let Large = Parts feed filter[volume(.Solid) > 1.0] consume\n"
    "Families of operators on tables (`help FAMILY` lists one): streams, attributes, order, groups, joins,\n"
    "sorted streams, changes of relations, indexes, aggregates, tables from files.\n"
    "These operators make a stream of tuples from values:\n";

std::string first_word(std::string_view syntax) {
  return std::string(syntax.substr(0, syntax.find(' ')));
}

std::string command_lines(std::string_view word) {
  constexpr std::size_t kWidth = 32;
  std::string text;
  for (const auto& [syntax, meaning] : command_list())
    if (word.empty() || first_word(syntax) == word)
      text += syntax.size() > kWidth ? fmt::format("  {}\n  {:{}}  {}\n", syntax, "", kWidth, meaning)
                                     : fmt::format("  {:{}}  {}\n", syntax, kWidth, meaning);
  return text;
}

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool contains(std::string_view text, const std::string& lower_case_part) {
  return in_lower_case(text).find(lower_case_part) != std::string::npos;
}

std::string families_text(const algebra3d::Registry& registry) {
  return "Families of operators (`help FAMILY` lists one)\n" + family_overview(registry);
}

std::string table_text(const algebra3d::Registry& registry) {
  std::vector<const algebra3d::Operator*> makers = registry.operators();
  std::erase_if(makers, [](const auto* op) { return op->kind() != algebra3d::OperatorKind::table; });
  return std::string(kTableHelp) + help_overview(makers);
}

// Empty if there is no such family.
std::string family_text(const std::string& name, const algebra3d::Registry& registry) {
  for (const algebra3d::Family& family : registry.families())
    if (algebra3d::is_equal_but_for_case(family.name, name))
      return fmt::format("{}\n  {}\n\n{}", family.name, family.doc, help_overview(registry.operators_of(family.name)));
  return "";
}

// Operators and commands that a word leads to; empty if there is none.
std::string search_text(const std::string& word, const algebra3d::Registry& registry) {
  const std::string part = in_lower_case(word);
  std::vector<const algebra3d::Operator*> named;
  std::vector<const algebra3d::Operator*> described;
  for (const algebra3d::Operator* op : registry.operators()) {
    if (contains(op->name, part) || contains(op->family, part))
      named.push_back(op);
    else if (contains(op->doc, part) || contains(op->detail, part))
      described.push_back(op);
  }
  std::string commands;
  for (const auto& [syntax, meaning] : command_list())
    if (contains(syntax, part) || contains(meaning, part))
      commands += fmt::format("  {:{}}  {}\n", syntax, 32, meaning);
  std::string text;
  if (!named.empty()) text += fmt::format("Operators with '{}' in their names\n{}", word, help_overview(named));
  if (!described.empty())
    text += fmt::format("{}Operators with '{}' in their descriptions\n{}", text.empty() ? "" : "\n", word,
                        help_overview(described));
  if (!commands.empty()) text += fmt::format("{}Commands with '{}'\n{}", text.empty() ? "" : "\n", word, commands);
  return text;
}

}  // namespace

std::string shell_help(const algebra3d::Registry& registry) {
  return fmt::format(
      "New here? The tutorial leads to answers on your own files in a quarter of an hour: docs/tutorial.md in the\n"
      "sources, /usr/share/doc/algebra3d/docs/tutorial.md in the package.\n\n"
      "Commands (`help NAME` explains a command or an operator, `help WORD` finds one)\n{}\nThe "
      "prompt\n{}\n{}",
      command_lines(""), kPromptHelp, families_text(registry));
}

std::string exact_help(const std::string& name, const algebra3d::Registry& registry) {
  std::string text = command_lines(name);
  const algebra3d::Operator* op = registry.find_operator(name);
  if (op != nullptr) text += (text.empty() ? "" : "\n") + help_text(*op, registry);
  return text;
}

algebra3d::Result<std::string> shell_help(const std::string& name, const algebra3d::Registry& registry) {
  if (name == "families") return families_text(registry);
  if (name == "table" || name == "tables") return table_text(registry);
  std::string text = exact_help(name, registry);
  if (text.empty()) text = family_text(name, registry);
  if (text.empty()) text = search_text(name, registry);
  if (!text.empty()) return text;
  std::vector<std::string> names;
  for (const algebra3d::Operator* each : registry.operators()) names.push_back(each->name);
  for (const auto& [syntax, meaning] : command_list()) names.push_back(first_word(syntax));
  const std::string nearest = algebra3d::nearest_name(name, names);
  return algebra3d::Error{algebra3d::ErrorCode::unknown_name,
                          "there is no operator or command '{}', and no description has the word{}", name,
                          nearest.empty() ? "" : "; did you mean '" + nearest + "'?"};
}

}  // namespace queries
