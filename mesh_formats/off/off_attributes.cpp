#include "mesh_formats/off/off_attributes.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace mesh_formats {

using algebra3d::SoupAttributes;
using algebra3d::Vec3;

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr SoupAttributes::Colour kNoColour{{kMissing, kMissing, kMissing}, kMissing};

SoupAttributes::Colour colour_of(std::span<const double> numbers) {
  if (numbers.size() < 3) return kNoColour;
  return {{numbers[0], numbers[1], numbers[2]}, numbers.size() > 3 ? numbers[3] : kMissing};
}

/// Some programs write numbers from 0 to 1, others from 0 to 255; the format has both.
void scale(std::vector<SoupAttributes::Colour>& colours) {
  const auto is_of_255 = [](const SoupAttributes::Colour& c) {
    return c.rgb.x > 1 || c.rgb.y > 1 || c.rgb.z > 1 || c.opacity > 1;
  };
  if (std::ranges::none_of(colours, is_of_255)) return;
  for (SoupAttributes::Colour& c : colours) c = {{c.rgb.x / 255, c.rgb.y / 255, c.rgb.z / 255}, c.opacity / 255};
}

}  // namespace

void OffAttributes::add_vertex(std::span<const double> numbers) {
  if (header_.has_normals && numbers.size() >= 3) {
    const Vec3 normal{numbers[0], numbers[1], numbers[2]};
    attributes_.point_normals.push_back(normal == Vec3{} ? Vec3{kMissing, kMissing, kMissing} : normal);
    numbers = numbers.subspan(3);
  }
  if (header_.has_colours) {
    const std::size_t behind = header_.has_texture_coordinates ? 2 : 0;
    const std::size_t count = numbers.size() < behind ? 0 : std::min<std::size_t>(numbers.size() - behind, 4);
    attributes_.point_colours.push_back(colour_of(numbers.first(count)));
    numbers = numbers.subspan(count);
  }
  if (!header_.has_texture_coordinates) return;
  const bool has_both = numbers.size() >= 2;
  attributes_.point_textures.push_back({has_both ? numbers[0] : kMissing, has_both ? numbers[1] : kMissing});
}

void OffAttributes::set_face_colour(std::size_t face, std::span<const double> numbers) {
  if (numbers.size() < 3) return;
  attributes_.face_colours.resize(face, kNoColour);
  attributes_.face_colours.push_back(colour_of(numbers));
}

std::shared_ptr<const SoupAttributes> OffAttributes::finish(std::size_t face_count) && {
  scale(attributes_.point_colours);
  scale(attributes_.face_colours);
  if (!attributes_.face_colours.empty()) attributes_.face_colours.resize(face_count, kNoColour);
  const bool has_some = !attributes_.point_normals.empty() || !attributes_.point_colours.empty() ||
                        !attributes_.point_textures.empty() || !attributes_.face_colours.empty();
  return has_some ? std::make_shared<const SoupAttributes>(std::move(attributes_)) : nullptr;
}

}  // namespace mesh_formats
