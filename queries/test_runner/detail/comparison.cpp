#include "queries/test_runner/detail/comparison.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/core.h>

#include "base/number_text.h"

namespace queries {
namespace {

constexpr std::size_t kShownCharacters = 300;

std::string path_text(std::span<const std::size_t> path) {
  std::string text;
  for (const std::size_t position : path) text += fmt::format("/{}", position + 1);
  return text;
}

std::optional<double> number_in(const NestedList& atom) {
  if (atom.is_int()) return static_cast<double>(atom.as_int());
  return atom.is_real() ? std::optional(atom.as_real()) : std::nullopt;
}

class Comparison {
 public:
  explicit Comparison(Tolerance tolerance) : tolerance_(tolerance) {}

  // True if the lists agree; the place of a difference is left in `difference_`. Depth is that of the expected list,
  // which the parser limits.
  bool agree(const NestedList& expected, const NestedList& found) {
    if (!expected.is_list() || !found.is_list()) return atoms_agree(expected, found);
    const auto& wanted = expected.elements();
    const auto& given = found.elements();
    for (std::size_t i = 0; i < std::min(wanted.size(), given.size()); ++i) {
      difference_.path.push_back(i);
      if (!agree(wanted[i], given[i])) return false;
      difference_.path.pop_back();
    }
    if (wanted.size() == given.size()) return true;
    difference_.what = fmt::format("expected {} elements, found {}", wanted.size(), given.size());
    return false;
  }

  Difference take() { return std::move(difference_); }

 private:
  bool atoms_agree(const NestedList& expected, const NestedList& found) {
    if (expected == found) return true;
    const auto wanted = number_in(expected);
    const auto given = number_in(found);
    const bool both_int = expected.is_int() && found.is_int();
    if (wanted && given && !both_int && tolerance_.accepts(*wanted, *given)) return true;
    // SECONDO's name for ints of 64 bits.
    if (expected.is_symbol("longint") && found.is_symbol("int")) return true;
    difference_.what = fmt::format("expected {}, found {}", expected.print_short(200), found.print_short(200));
    return false;
  }

  Tolerance tolerance_;
  Difference difference_;
};

// The elements round a place of a long list.
std::string window(const NestedList& list, std::size_t middle) {
  constexpr std::size_t kNeighbours = 1;
  constexpr std::size_t kElementCharacters = 100;
  const auto& elements = list.elements();
  const std::size_t begin = std::min(middle, elements.size()) - std::min({kNeighbours, middle, elements.size()});
  const std::size_t end = std::min(elements.size(), middle + kNeighbours + 1);
  std::string text = begin > 0 ? "(... " : "(";
  for (std::size_t i = begin; i < end; ++i)
    text += (i > begin ? " " : "") + elements[i].print_short(kElementCharacters);
  return text + (end < elements.size() ? " ...)" : ")");
}

}  // namespace

bool Tolerance::accepts(double expected, double found) const {
  if (expected == found) return true;
  const double difference = std::abs(expected - found);
  if (!is_relative) return difference < value;
  return value > 0 && difference < std::max(value, 1e-15) * std::abs(expected);
}

std::optional<Tolerance> Tolerance::parse(const std::string& text) {
  const bool is_relative = text.starts_with('%');
  const auto value = algebra3d::parse_real(text.substr(is_relative ? 1 : 0));
  if (!value || *value < 0) return std::nullopt;
  return Tolerance{is_relative ? *value / 100 : *value, is_relative};
}

std::string Difference::text() const {
  return path.empty() ? what : fmt::format("at {}: {}", path_text(path), what);
}

std::optional<Difference> first_difference(const NestedList& expected, const NestedList& found, Tolerance tolerance) {
  Comparison comparison(tolerance);
  if (comparison.agree(expected, found)) return std::nullopt;
  return comparison.take();
}

std::string excerpt(const NestedList& list, const std::vector<std::size_t>& path) {
  const NestedList* part = &list;
  std::size_t depth = 0;
  std::string text = part->print();
  // The last step would lead to the atom, whose neighbours are wanted.
  while (text.size() > kShownCharacters && depth + 1 < path.size() && part->is_list() &&
         path[depth] < part->elements().size()) {
    part = &part->elements()[path[depth++]];
    text = part->print();
  }
  if (text.size() > kShownCharacters && part->is_list())
    text = window(*part, depth < path.size() ? path[depth] : part->elements().size());
  else if (text.size() > kShownCharacters)
    text = part->print_short(kShownCharacters);
  return depth == 0 ? text : fmt::format("at {}: {}", path_text(std::span(path).first(depth)), text);
}

NestedList with_sorted_tuples(NestedList result) {
  if (!result.is_list() || result.elements().size() != 2 || !result.elements()[1].is_list()) return result;
  std::ranges::sort(result.elements()[1].elements(), {}, [](const NestedList& tuple) { return tuple.print(); });
  return result;
}

}  // namespace queries
