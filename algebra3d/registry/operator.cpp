#include "algebra3d/registry/operator.h"

#include <algorithm>

namespace algebra3d {

std::string_view describe(Exactness exactness) {
  switch (exactness) {
    case Exactness::exact:
      return "exact";
    case Exactness::rounded_once:
      return "the exact result, rounded once";
    case Exactness::two_ulp:
      return "within 2 units in the last place";
    case Exactness::outward:
      return "the exact result, rounded outward";
    case Exactness::reported:
      return "off by no more than a diagnostic says";
    case Exactness::not_numeric:
      return "no arithmetic";
  }
  return "";
}

TypeExpr Overload::result_type() const {
  const TypeExpr type(result->name());
  return result_is_stream ? TypeExpr::stream(type) : type;
}

std::string Overload::signature() const {
  std::string text = "(";
  for (const Parameter& parameter : parameters) {
    if (text.size() > 1) text += ' ';
    text += parameter.type->name();
  }
  return text + ") -> " + result_type().text();
}

bool Operator::accepts_undefined() const {
  return handles_undefined || std::ranges::any_of(overloads, [](const Overload& overload) {
           return std::ranges::any_of(overload.parameters, &Parameter::accepts_undefined);
         });
}

std::string Operator::written() const {
  if (!also_prefix) return syntax;
  std::string places;
  for (const char c : syntax)
    if (c == '_') places += places.empty() ? "_" : ", _";
  return syntax + ", " + name + "(" + places + ")";
}

std::vector<std::string> Operator::all_signatures() const {
  std::vector<std::string> all = signatures;
  for (const Overload& overload : overloads) all.push_back(overload.signature());
  return all;
}

}  // namespace algebra3d
