#include "queries/shell/detail/completion_script.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algebra3d/operators/registry/operator.h"
#include "queries/language/command_list.h"
#include "queries/shell/detail/command_table.h"

namespace queries {
namespace {

bool is_plain_name(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

// What `help` explains: operators, families, commands. Operators such as `+` need no completion.
std::vector<std::string> topics(const algebra3d::Registry& registry) {
  std::set<std::string> names;
  for (const algebra3d::Operator* op : registry.operators())
    if (is_plain_name(op->name)) names.insert(op->name);
  for (const algebra3d::Family& family : registry.families())
    if (is_plain_name(family.name)) names.insert(family.name);
  for (const CommandDescription& command : command_list()) {
    const std::string_view word = command.syntax.substr(0, command.syntax.find(' '));
    if (is_plain_name(word)) names.emplace(word);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> names_of_options(const CommandLine& line) {
  std::vector<std::string> names;
  for (const CommandLineArgument& argument : line.arguments)
    if (!argument.is_positional) names.insert(names.end(), argument.names.begin(), argument.names.end());
  return names;
}

std::vector<std::string> names_of_subcommands(const CommandLine& program) {
  std::vector<std::string> names;
  for (const CommandLine& subcommand : program.subcommands) names.push_back(subcommand.name);
  return names;
}

// --- bash

// The words that may stand behind an option with a value: arguments of compgen; empty for any.
std::string bash_value(const CommandLineArgument& argument) {
  if (!argument.choices.empty()) return fmt::format("-W '{}'", fmt::join(argument.choices, " "));
  const std::string_view kind = completed_as(argument);
  return kind == "file" ? "-f" : kind == "folder" ? "-d" : "";
}

// Options with values, each with its action; the same name means the same everywhere.
std::string bash_values(const CommandLine& program) {
  std::set<std::string> cases;
  const auto add = [&cases](const CommandLine& line) {
    for (const CommandLineArgument& argument : line.arguments)
      if (const std::string words = bash_value(argument); !argument.value.empty())
        cases.insert(fmt::format("    {}){} return ;;\n", fmt::join(argument.names, "|"),
                                 words.empty() ? "" : " _algebra3d_words " + words + ";"));
  };
  add(program);
  for (const CommandLine& subcommand : program.subcommands) add(subcommand);
  std::string text;
  for (const std::string& each : cases) text += each;
  return text;
}

std::string bash_options(const CommandLine& program) {
  std::string text;
  for (const CommandLine& subcommand : program.subcommands)
    text += fmt::format("    {}) options='{}' ;;\n", subcommand.name, fmt::join(names_of_options(subcommand), " "));
  return text + fmt::format("    *) options='{}' ;;\n", fmt::join(names_of_options(program), " "));
}

// --- zsh

std::string zsh_quoted(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string zsh_action(const CommandLineArgument& argument) {
  if (!argument.choices.empty()) return fmt::format("({})", fmt::join(argument.choices, " "));
  const std::string_view kind = completed_as(argument);
  return kind == "file" ? "_files" : kind == "folder" ? "_files -/" : " ";
}

// What _arguments wants for one option or positional argument.
std::string zsh_argument(const CommandLineArgument& argument, const std::string& action) {
  if (argument.is_positional)
    return fmt::format(" '{}:{}:{}'", argument.is_repeated ? "*" : "", zsh_quoted(argument.names.front()), action);
  std::string text;
  for (const std::string& name : argument.names) {
    text += fmt::format(" '{}{}[{}]", argument.is_repeated ? "*" : "", name, zsh_quoted(argument.meaning));
    text += argument.value.empty() ? "'" : fmt::format(":{}:{}'", zsh_quoted(argument.value), action);
  }
  return text;
}

std::string zsh_options(const CommandLine& line) {
  std::string text;
  for (const CommandLineArgument& argument : line.arguments)
    if (!argument.is_positional) text += zsh_argument(argument, zsh_action(argument));
  return text;
}

std::string zsh_positional_arguments(const CommandLine& line, const std::vector<std::string>& topics_of_help) {
  std::string text;
  for (const CommandLineArgument& argument : line.arguments)
    if (argument.is_positional)
      text += zsh_argument(
          argument, line.name == "help" ? fmt::format("({})", fmt::join(topics_of_help, " ")) : zsh_action(argument));
  return text;
}

}  // namespace

std::string bash_completion(const CommandLine& program, const algebra3d::Registry& registry) {
  return fmt::format(R"(# bash completion of algebra3d; made by `algebra3d help --completion bash`
_algebra3d_words() {{
  mapfile -t COMPREPLY < <(compgen "$@" -- "$word")
}}
_algebra3d() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command='' options i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in {1}) command=${{COMP_WORDS[i]}}; break ;; esac
  done
  COMPREPLY=()
  case $before in
{2}  esac
  case $command in
{3}  esac
  if [[ $word == -* ]]; then
    _algebra3d_words -W "$options"
  elif [[ $command == help ]]; then
    _algebra3d_words -W '{4}'
  elif [[ -z $command && $COMP_CWORD -eq 1 ]]; then
    _algebra3d_words -f -W '{0}'
  else
    _algebra3d_words -f
  fi
}}
complete -o filenames -F _algebra3d algebra3d
)",
                     fmt::join(names_of_subcommands(program), " "), fmt::join(names_of_subcommands(program), "|"),
                     bash_values(program), bash_options(program), fmt::join(topics(registry), " "));
}

std::string zsh_completion(const CommandLine& program, const algebra3d::Registry& registry) {
  std::string commands;
  std::string cases;
  for (const CommandLine& subcommand : program.subcommands) {
    commands += fmt::format(" '{}:{}'", subcommand.name, zsh_quoted(subcommand.meaning));
    cases += fmt::format("        {}) _arguments{}{} ;;\n", subcommand.name, zsh_options(subcommand),
                         zsh_positional_arguments(subcommand, topics(registry)));
  }
  return fmt::format(R"(#compdef algebra3d
# zsh completion of algebra3d; made by `algebra3d help --completion zsh`
_algebra3d() {{
  local curcontext="$curcontext" state line
  local -a commands=({0})
  _arguments -C{1} '1: :->first' '*:: :->rest'
  case $state in
    first)
      _describe command commands
      _files
      ;;
    rest)
      case $words[1] in
{2}        *) _arguments{1} '*:FILE:_files' ;;
      esac
      ;;
  esac
}}
_algebra3d "$@"
)",
                     commands, zsh_options(program), cases);
}

}  // namespace queries
