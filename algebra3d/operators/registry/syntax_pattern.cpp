#include "algebra3d/operators/registry/syntax_pattern.h"

#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "base/propagate.h"

namespace algebra3d {
namespace {

using PlaceKind = SyntaxPattern::PlaceKind;

constexpr std::array<std::pair<std::string_view, PlaceKind>, 8> kPlaceWords = {{
    {"_", PlaceKind::value},
    {"attribute", PlaceKind::attribute},
    {"attributes", PlaceKind::attributes},
    {"keys", PlaceKind::keys},
    {"fun", PlaceKind::function},
    {"functions", PlaceKind::functions},
    {"renames", PlaceKind::renames},
    {"name", PlaceKind::name},
}};

// Words, runs of special characters, and single brackets and separators.
class PatternScanner {
 public:
  explicit PatternScanner(std::string_view text) : text_(text) { advance(); }

  std::string_view token() const { return token_; }
  bool at_end() const { return token_.empty(); }
  bool at(std::string_view token) const { return token_ == token; }
  std::string_view take() {
    const std::string_view taken = token_;
    advance();
    return taken;
  }

 private:
  static bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
  static bool is_bracket(char c) { return std::string_view("()[],;").find(c) != std::string_view::npos; }

  void advance() {
    while (!text_.empty() && text_.front() == ' ') text_.remove_prefix(1);
    std::size_t length = text_.empty() ? 0 : 1;
    if (length == 1 && !is_bracket(text_.front()))
      while (length < text_.size() && text_[length] != ' ' && !is_bracket(text_[length]) &&
             is_word(text_[length]) == is_word(text_.front()))
        ++length;
    token_ = text_.substr(0, length);
    text_.remove_prefix(length);
  }

  std::string_view text_;
  std::string_view token_;
};

std::optional<PlaceKind> place_kind(std::string_view word) {
  for (const auto& [name, kind] : kPlaceWords)
    if (name == word) return kind;
  return std::nullopt;
}

Error misunderstood(std::string_view text, std::string_view token) {
  return {ErrorCode::internal, "syntax pattern '{}': '{}' is not understood", text, token};
}

class PatternParser {
 public:
  explicit PatternParser(std::string_view text) : text_(text), scanner_(text) {}

  Result<SyntaxPattern> parse() {
    while (scanner_.at("_")) {
      scanner_.take();
      ++pattern_.operand_count;
    }
    if (scanner_.at_end()) return misunderstood(text_, "");
    pattern_.name = std::string(scanner_.take());
    A3D_TRY(parse_rest());
    if (!scanner_.at_end()) return misunderstood(text_, scanner_.token());
    return std::move(pattern_);
  }

 private:
  Status parse_rest() {
    if (pattern_.operand_count == 0) {
      pattern_.shape = SyntaxPattern::Shape::prefix;
      return parse_places("(", ")");
    }
    if (pattern_.operand_count == 1 && scanner_.at("_")) {
      scanner_.take();
      pattern_.shape = SyntaxPattern::Shape::infix;
      pattern_.operand_count = 2;
      return {};
    }
    pattern_.shape = SyntaxPattern::Shape::postfix;
    if (scanner_.at_end()) return {};
    pattern_.has_brackets = true;
    return parse_places("[", "]");
  }

  Status parse_places(std::string_view open, std::string_view close) {
    if (!scanner_.at(open)) return misunderstood(text_, scanner_.token());
    char before = scanner_.take().front();
    while (!scanner_.at(close)) {
      if (scanner_.at("...")) {
        scanner_.take();
        pattern_.is_open_ended = true;
        continue;
      }
      A3D_TRY(parse_place(before));
      if (scanner_.at(",") || scanner_.at(";"))
        before = scanner_.take().front();
      else if (!scanner_.at(close) && !scanner_.at("..."))
        return misunderstood(text_, scanner_.token());
    }
    scanner_.take();
    return {};
  }

  Status parse_place(char before) {
    const auto kind = place_kind(scanner_.token());
    if (!kind) return misunderstood(text_, scanner_.token());
    scanner_.take();
    SyntaxPattern::Place place{*kind, {}, before};
    if (scanner_.at("(")) {
      do {
        scanner_.take();
        place.parameters.emplace_back(scanner_.take());
      } while (scanner_.at(","));
      if (!scanner_.at(")")) return misunderstood(text_, scanner_.token());
      scanner_.take();
    }
    pattern_.places.push_back(std::move(place));
    return {};
  }

  std::string_view text_;
  PatternScanner scanner_;
  SyntaxPattern pattern_;
};

}  // namespace

Result<SyntaxPattern> SyntaxPattern::parse(std::string_view text) {
  return PatternParser(text).parse();
}

}  // namespace algebra3d
