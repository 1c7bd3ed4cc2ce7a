#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "base/soup_attributes.h"
#include "mesh_formats/off/off_header.h"

namespace mesh_formats {

/// Collects the attributes of an OFF file while its vertices and faces are read in order.
class OffAttributes {
 public:
  explicit OffAttributes(const OffHeader& header) : header_(header) {}

  /// The numbers of a vertex behind its coordinates and weight: normal, colour of three or four, texture coordinates,
  /// as far as the header announces them. Surplus numbers at the end are left out.
  void add_vertex(std::span<const double> numbers);
  /// The colour of a face, of three or four numbers; other counts (none, the number of a colour in a table of the
  /// reader's) say nothing. `face`: its number; faces without a colour may be left out.
  void set_face_colour(std::size_t face, std::span<const double> numbers);

  /// The attributes; null if there are none. Colours of a list in which a number is above 1 are parts of 255.
  std::shared_ptr<const algebra3d::SoupAttributes> finish(std::size_t face_count) &&;

 private:
  OffHeader header_;
  algebra3d::SoupAttributes attributes_;
};

}  // namespace mesh_formats
