#pragma once

#include <string_view>

#include "algebra3d/base/error.h"
#include "base/byte_sink.h"
#include "base/output_path.h"
#include "base/polygon_soup.h"

namespace mesh_formats {

/// Writes `soup` as one object of an OBJ file: the name as `o` unless it is empty,
/// all points as `v`, also unused ones, and all faces as `f`, in order. Without a name and points it has a comment.
/// Attributes of the soup become `vt` and `vn`, indices of corners, and `o`, `g`, `mtllib` and `usemtl` where they
/// change; without a name if there is none, but for `mtllib`, which holds on.
///
/// The name becomes one line: control characters become blanks, and blanks at the ends are removed. The name of the
/// soup is not used. Exactness: digits are the shortest for the same double, so coordinates read back unchanged.
/// Errors: invalid_value (a soup that breaks its invariants, or a face of fewer than 3 corners, with its place; nothing
/// is written then), those of the sink.
algebra3d::Status write_obj(algebra3d::ByteSink& sink, const algebra3d::PolygonSoup& soup, std::string_view name);

/// `write_obj` to the file at `path`, atomically (AtomicFile).
algebra3d::Status write_obj_file(const algebra3d::OutputPath& path, const algebra3d::PolygonSoup& soup,
                                 std::string_view name);

}  // namespace mesh_formats
