#include "queries/test_runner/detail/expectation.h"

#include <algorithm>

namespace queries {
namespace {

using Kind = Expectation::Kind;

Verdict wrong(std::string why, Difference difference = {}) {
  return {.is_right = false, .why = std::move(why), .difference = std::move(difference)};
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

Verdict compare(const NestedList& expected, const NestedList& found, Tolerance tolerance) {
  auto difference = first_difference(expected, found, tolerance);
  if (!difference) return {};
  std::string why = difference->text();
  return wrong(std::move(why), std::move(*difference));
}

// The value is undefined, and a note says why.
Verdict judge_undefined(const std::string& text, const NestedList& result, const std::vector<std::string>& notes) {
  const bool is_undefined = result.is_list() && result.elements().size() == 2 && result.elements()[1].is_undefined();
  if (!is_undefined) return wrong("expected an undefined value, found " + result.print_short(200));
  const auto contains = [&](const std::string& note) { return note.find(text) != std::string::npos; };
  if (std::ranges::any_of(notes, contains)) return {};
  return wrong("expected a note that contains " + quoted(text));
}

// An int or a real of that value.
Verdict judge_number(const NestedList& expected, const NestedList& result, Tolerance tolerance) {
  const bool is_number = result.is_list() && result.elements().size() == 2 &&
                         (result.elements()[0].is_symbol("int") || result.elements()[0].is_symbol("real"));
  if (!is_number) return wrong("expected a number, found " + result.print_short(200));
  return compare(expected, result.elements()[1], tolerance);
}

Expectation with_quoted_text(Kind kind, const std::string& written) {
  auto parsed = NestedList::parse(written);
  if (!parsed || !parsed->is_string()) return Expectation::with_problem("#yields: expected a string, got " + written);
  return {.kind = kind, .text = parsed->as_string()};
}

Expectation with_value(Kind kind, const std::string& written) {
  auto parsed = NestedList::parse(written);
  if (!parsed) return Expectation::with_problem("#yields: " + parsed.error().text());
  return {.kind = kind, .value = std::move(parsed).value()};
}

}  // namespace

Expectation Expectation::parse(const std::string& text) {
  if (text == "success") return {.kind = Kind::success};
  if (text == "error") return {.kind = Kind::error};
  if (text.starts_with("error ")) return with_quoted_text(Kind::error, text.substr(6));
  if (text.starts_with("undefined ")) return with_quoted_text(Kind::undefined, text.substr(10));
  if (text.starts_with("equal ")) return {.kind = Kind::equal, .text = text.substr(6)};
  if (text.starts_with("set ")) return with_value(Kind::set, text.substr(4));
  if (text.starts_with("number ")) return with_value(Kind::number, text.substr(7));
  if (text.starts_with('(')) return with_value(Kind::value, text);
  return with_problem("unknown yields value: " + text);
}

void Expectation::use_up() {
  value = NestedList();
  text.clear();
  problem.clear();
  if (kind != Kind::success && kind != Kind::error) kind = Kind::value;
}

std::string Expectation::shown(const Difference& difference) const {
  switch (kind) {
    case Kind::success:
      return "no error";
    case Kind::error:
      return text.empty() ? "an error" : "an error that contains " + quoted(text);
    case Kind::undefined:
      return "an undefined value, and a note that contains " + quoted(text);
    case Kind::equal:
      return "the value of " + text;
    case Kind::set:
    case Kind::number:
    case Kind::value:
      break;
  }
  return excerpt(value, difference.path);
}

Verdict judge(const Expectation& expectation, const algebra3d::Result<NestedList>& result,
              const std::vector<std::string>& notes, Tolerance tolerance) {
  if (!expectation.problem.empty()) return wrong(expectation.problem);
  if (expectation.kind == Kind::error) {
    if (result) return wrong("expected an error, found " + result->print_short(200));
    if (result.error().text().find(expectation.text) != std::string::npos) return {};
    return wrong("expected an error that contains " + quoted(expectation.text));
  }
  if (!result) return wrong("expected no error");
  if (expectation.kind == Kind::success) return {};
  if (expectation.kind == Kind::undefined) return judge_undefined(expectation.text, *result, notes);
  if (expectation.kind == Kind::number) return judge_number(expectation.value, *result, tolerance);
  return compare(expectation.value, *result, tolerance);
}

}  // namespace queries
