#include "queries/shell/detail/inquiry_text.h"

#include <fmt/format.h>

#include "queries/shell/detail/screen.h"
#include "queries/shell/detail/table.h"
#include "queries/store/store.h"

namespace queries {
namespace {

using algebra3d::NestedList;

std::string atom_text(const NestedList& atom) {
  if (atom.is_text()) return atom.as_text();
  if (atom.is_string()) return atom.as_string();
  return atom.print();
}

std::string joined(const NestedList& list, std::string_view separator) {
  std::string text;
  for (const NestedList& element : list.elements())
    text += std::string(text.empty() ? "" : separator) + atom_text(element);
  return text;
}

std::string table_or(const TextTable& table, std::size_t row_count, std::string_view none, std::size_t columns) {
  return row_count == 0 ? std::string(none) + "\n" : table.print(columns);
}

// (OBJECTS (OBJECT name () ((type))) ...), where a type without arguments stands in parentheses too
std::string objects_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Name", "Type"}, {false, false});
  for (const NestedList& item : content.elements()) {
    if (!item.is_list()) continue;
    const NestedList& type = item.elements()[3].elements()[0];
    const bool is_plain = type.is_list() && type.elements().size() == 1;
    table.add({item.elements()[1].as_symbol(), readable_type(is_plain ? type.elements()[0] : type)});
  }
  return table_or(table, content.elements().size() - 1, "no objects", columns);
}

// (TYPES (TYPE name type) ...)
std::string types_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Name", "Type"}, {false, false});
  for (const NestedList& item : content.elements())
    if (item.is_list()) table.add({item.elements()[1].as_symbol(), readable_type(item.elements()[2])});
  return table_or(table, content.elements().size() - 1, "no named types", columns);
}

// ((name ('signature' ...) 'syntax' 'doc') ...)
std::string operators_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Operator", "Meaning"}, {false, false});
  for (const NestedList& item : content.elements())
    table.add({atom_text(item.elements()[2]), atom_text(item.elements()[3])});
  return table.print(columns) + "`help NAME` shows signatures and examples.\n";
}

// ((name (KIND ...) 'notation' 'doc') ...)
std::string constructors_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Type", "Kinds", "Notation", "Meaning"}, {false, false, false, false});
  for (const NestedList& item : content.elements())
    table.add({atom_text(item.elements()[0]), joined(item.elements()[1], ", "), atom_text(item.elements()[2]),
               atom_text(item.elements()[3])});
  return table.print(columns);
}

// ((name count) ...)
std::string counters_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Counter", "Count"}, {false, true});
  for (const NestedList& item : content.elements())
    table.add({atom_text(item.elements()[0]), std::to_string(item.elements()[1].as_int())});
  return table.print(columns);
}

// ((depth name 'signature' calls tuples milliseconds estimate 'how') ...): a table, and below it how operators work,
// which may be long
std::string plan_text(const NestedList& content, std::size_t columns) {
  TextTable table({"Operator", "Signature", "Estimate", "Calls", "Tuples", "ms"},
                  {false, false, true, true, true, true});
  std::string below;
  for (const NestedList& step : content.elements()) {
    const auto& cells = step.elements();
    const std::string indentation(static_cast<std::size_t>(2 * cells[0].as_int()), ' ');
    // Only streams give tuples.
    const std::int64_t tuples = cells[4].as_int(), estimate = cells[6].as_int();
    const bool is_stream = atom_text(cells[2]).find("-> (stream") != std::string::npos;
    table.add({indentation + atom_text(cells[1]), one_line(atom_text(cells[2]), columns),
               estimate < 0 ? "" : std::to_string(estimate), std::to_string(cells[3].as_int()),
               tuples == 0 && !is_stream ? "" : std::to_string(tuples), fmt::format("{:.1f}", cells[5].as_real())});
    if (const std::string how = atom_text(cells[7]); !how.empty())
      below += printable(fmt::format("{}: {}", atom_text(cells[1]), how)) + "\n";
  }
  return table_or(table, content.elements().size(), "no operators: the value is a constant or an object", columns) +
         below;
}

// ((object tuple attribute 'what is wrong') ...)
std::string findings_text(const NestedList& content) {
  std::string text;
  for (const NestedList& item : content.elements()) {
    const auto& parts = item.elements();
    const Finding finding{parts[0].as_string(), parts[1].as_int(), parts[2].as_string(), parts[3].as_text()};
    text += printable(finding.text()) + "\n";
  }
  return text.empty() ? "no findings\n" : text;
}

std::string names_text(const std::string& what, const NestedList& content) {
  std::string text;
  for (const NestedList& item : content.elements()) text += printable(atom_text(item)) + "\n";
  return text.empty() ? "no " + what + "\n" : text;
}

}  // namespace

std::string readable_type(const NestedList& type) {
  if (!type.is_list() || type.elements().size() != 2 || !type.elements()[0].is_symbol("rel")) return type.print();
  const NestedList& tuple = type.elements()[1];
  if (!tuple.is_list() || tuple.elements().size() != 2 || !tuple.elements()[1].is_list()) return type.print();
  std::string text;
  for (const NestedList& attribute : tuple.elements()[1].elements()) {
    if (!attribute.is_list() || attribute.elements().size() != 2) return type.print();
    text += (text.empty() ? "rel: " : ", ") + attribute.elements()[0].print() + " " + attribute.elements()[1].print();
  }
  return text.empty() ? type.print() : text;
}

std::string inquiry_text(const NestedList& result, std::size_t columns) {
  const std::string& what = result.elements()[1].elements()[0].as_symbol();
  const NestedList& content = result.elements()[1].elements()[1];
  if (what == "objects") return objects_text(content, columns);
  if (what == "types") return types_text(content, columns);
  if (what == "operators") return operators_text(content, columns);
  if (what == "constructors") return constructors_text(content, columns);
  if (what == "counters") return counters_text(content, columns);
  if (what == "plan") return plan_text(content, columns);
  if (what == "findings") return findings_text(content);
  return names_text(what, content);
}

}  // namespace queries
