#include "queries/shell/detail/completion.h"

#include <algorithm>
#include <cctype>

#include "queries/language/command_list.h"
#include "queries/shell/detail/command_table.h"

namespace queries {
namespace {

constexpr std::string_view kBlanks = " \t\n";

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return words;
    text.remove_prefix(begin);
    words.push_back(text.substr(0, text.find_first_of(kBlanks)));
    text.remove_prefix(words.back().size());
  }
}

// A word of the table in capital letters stands for something.
bool is_placeholder(std::string_view word) {
  return std::ranges::all_of(word, [](char c) { return c >= 'A' && c <= 'Z'; });
}

// From such a word on the text is no longer one of single words.
bool takes_the_rest(std::string_view word) {
  return word == "EXPRESSION" || word == "TYPE" || word == "COMMAND" || word == "BOOL";
}

bool fits(std::string_view pattern, std::string_view word) {
  if (takes_the_rest(pattern)) return false;
  return is_placeholder(pattern) ? word != "database" && word != "type" : pattern == word;
}

// The words at the end of the text.
struct Surroundings {
  std::size_t command_begin = 0;
  char quote = '\0';  // of the literal that is open there
  std::size_t literal_begin = 0;
};

Surroundings surroundings(std::string_view text) {
  Surroundings result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (result.quote == '\0') {
      if (c == '"' || c == '\'') {
        result.quote = c;
        result.literal_begin = i + 1;
      }
      if (c == ';') result.command_begin = i + 1;
    } else if (c == '\\' && i + 1 < text.size() && (text[i + 1] == result.quote || text[i + 1] == '\\')) {
      ++i;
    } else if (c == result.quote) {
      result.quote = '\0';
    }
  }
  result.command_begin = std::min(text.find_first_not_of(kBlanks, result.command_begin), text.size());
  return result;
}

class Completer {
 public:
  Completer(std::string_view text, const CompletionNames& names)
      : text_(text), surroundings_(surroundings(text)), names_(names) {}

  Completion run();

 private:
  void add(std::string_view candidate, std::string_view suffix = "");
  void add_all(const std::vector<std::string>& candidates, std::string_view suffix = "");
  void begin_word(std::size_t begin);
  bool add_command_words();
  void add_placeholder(std::string_view word);
  void add_files(std::size_t begin, std::string_view closing);
  void add_names();
  bool is_after_control_word() const;
  std::vector<std::string_view> words_before() const;

  std::string_view text_;  // up to the cursor
  Surroundings surroundings_;
  const CompletionNames& names_;
  std::string_view typed_;  // the beginning of the word
  Completion result_;
};

void Completer::begin_word(std::size_t begin) {
  result_.begin = begin;
  typed_ = text_.substr(begin);
}

void Completer::add(std::string_view candidate, std::string_view suffix) {
  if (candidate.starts_with(typed_)) result_.candidates.push_back({std::string(candidate), std::string(suffix)});
}

void Completer::add_all(const std::vector<std::string>& candidates, std::string_view suffix) {
  for (const std::string& candidate : candidates) add(candidate, suffix);
}

void Completer::add_files(std::size_t begin, std::string_view closing) {
  begin_word(begin);
  for (const std::string& file : names_.files(std::string(typed_))) add(file, file.ends_with('/') ? "" : closing);
}

void Completer::add_placeholder(std::string_view word) {
  if (word == "OBJECT") add_all(names_.objects, " ");
  if (word == "DATABASE") add_all(names_.databases);
  if (word == "OPERATOR") {
    for (const Candidate& op : names_.operators) add(op.text);
    for (const CommandDescription& command : command_list())
      if (std::isalpha(static_cast<unsigned char>(command.syntax.front())) != 0)
        add(command.syntax.substr(0, command.syntax.find(' ')));
  }
}

std::vector<std::string_view> Completer::words_before() const {
  const std::size_t begin = surroundings_.command_begin;
  return words_of(text_.substr(begin, std::max(result_.begin, begin) - begin));
}

// Goes along with every command of the table whose words fit those before the cursor. False in the middle of an
// expression, which has no words of its own.
bool Completer::add_command_words() {
  const std::size_t blank = text_.find_last_of(kBlanks);
  begin_word(std::max(blank == std::string_view::npos ? 0 : blank + 1, surroundings_.command_begin));
  if (!typed_.starts_with('"') && !std::ranges::all_of(typed_, is_word_character)) return false;
  const auto before = words_before();
  bool is_expression = false;
  for (const CommandDescription& command : command_list()) {
    const auto pattern = words_of(command.syntax);
    std::size_t place = 0;
    while (place < before.size() && place < pattern.size() && fits(pattern[place], before[place])) ++place;
    if (place == pattern.size()) continue;
    if (takes_the_rest(pattern[place])) is_expression = true;
    if (place < before.size()) continue;
    if (is_placeholder(pattern[place]))
      add_placeholder(pattern[place]);
    else if (is_word_character(pattern[place].front()) || pattern[place].front() == '"')
      add(pattern[place], place + 1 < pattern.size() ? " " : "");
  }
  return !is_expression;
}

bool Completer::is_after_control_word() const {
  const auto before = words_before();
  if (before.empty()) return false;
  const std::string_view last = before.back();
  return last == "then" || last == "else" || last == "do" || last == "{" || last == "{{" || last == "|";
}

void Completer::add_names() {
  std::size_t begin = text_.size();
  while (begin > 0 && is_word_character(text_[begin - 1])) --begin;
  begin_word(begin);
  if (begin > 0 && text_[begin - 1] == '.') return add_all(names_.attributes);
  if (is_after_control_word())
    for (const CommandDescription& command : command_list())
      add(command.syntax.substr(0, command.syntax.find(' ')), " ");
  add_all(names_.objects, " ");
  // All that there is would be of no use.
  if (typed_.empty()) return;
  for (const Candidate& op : names_.operators) add(op.text, op.suffix);
  add_all(names_.types, " ");
  add_all(names_.attributes);
}

Completion Completer::run() {
  const std::size_t first = surroundings_.command_begin;
  if (text_.substr(first).starts_with('@')) {
    add_files(std::min(text_.find_first_not_of("@%& ", first), text_.size()), "");
  } else if (surroundings_.quote == '\'') {
    add_files(surroundings_.literal_begin, "'");
  } else if (!add_command_words()) {
    result_.candidates.clear();
    if (surroundings_.quote == '\0') add_names();
  }
  std::ranges::sort(result_.candidates, {}, &Candidate::text);
  const auto is_same = [](const Candidate& a, const Candidate& b) { return a.text == b.text; };
  auto& candidates = result_.candidates;
  candidates.erase(std::unique(candidates.begin(), candidates.end(), is_same), candidates.end());
  return std::move(result_);
}

}  // namespace

Completion complete(std::string_view text, std::size_t cursor, const CompletionNames& names) {
  return Completer(text.substr(0, cursor), names).run();
}

std::string common_beginning(const std::vector<Candidate>& candidates) {
  if (candidates.empty()) return {};
  std::string_view common = candidates.front().text;
  for (const Candidate& candidate : candidates) {
    const auto [end, other] = std::ranges::mismatch(common, candidate.text);
    common = common.substr(0, static_cast<std::size_t>(end - common.begin()));
  }
  return std::string(common);
}

}  // namespace queries
