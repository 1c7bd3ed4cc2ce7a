#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace algebra3d {

/// A subdivision scheme: how one step divides the faces of a mesh and where it puts vertices.
enum class SubdivisionScheme : std::uint8_t {
  catmull_clark,      ///< faces of any degree; approximating. Source: [catmull1978]
  doo_sabin,          ///< faces of any degree; dual, approximating. Source: [doo1978]
  loop,               ///< triangles; approximating. Source: [loop1987]
  butterfly,          ///< triangles; interpolating. Source: [dyn1990]
  modified_butterfly  ///< triangles; interpolating. Source: [zorin1996]
};

/// The scheme of that name, such as "catmull-clark".
std::optional<SubdivisionScheme> subdivision_scheme(std::string_view name);
std::string_view name_of(SubdivisionScheme scheme);
/// All names, with commas, for messages.
std::string subdivision_scheme_names();
/// True for schemes whose faces must be triangles.
bool takes_triangles_only(SubdivisionScheme scheme);

/// The weight of a neighbour in the new position of an interior vertex by the scheme of Loop. Both are 1/16 where six
/// edges meet.
enum class LoopWeights : std::uint8_t {
  loop,   ///< (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n. Source: [loop1987]
  warren  ///< 3/16 where three edges meet, else 3 / (8 n). Source: [warren2001]
};
std::optional<LoopWeights> loop_weights(std::string_view name);

}  // namespace algebra3d
