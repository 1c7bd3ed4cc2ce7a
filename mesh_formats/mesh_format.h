#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "algebra3d/base/error.h"
#include "base/byte_sink.h"
#include "base/mesh_content.h"
#include "base/output_path.h"

namespace mesh_formats {

/// Whether the bytes of a file match a format.
enum class Match {
  none,
  possible,  ///< they can be of this format, if neither they nor the file name indicate another
  sure,      ///< they are of this format, whatever the file name
};

/// An encoding in which a format is written, and the type of its coordinates.
struct FileForm {
  Encoding encoding;
  CoordinateRange coordinates;
};

/// Where the attributes of a format stand.
enum class AttributePlaces : std::uint8_t {
  none,
  corners,  ///< texture coordinates and normals of corners; groups, objects and materials of faces
  points,   ///< normals, texture coordinates and colours of points; colours of faces
};

/// A format of mesh files. To add a format, write a value of this type and add it to the table of known_mesh_formats
/// (mesh_formats.h). Reading, writing, import, export, conversion, messages and help use that table.
struct MeshFormat {
  std::string_view name;      ///< "STL"; operators are called importSTL and exportSTL
  std::string_view title;     ///< with an article, for sentences: "a Wavefront OBJ file"
  std::string_view variants;  ///< variants that can be read, after the title: ", ASCII or binary"; or ""
  std::span<const std::string_view> endings;  ///< of file names, in lower case with their point: ".stl"; at least one
  std::string_view media_type;                ///< a registered one, or that of any bytes
  std::span<const FileForm> forms;            ///< for writing; the first is the default
  bool stores_triangles;                      ///< true: `write` takes triangles; false: polygons
  bool stores_name;                           ///< of the solid

  /// Whether a file has this format. `size`: its size; `head`: at least its first kilobyte, or all of it. Cost:
  /// constant but for comments at the beginning.
  Match (*detect)(std::string_view head, std::size_t size);
  /// Reads the bytes of a file; `file_name` begins the messages. Errors: file_format with the position, what was found
  /// and what was expected; limit_exceeded; interrupted.
  algebra3d::Result<MeshContent> (*read)(std::string_view bytes, std::string_view file_name,
                                         const std::atomic<bool>* cancel);
  /// Writes the facets, which must be of the kind that the format stores. `encoding` is one of the forms; `name` is
  /// ignored by formats without names. Errors: invalid_value with the place, limit_exceeded, those of the sink.
  algebra3d::Status (*write)(algebra3d::ByteSink& sink, const Facets& facets, std::string_view name, Encoding encoding);
  /// The attributes of polygons (PolygonSoup::attributes) that `write` writes.
  AttributePlaces attributes = AttributePlaces::none;
  /// `read` with these; null if the format has none.
  algebra3d::Result<MeshContent> (*read_with_attributes)(std::string_view bytes, std::string_view file_name,
                                                         const std::atomic<bool>* cancel) = nullptr;

  /// `write` to the file at `path`, atomically (AtomicFile). Errors: also those of AtomicFile; all name the path.
  [[nodiscard]] algebra3d::Status write_file(const algebra3d::OutputPath& path, const Facets& facets,
                                             std::string_view name, Encoding encoding) const;

  /// The form with this encoding; null if there is none.
  [[nodiscard]] const FileForm* form(Encoding encoding) const;
  /// True if the file name has one of the endings, ignoring case.
  [[nodiscard]] bool has_ending_of(std::string_view file_name) const;
  /// The form as one word, for requests: "stl" for the default, "stl-ascii", "off-binary".
  [[nodiscard]] std::string word_of(const FileForm& form) const;
};

}  // namespace mesh_formats
