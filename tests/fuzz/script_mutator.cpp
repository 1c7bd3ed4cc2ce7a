#include "fuzz/script_mutator.h"

#include <algorithm>
#include <cctype>

#include "fuzz/script_trial.h"

namespace queries::fuzz {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

std::size_t end_of_token(std::string_view text, std::size_t begin) {
  const char first = text[begin];
  if (first == '\'' || first == '"') {
    std::size_t end = begin + 1;
    while (end < text.size() && text[end] != first) end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
  }
  std::size_t end = begin + 1;
  if (is_word(first))
    while (end < text.size() && is_word(text[end])) ++end;
  else if (std::string_view("()[]{},;").find(first) == std::string_view::npos)
    while (end < text.size() && std::string_view("<>=:*+-/#|").find(text[end]) != std::string_view::npos) ++end;
  return end;
}

std::string_view shown(std::string_view text, const Piece& piece) {
  return text.substr(piece.begin, piece.end - piece.begin);
}

std::string replaced(const std::string& text, const Piece& piece, std::string_view by) {
  std::string result = text;
  return result.replace(piece.begin, piece.end - piece.begin, by);
}

std::string joined(const std::vector<std::string>& commands) {
  std::string script;
  for (const std::string& command : commands) script += command + ";\n";
  return script;
}

}  // namespace

std::vector<Piece> tokens_of(std::string_view command) {
  std::vector<Piece> tokens;
  for (std::size_t begin = 0; begin < command.size();) {
    if (std::isspace(static_cast<unsigned char>(command[begin])) != 0) {
      ++begin;
      continue;
    }
    tokens.push_back({begin, end_of_token(command, begin)});
    begin = tokens.back().end;
  }
  return tokens;
}

std::vector<Piece> brackets_of(std::string_view command, const std::vector<Piece>& tokens) {
  std::vector<Piece> brackets;
  std::vector<std::size_t> open;
  for (const Piece& token : tokens) {
    const char c = command[token.begin];
    if (c == '(' || c == '[' || c == '{') open.push_back(token.begin);
    if ((c != ')' && c != ']' && c != '}') || open.empty()) continue;
    brackets.push_back({open.back(), token.end});
    open.pop_back();
  }
  return brackets;
}

std::string ScriptMutator::changed(const std::string& command, Dice& dice) {
  const auto tokens = tokens_of(command);
  if (tokens.empty()) return grammar_.command(dice);
  const auto brackets = brackets_of(command, tokens);
  const Piece token = dice.of(tokens);
  const std::string old(shown(command, token));
  switch (dice.below(12)) {
    case 0:
      return replaced(command, token, grammar_.word(dice));
    case 1:
      return replaced(command, token, "");
    case 2:
      return replaced(command, token, old + " " + old);
    case 3:
      return replaced(command, token, old + " " + grammar_.word(dice) + " ");
    case 4:
      return replaced(command, token, shown(command, dice.of(tokens)));
    case 5:
      return replaced(command, token, "(" + grammar_.query(dice) + ")");
    case 6:
      return brackets.empty() ? command : replaced(command, dice.of(brackets), shown(command, dice.of(brackets)));
    case 7:
      return brackets.empty() ? command : replaced(command, dice.of(brackets), "(" + grammar_.query(dice) + ")");
    case 8:
      return mutate_bytes_(command);
    default:
      break;
  }
  // Most often an operator becomes one that is written in the same way.
  for (int tries = 0; tries < 8; ++tries) {
    const Piece other = dice.of(tokens);
    const auto& alike = grammar_.written_like(std::string(shown(command, other)));
    if (!alike.empty()) return replaced(command, other, dice.of(alike));
  }
  return replaced(command, token, grammar_.word(dice));
}

std::string ScriptMutator::mutated(std::string_view script, Dice& dice) {
  std::vector<std::string> commands = commands_of(script);
  if (commands.size() > kMaxCommands) commands.resize(kMaxCommands);
  for (std::size_t changes = 1 + dice.below(3); changes > 0; --changes) {
    const std::size_t place = dice.below(commands.size());
    const auto at = commands.begin() + static_cast<std::ptrdiff_t>(place);
    const std::size_t kind = commands.empty() ? 0 : dice.below(10);
    if (kind <= 2)
      commands.insert(commands.begin() + static_cast<std::ptrdiff_t>(dice.below(commands.size() + 1)),
                      grammar_.command(dice));
    else if (kind == 3)
      commands.erase(at);
    else if (kind == 4)
      std::swap(commands[place], dice.one_in(2) ? commands.front() : commands.back());
    else if (kind == 5)
      commands[place] = grammar_.command(dice);
    else
      commands[place] = changed(commands[place], dice);
  }
  while (commands.size() > 1 && (commands.size() > kMaxCommands || joined(commands).size() > kMaxScriptBytes))
    commands.erase(commands.begin() + static_cast<std::ptrdiff_t>(dice.below(commands.size())));
  return joined(commands);
}

std::string ScriptMutator::crossed(std::string_view script, std::string_view other, Dice& dice) {
  std::vector<std::string> commands = commands_of(script);
  const std::vector<std::string> others = commands_of(other);
  if (commands.empty() || others.empty()) return mutated(script, dice);
  std::string& target = commands[dice.below(commands.size())];
  const std::string& source = dice.of(others);
  const auto target_brackets = brackets_of(target, tokens_of(target));
  const auto source_brackets = brackets_of(source, tokens_of(source));
  if (target_brackets.empty() || source_brackets.empty() || dice.one_in(2))
    commands.insert(commands.begin() + static_cast<std::ptrdiff_t>(dice.below(commands.size() + 1)), source);
  else
    target = replaced(target, dice.of(target_brackets), shown(source, dice.of(source_brackets)));
  return joined(commands);
}

}  // namespace queries::fuzz
