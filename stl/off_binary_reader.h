#pragma once

#include <atomic>
#include <string_view>

#include "algebra3d/base/error.h"
#include "stl/off_header.h"
#include "stl/read_mesh.h"

namespace stl {

/// Reads a binary file behind its header; see `read_off` for what holds in both forms. All numbers have 32 bits: three
/// integers (vertices, faces, edges), the floats of the vertices, and for each face the number of its corners, their
/// indices, and a number of colour floats with these.
///
/// The format has them big-endian. Some programs write them as their machine has them, and leave out the numbers of
/// colour floats (pmp-library does both). Of the four layouts that one is taken in which the faces fill the file to its
/// last byte, all indices are those of vertices, and colours have at most four floats or, without their numbers, faces
/// at least 3 corners; if several do, big-endian before little-endian, with colours before without. If none does, it is
/// the layout with colours, in the byte order that holds for more bytes, big-endian if neither does: then the file has
/// bytes left, which have a remark, or an error. Every layout but the format's own has a remark.
algebra3d::Result<ReadMesh> read_binary_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                            const std::atomic<bool>* cancel);

}  // namespace stl
