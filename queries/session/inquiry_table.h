#pragma once

#include <string>
#include <vector>

#include "algebra3d/values/types/nested_list.h"

namespace queries {

/// The result of an inquiry as a relation: names of the columns, and a value list per cell.
struct InquiryTable {
  std::vector<std::string> columns;
  std::vector<algebra3d::NestedList::List> rows;
};

/// Converts `(inquiry (WHAT LIST))` to a relation. Cells beyond the columns of WHAT get columns `Column4` and so on.
InquiryTable inquiry_table(const algebra3d::NestedList& result);

}  // namespace queries
