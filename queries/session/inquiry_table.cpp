#include "queries/session/inquiry_table.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace queries {
namespace {

using algebra3d::NestedList;

std::vector<std::string> columns_of(const std::string& what) {
  static const std::map<std::string, std::vector<std::string>, std::less<>> columns = {
      {"objects", {"Name", "Type"}},
      {"types", {"Name", "Type"}},
      {"operators", {"Name", "Signatures", "Syntax", "Meaning"}},
      {"constructors", {"Name", "Kinds", "Notation", "Meaning"}},
      {"counters", {"Name", "Count"}},
      {"plan", {"Depth", "Operator", "Signature", "Calls", "Tuples", "Milliseconds", "Estimate", "How"}},
      {"findings", {"Object", "Tuple", "Attribute", "Problem"}}};
  const auto found = columns.find(what);
  return found == columns.end() ? std::vector<std::string>{"Name"} : found->second;
}

// (OBJECT name () ((type))) and (TYPE name type): the type as the text of its nested list.
NestedList::List named_type_row(const NestedList& item) {
  const NestedList::List& parts = item.elements();
  const bool is_object = parts.size() == 4;
  NestedList type = is_object ? parts[3].elements()[0] : parts[2];
  if (is_object && type.is_list() && type.elements().size() == 1) type = NestedList(type.elements()[0]);
  return {parts[1], NestedList::text(type.print())};
}

}  // namespace

InquiryTable inquiry_table(const NestedList& result) {
  const std::string& what = result.elements()[1].elements()[0].as_symbol();
  InquiryTable table{columns_of(what), {}};
  const bool is_named_type = what == "objects" || what == "types";
  for (const NestedList& item : result.elements()[1].elements()[1].elements()) {
    if (is_named_type && !item.is_list()) continue;  // the heading
    table.rows.push_back(is_named_type    ? named_type_row(item)
                         : item.is_list() ? item.elements()
                                          : NestedList::List{item});
    while (table.columns.size() < table.rows.back().size())
      table.columns.push_back(fmt::format("Column{}", table.columns.size() + 1));
  }
  return table;
}

}  // namespace queries
