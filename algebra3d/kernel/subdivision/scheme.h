#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

namespace subdivision {
struct SchemeDescription;  // detail/scheme_description.h
}

/// A subdivision scheme: how one step divides the faces of a mesh and where it puts vertices. Each is described in one
/// file of this folder; a value refers to the description, which lives as long as the program, so copies are cheap.
/// CONTRIBUTING.md says how a scheme is added.
class SubdivisionScheme {
 public:
  static const SubdivisionScheme catmull_clark;       ///< faces of any degree; approximating. Source: [catmull1978]
  static const SubdivisionScheme doo_sabin;           ///< faces of any degree; dual, approximating. Source: [doo1978]
  static const SubdivisionScheme loop;                ///< triangles; approximating. Source: [loop1987]
  static const SubdivisionScheme butterfly;           ///< triangles; interpolating. Source: [dyn1990]
  static const SubdivisionScheme modified_butterfly;  ///< triangles; interpolating. Source: [zorin1996]
  static const SubdivisionScheme sqrt3;               ///< triangles; approximating. Source: [kobbelt2000]

  constexpr explicit SubdivisionScheme(const subdivision::SchemeDescription* description) : description_(description) {}
  const subdivision::SchemeDescription& description() const { return *description_; }

  friend bool operator==(const SubdivisionScheme&, const SubdivisionScheme&) = default;

 private:
  const subdivision::SchemeDescription* description_;
};

/// All schemes, in the order of all lists.
std::span<const SubdivisionScheme> subdivision_schemes();
/// The scheme of that name, such as "catmull-clark".
std::optional<SubdivisionScheme> subdivision_scheme(std::string_view name);
std::string_view name_of(const SubdivisionScheme& scheme);
/// True for schemes whose faces must be triangles.
bool takes_triangles_only(const SubdivisionScheme& scheme);
/// True for schemes that refuse interior vertices with fewer than three edges.
bool needs_three_edges(const SubdivisionScheme& scheme);
/// True for schemes whose limits of vertices are known: see `limit_mesh`.
bool has_limit(const SubdivisionScheme& scheme);
/// True for schemes that keep creases and corners sharp: see `subdivided`.
bool honours_creases(const SubdivisionScheme& scheme);

/// The names of all schemes, with commas, for messages; or of those for which a property holds, such as `has_limit`.
std::string subdivision_scheme_names();
std::string subdivision_scheme_names(bool (*property)(const SubdivisionScheme&));

/// The names of the variants of a scheme, weights or rules; the first is the default. Empty: there is one only.
std::span<const std::string_view> variants_of(const SubdivisionScheme& scheme);
/// The property in which the variants differ, such as "weights"; empty without variants.
std::string_view kind_of_variants(const SubdivisionScheme& scheme);
/// The place of that name among the variants of a scheme. Errors: invalid_value, with those that it has.
Result<std::size_t> subdivision_variant(const SubdivisionScheme& scheme, std::string_view name);

}  // namespace algebra3d
