#pragma once

#include <array>
#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/mesh_attributes.h"

namespace algebra3d::samples {

inline AttributeValues real_values(const std::vector<double>& numbers) {
  AttributeValues values(AttributeKind::real, numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) values.set(i, std::array{numbers[i]});
  return values;
}

/// Texts, not canonical; an empty one is undefined.
inline AttributeValues text_values(const std::vector<std::string>& given) {
  AttributeValues values(AttributeKind::text, given.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i].empty()) values.set_text(i, values.add_text(given[i]));
  return values;
}

}  // namespace algebra3d::samples
