#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/values/types/expression_list.h"
#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/nested_list.h"
#include "algebra3d/values/types/utf8.h"
#include "base/interruption_scope.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "base/text.h"

namespace algebra3d {

namespace {

enum class CharClass : std::uint8_t { other, blank, open, close, quote, letter, digit, special };

constexpr std::array<CharClass, 256> make_char_classes() {
  std::array<CharClass, 256> classes{};
  const auto set = [&](std::string_view characters, CharClass char_class) {
    for (const char character : characters) classes[static_cast<unsigned char>(character)] = char_class;
  };
  set(" \t\n\r\v\f", CharClass::blank);
  set("(", CharClass::open);
  set(")", CharClass::close);
  set(R"("')", CharClass::quote);
  set("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_", CharClass::letter);
  set("0123456789", CharClass::digit);
  set("!#$%&*+,-./:;<=>?@[\\]^`{|}~", CharClass::special);
  return classes;
}

constexpr auto kCharClasses = make_char_classes();

CharClass class_of(char character) {
  return kCharClasses[static_cast<unsigned char>(character)];
}

bool is_digit(char character) {
  return class_of(character) == CharClass::digit;
}

bool is_integer(std::string_view token) {
  if (token.starts_with('-')) token.remove_prefix(1);
  return !token.empty() && std::all_of(token.begin(), token.end(), is_digit);
}

// Fifteen digits, and a sign, always fit a double.
bool is_inexact_integer(std::string_view token) {
  constexpr std::size_t kDigitsOfEveryDouble = 15;
  if (token.size() <= kDigitsOfEveryDouble || !is_integer(token)) return false;
  const auto exact = Rational::parse(token);
  return exact && std::isfinite(exact->nearest_double()) && !exact->is_double();
}

bool starts_number(std::string_view token) {
  std::size_t position = 0;
  if (position < token.size() && (token[position] == '-' || token[position] == '+')) ++position;
  if (position < token.size() && token[position] == '.') ++position;
  return position < token.size() && is_digit(token[position]);
}

bool is_fraction(std::string_view token) {
  if (token.starts_with('-')) token.remove_prefix(1);
  const auto slash = token.find('/');
  if (slash == std::string_view::npos) return false;
  const auto numerator = token.substr(0, slash);
  const auto denominator = token.substr(slash + 1);
  return !numerator.empty() && !denominator.empty() && std::all_of(numerator.begin(), numerator.end(), is_digit) &&
         std::all_of(denominator.begin(), denominator.end(), is_digit);
}

bool is_word(std::string_view token) {
  return class_of(token[0]) == CharClass::letter && std::all_of(token.begin(), token.end(), [](char character) {
           return class_of(character) == CharClass::letter || is_digit(character);
         });
}

bool is_special_run(std::string_view token) {
  return std::all_of(token.begin(), token.end(),
                     [](char character) { return class_of(character) == CharClass::special; });
}

constexpr std::string_view kOverOne = "/1";
constexpr std::string_view kCommentBegin = "_!";
constexpr std::string_view kCommentEnd = "!_";
constexpr std::string_view kTextBegin = "<text>";
constexpr std::string_view kTextEnd = "</text--->";
constexpr auto kNowhere = std::string_view::npos;

// Reads one list without recursion. The complete elements lie on one stack, the elements of the outermost open list
// lowest; a closing parenthesis moves the elements above its opening one into a list of exactly the right size.
class Parser {
 public:
  enum class LargeIntegers : std::uint8_t { become_reals, are_kept };

  Parser(std::string_view source, const SourcePlace& start, LargeIntegers large_integers)
      : source_(source), start_(start), large_integers_(large_integers) {}

  Result<NestedList> run() {
    do {
      poll_interruption();
      A3D_TRY(skip_blanks());
      A3D_TRY(read_token());
    } while (!open_.empty());
    A3D_TRY(skip_blanks());
    if (!at_end()) return expected("the end of the list", position_);
    return std::move(complete_.front());
  }

 private:
  struct OpenList {
    std::size_t position;  // of its parenthesis
    std::size_t first;     // its first element on `complete_`
  };

  bool at_end() const { return position_ == source_.size(); }
  std::string_view rest() const { return source_.substr(position_); }

  Error error_at(std::size_t end, ErrorCode code, std::string message) const {
    return Error(code, std::move(message)).at(place_behind(source_.substr(0, end), start_));
  }

  Error expected(std::string_view what, std::size_t position) const {
    return error_at(position, ErrorCode::invalid_value, fmt::format("expected {}, found {}", what, found_at(position)));
  }

  // A description of the text at `position`: the end, or the token there if it can be shown.
  std::string found_at(std::size_t position) const {
    if (position == source_.size()) return "the end of the text";
    const auto first = source_[position];
    if (class_of(first) == CharClass::other) {
      return fmt::format("the byte 0x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(first)));
    }
    const auto token = source_.substr(position, bare_end(position) - position);
    const auto shown = token.empty() ? source_.substr(position, 1) : utf8_prefix(token, kShownLength);
    if (first_invalid_utf8(shown) != kNowhere) return "bytes that are not valid UTF-8";
    return fmt::format("{}{}", shown, shown.size() < token.size() ? "..." : "");
  }

  Status skip_blanks() {
    while (!at_end()) {
      if (class_of(source_[position_]) == CharClass::blank) {
        ++position_;
      } else if (rest().starts_with(kCommentBegin)) {
        const auto end = source_.find(kCommentEnd, position_ + kCommentBegin.size());
        if (end == kNowhere) return error_at(position_, ErrorCode::invalid_value, "this comment is not closed by !_");
        position_ = end + kCommentEnd.size();
      } else {
        break;
      }
    }
    return {};
  }

  Status read_token() {
    if (at_end()) return ended_early();
    switch (class_of(source_[position_])) {
      case CharClass::open:
        return open_list();
      case CharClass::close:
        return close_list();
      case CharClass::quote:
        A3D_TRY(read_quoted(source_[position_]));
        break;
      case CharClass::other:
        return expected("a list or an atom", position_);
      default:
        A3D_TRY(read_unquoted());
    }
    return check_separated();
  }

  Status ended_early() const {
    if (open_.empty()) return expected("a list or an atom", position_);
    return error_at(open_.back().position, ErrorCode::invalid_value,
                    "expected a closing parenthesis for this one, found the end of the text");
  }

  Status open_list() {
    if (open_.size() == static_cast<std::size_t>(NestedList::kMaxDepth)) {
      return error_at(position_, ErrorCode::limit_exceeded,
                      fmt::format("lists are nested deeper than {} levels", NestedList::kMaxDepth));
    }
    open_.push_back({position_++, complete_.size()});
    return {};
  }

  Status close_list() {
    if (open_.empty()) return expected("a list or an atom", position_);
    const auto first = complete_.begin() + static_cast<std::ptrdiff_t>(open_.back().first);
    NestedList::List elements(std::make_move_iterator(first), std::make_move_iterator(complete_.end()));
    complete_.erase(first, complete_.end());
    complete_.emplace_back(std::move(elements));
    open_.pop_back();
    ++position_;
    return {};
  }

  // Atoms that touch are more often a slip than meant: `12abc`, `"a"b`.
  Status check_separated() const {
    if (at_end() || rest().starts_with(kCommentBegin)) return {};
    const auto next = class_of(source_[position_]);
    if (next == CharClass::blank || next == CharClass::open || next == CharClass::close) return {};
    return expected("a blank or a parenthesis after the atom", position_);
  }

  Status read_quoted(char quote) {
    const auto begin = position_++;
    std::string content;
    while (true) {
      const auto plain = find_either(rest(), quote, '\\');
      if (plain == kNowhere) {
        return error_at(begin, ErrorCode::invalid_value,
                        fmt::format("this {} is not closed by {}", quote == '"' ? "string" : "text", quote));
      }
      content += rest().substr(0, plain);
      position_ += plain + 1;
      if (source_[position_ - 1] == quote) break;
      content += escaped(quote);
    }
    A3D_TRY(check_text(begin, position_));
    if (quote == '"') {
      complete_.emplace_back(std::move(content));
    } else {
      complete_.emplace_back(NestedList::Text{std::move(content)});
    }
    return {};
  }

  // After a backslash: the quote or a backslash, or nothing, and then the backslash stands for itself.
  char escaped(char quote) {
    if (!at_end() && (source_[position_] == quote || source_[position_] == '\\')) return source_[position_++];
    return '\\';
  }

  Status read_unquoted() {
    if (rest().starts_with(kTextBegin)) {
      A3D_ASSIGN(const std::string_view content, read_tagged(kTextBegin, kTextEnd, "text"));
      complete_.emplace_back(NestedList::Text{std::string(content)});
      return {};
    }
    if (rest().starts_with(kFileAtomBegin)) {
      A3D_ASSIGN(const std::string_view path, read_tagged(kFileAtomBegin, kFileAtomEnd, "file atom"));
      complete_.push_back(file_atom(path));
      return {};
    }
    return read_bare();
  }

  Result<std::string_view> read_tagged(std::string_view open, std::string_view close, std::string_view what) {
    const auto begin = position_ + open.size();
    const auto end = source_.find(close, begin);
    if (end == kNowhere)
      return error_at(position_, ErrorCode::invalid_value, fmt::format("this {} is not closed by {}", what, close));
    A3D_TRY(check_text(begin, end));
    position_ = end + close.size();
    return source_.substr(begin, end - begin);
  }

  Status check_text(std::size_t begin, std::size_t end) const {
    const auto wrong = first_no_text(source_.substr(begin, end - begin));
    if (wrong == kNowhere) return {};
    return error_at(begin + wrong, ErrorCode::invalid_value, no_text_message(source_[begin + wrong]));
  }

  // End of the number or symbol that begins at `begin`.
  std::size_t bare_end(std::size_t begin) const {
    auto end = begin;
    while (end < source_.size() && class_of(source_[end]) >= CharClass::letter &&
           !(source_[end] == '_' && source_.substr(end).starts_with(kCommentBegin))) {
      ++end;
    }
    return end;
  }

  Status read_bare() {
    const auto begin = position_;
    position_ = bare_end(begin);
    const auto token = source_.substr(begin, position_ - begin);
    if (starts_number(token)) return read_number(token);
    if (token == "TRUE" || token == "FALSE") {
      complete_.emplace_back(token == "TRUE");
    } else if (is_word(token) || is_special_run(token)) {
      complete_.push_back(NestedList::symbol(std::string(token)));
    } else {
      return expected("a word, a number or a run of special characters", begin);
    }
    return {};
  }

  // `token` is what was read last.
  Status read_number(std::string_view token) {
    std::int64_t integer = 0;
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), integer);
    if (error == std::errc{} && end == token.data() + token.size()) {
      complete_.emplace_back(integer);
    } else if (large_integers_ == LargeIntegers::are_kept ? is_integer(token) : is_inexact_integer(token)) {
      // Literals are exact: a number that no double holds becomes a fraction, which coordinates may be.
      complete_.push_back(NestedList::symbol(std::string(token).append(kOverOne)));
    } else if (const auto real = parse_real(token)) {
      complete_.emplace_back(*real);
    } else if (is_fraction(token)) {
      complete_.push_back(NestedList::symbol(std::string(token)));
    } else if (token.find('/') != kNowhere) {
      return expected("a fraction p/q of two integers, with at most a minus in front", position_ - token.size());
    } else {
      return expected("a number within the range of real", position_ - token.size());
    }
    return {};
  }

  static constexpr std::size_t kShownLength = 40;

  std::string_view source_;
  const SourcePlace& start_;
  const LargeIntegers large_integers_;
  std::size_t position_ = 0;
  std::vector<NestedList> complete_;
  std::vector<OpenList> open_;
};

}  // namespace

Result<NestedList> NestedList::parse(std::string_view source, const SourcePlace& start) {
  return Parser(source, start, Parser::LargeIntegers::become_reals).run();
}

Result<NestedList> parse_expression_list(std::string_view source, const SourcePlace& start) {
  return Parser(source, start, Parser::LargeIntegers::are_kept).run();
}

void read_large_integers_as_reals(NestedList& list) {
  std::vector<NestedList*> open = {&list};
  while (!open.empty()) {
    NestedList& each = *open.back();
    open.pop_back();
    if (each.is_list()) {
      for (NestedList& element : each.elements()) open.push_back(&element);
    } else if (each.is_symbol() && each.as_symbol().ends_with(kOverOne)) {
      std::string_view integer = each.as_symbol();
      integer.remove_suffix(kOverOne.size());
      if (!is_integer(integer) || is_inexact_integer(integer)) continue;
      // One that is beyond the doubles, too, is for its type to refuse.
      if (const auto real = parse_real(integer)) each = NestedList(*real);
    }
  }
}

}  // namespace algebra3d
