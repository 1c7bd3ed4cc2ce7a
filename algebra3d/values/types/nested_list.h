#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// A nested list: an atom or a list. The external representation of all data of the language. A regular value type.
/// Equality is structural; atoms of different kinds are never equal (int 1 is not real 1.0).
class NestedList {
 public:
  struct Symbol {
    std::string name;
    friend bool operator==(const Symbol&, const Symbol&) = default;
  };
  struct Text {
    std::string content;
    friend bool operator==(const Text&, const Text&) = default;
  };
  using List = std::vector<NestedList>;

  /// Deepest nesting that `parse` accepts.
  static constexpr int kMaxDepth = 1000;

  NestedList() : content_(List{}) {}  ///< the empty list
  /// int atom
  template <std::signed_integral Integer>
  explicit NestedList(Integer value) : content_(std::int64_t{value}) {}
  explicit NestedList(double value) : content_(value) {}
  explicit NestedList(bool value) : content_(value) {}
  explicit NestedList(std::string value) : content_(std::move(value)) {}  ///< string atom
  explicit NestedList(Text value) : content_(std::move(value)) {}
  explicit NestedList(Symbol value) : content_(std::move(value)) {}
  explicit NestedList(List elements) : content_(std::move(elements)) {}
  NestedList(const char*) = delete;

  static NestedList symbol(std::string name) { return NestedList(Symbol{std::move(name)}); }
  static NestedList text(std::string content) { return NestedList(Text{std::move(content)}); }
  template <typename... Elements>
  static NestedList list(Elements&&... elements) {
    List content;
    content.reserve(sizeof...(elements));
    (content.push_back(std::forward<Elements>(elements)), ...);
    return NestedList(std::move(content));
  }

  bool is_list() const { return std::holds_alternative<List>(content_); }
  bool is_symbol() const { return std::holds_alternative<Symbol>(content_); }
  bool is_symbol(std::string_view name) const { return is_symbol() && as_symbol() == name; }
  bool is_int() const { return std::holds_alternative<std::int64_t>(content_); }
  bool is_real() const { return std::holds_alternative<double>(content_); }
  bool is_bool() const { return std::holds_alternative<bool>(content_); }
  bool is_string() const { return std::holds_alternative<std::string>(content_); }
  bool is_text() const { return std::holds_alternative<Text>(content_); }
  /// `undefined` in any of the spellings that the language accepts on input.
  bool is_undefined() const;

  // Access to the content; requires the kind that the function names.
  const List& elements() const { return std::get<List>(content_); }
  List& elements() { return std::get<List>(content_); }
  const std::string& as_symbol() const { return std::get<Symbol>(content_).name; }
  std::int64_t as_int() const { return std::get<std::int64_t>(content_); }
  double as_real() const { return std::get<double>(content_); }
  bool as_bool() const { return std::get<bool>(content_); }
  const std::string& as_string() const { return std::get<std::string>(content_); }
  const std::string& as_text() const { return std::get<Text>(content_).content; }

  /// Parses one list or atom, surrounded by white space and `_! ... !_` comments: lists in parentheses, ints, reals,
  /// TRUE/FALSE, "strings", 'texts' and <text>...</text--->, symbols (words, runs of special characters, and `p/q`). An
  /// integer beyond 64 bits becomes a real. In strings and texts a backslash escapes a quote or a backslash; any other
  /// backslash is an ordinary character. Atoms are separated by white space, parentheses or comments. Errors:
  /// invalid_value with line and column of the source (which begins at `start`), what was found and what was expected;
  /// limit_exceeded. Invalid UTF-8 in strings and texts is an error. Cost: linear, no recursion.
  static Result<NestedList> parse(std::string_view source, const SourcePlace& start = {{}, 1, 1});

  /// Text that `parse` reads back as an equal list, with single blanks and without line breaks outside of strings and
  /// texts. Requires finite reals and symbols that `parse` can return.
  std::string print() const;
  void print_to(std::string& text) const;
  /// `print` for messages: cut after `limit` characters and marked with "...".
  std::string print_short(std::size_t limit = 60) const;

  friend bool operator==(const NestedList&, const NestedList&) = default;

 private:
  std::variant<List, std::int64_t, double, bool, std::string, Text, Symbol> content_;
};

}  // namespace algebra3d
