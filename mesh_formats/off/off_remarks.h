#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "mesh_formats/detail/read_mesh.h"

namespace mesh_formats {

/// Numbers of dropped parts of an OFF file.
struct IgnoredInOff {
  std::size_t normals = 0;
  std::size_t vertex_colours = 0;
  std::size_t texture_coordinates = 0;
  std::size_t surplus_vertices = 0;  ///< vertices with more numbers than the header announces
  std::size_t face_colours = 0;
  std::size_t short_faces = 0;  ///< faces of fewer than 3 corners
};

/// Adds a remark for each count that is not 0.
void add_remarks(const IgnoredInOff& ignored, ReadMesh& read);

/// The message of both readers for an invalid index; `face` and `corner` count from 1.
std::string off_index_message(std::uint64_t face, std::uint64_t face_count, std::uint64_t corner, std::uint64_t index,
                              std::uint64_t vertex_count);

}  // namespace mesh_formats
