#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stl {

/// How much of an OFF file was left out.
struct IgnoredInOff {
  std::size_t normals = 0;
  std::size_t vertex_colours = 0;
  std::size_t texture_coordinates = 0;
  std::size_t surplus_vertices = 0;  ///< vertices with numbers that the header does not announce
  std::size_t face_colours = 0;
  std::size_t short_faces = 0;  ///< faces of fewer than 3 corners
};

/// Adds a remark for each count that is not 0.
void add_remarks(const IgnoredInOff& ignored, std::vector<std::string>& remarks);

/// What both readers say of an index of no vertex; `face` and `corner` count from 1.
std::string off_index_message(std::uint64_t face, std::uint64_t face_count, std::uint64_t corner, std::uint64_t index,
                              std::uint64_t vertex_count);

}  // namespace stl
