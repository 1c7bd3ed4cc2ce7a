#pragma once

#include <cstdint>
#include <vector>

#include "base/polygon_soup.h"

/// The corners of every face.
using Faces = std::vector<std::vector<std::uint32_t>>;

inline Faces faces_of(const algebra3d::PolygonSoup& soup) {
  Faces faces;
  for (std::size_t i = 0; i < soup.face_count(); ++i) faces.emplace_back(soup.face(i).begin(), soup.face(i).end());
  return faces;
}
