#pragma once

#include <cstdint>
#include <string_view>

#include "algebra3d/base/error.h"

namespace mesh_formats {

/// The content of a kind of files, on which advice depends.
enum class ForeignContent : std::uint8_t {
  other,    ///< programs, images, archives, databases
  shapes,   ///< meshes, solids, drawings or points in a format that this library does not read
  regions,  ///< GeoJSON
  rows,     ///< JSON
};

/// A kind of files that no mesh format of this library reads.
struct ForeignKind {
  std::string_view name;  ///< "a program", "compressed by gzip", "a PLY file"; empty for unknown kinds
  ForeignContent content = ForeignContent::other;
};

/// The kind of a file of another program, by its first bytes. Domain: at least the first 512 bytes of a file; members
/// and elements that name a format of JSON, XML or ZIP files are looked for in the first 64 kB. Cost: linear in those.
ForeignKind foreign_kind(std::string_view bytes);

/// The kind by the ending of a file name, of formats for shapes only; empty for all others. For files whose content
/// says nothing.
ForeignKind foreign_kind_of_name(std::string_view file_name);

/// The error file_format "prog.stl: it is a program; expected an STL, OBJ or OFF file" for the bytes of such a file;
/// `expected`: the names of the formats ("STL, OBJ or OFF"). Call it after MeshFormats::of_content, since the header of
/// a binary STL file may begin with any bytes.
algebra3d::Status refuse_foreign(std::string_view bytes, std::string_view file_name, std::string_view expected);

}  // namespace mesh_formats
