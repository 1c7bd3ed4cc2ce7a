#include "algebra3d/values/types/nested_list.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/interruption_scope.h"
#include "base/number_text.h"
#include "base/text.h"

namespace algebra3d {

namespace {

constexpr auto kUnlimited = static_cast<std::size_t>(-1);

// Writes one list and stops as soon as the text is longer than `limit`, so that the beginning of a long list costs no
// more than itself. The stack is explicit: a list put together by a program may be deeper than one that was parsed.
class Printer {
 public:
  Printer(std::string& text, std::size_t limit) : text_(text), limit_(limit) {}

  void print(const NestedList& list) {
    begin(list);
    while (!open_.empty() && text_.size() <= limit_) {
      auto& [next, end, is_first] = open_.back();
      if (next == end) {
        text_ += ')';
        open_.pop_back();
        continue;
      }
      if (!is_first) text_ += ' ';
      is_first = false;
      begin(*next++);  // the references above end here: `begin` may move the stack
    }
  }

 private:
  struct OpenList {
    const NestedList* next;
    const NestedList* end;
    bool is_first = true;
  };

  void begin(const NestedList& list) {
    poll_interruption();
    if (list.is_list()) {
      const auto& elements = list.elements();
      text_ += '(';
      open_.push_back({elements.data(), elements.data() + elements.size()});
    } else {
      print_atom(list);
    }
  }

  void print_atom(const NestedList& atom) {
    if (atom.is_int()) {
      const fmt::format_int digits(atom.as_int());
      text_.append(digits.data(), digits.size());
    } else if (atom.is_real()) {
      append_real(text_, atom.as_real());
    } else if (atom.is_bool()) {
      text_ += atom.as_bool() ? "TRUE" : "FALSE";
    } else if (atom.is_symbol()) {
      text_ += start_of(atom.as_symbol());
    } else if (atom.is_string()) {
      print_quoted(start_of(atom.as_string()), '"');
    } else {
      print_quoted(start_of(atom.as_text()), '\'');
    }
  }

  void print_quoted(std::string_view content, char quote) {
    text_ += quote;
    while (true) {
      const auto plain = find_either(content, quote, '\\');
      text_ += content.substr(0, plain);
      if (plain == std::string_view::npos) break;
      text_ += '\\';
      text_ += content[plain];
      content.remove_prefix(plain + 1);
    }
    text_ += quote;
  }

  // More than the limit, so that the caller sees that something is missing.
  std::string_view start_of(std::string_view content) const {
    return limit_ == kUnlimited ? content : content.substr(0, limit_ + 1);
  }

  std::string& text_;
  std::size_t limit_;
  std::vector<OpenList> open_;
};

}  // namespace

bool NestedList::is_undefined() const {
  constexpr std::array<std::string_view, 6> kSpellings{"undefined", "undef", "UNDEFINED", "UNDEF", "null", "NULL"};
  return is_symbol() && std::find(kSpellings.begin(), kSpellings.end(), as_symbol()) != kSpellings.end();
}

std::string NestedList::print() const {
  std::string text;
  print_to(text);
  return text;
}

void NestedList::print_to(std::string& text) const {
  Printer(text, kUnlimited).print(*this);
}

std::string NestedList::print_short(std::size_t limit) const {
  std::string text;
  Printer(text, limit).print(*this);
  if (text.size() > limit) {
    text.resize(utf8_prefix(text, limit).size());
    text += "...";
  }
  return text;
}

}  // namespace algebra3d
