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
/// last byte, all indices are those of vertices, and colours have at most four floats; if several do, big-endian before
/// little-endian, with colours before without. If none does, the one that holds for the most bytes: it leaves a rest,
/// which has a remark, or names the place of the error. Every layout but the format's own has a remark.
algebra3d::Result<ReadMesh> read_binary_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                            const std::atomic<bool>* cancel);

}  // namespace stl
