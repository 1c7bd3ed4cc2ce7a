#pragma once

#include <atomic>
#include <string_view>

#include "algebra3d/base/error.h"
#include "mesh_formats/detail/read_mesh.h"
#include "mesh_formats/off/off_header.h"

namespace mesh_formats {

/// Reads a binary file after its header; see `read_off` for the common rules. All numbers have 32 bits: three integers
/// (vertices, faces, edges), the floats of the vertices, and for each face the number of its corners, their indices,
/// and a number of colour floats with these.
///
/// The format is big-endian. Some programs write the byte order of their machine, and omit the numbers of colour floats
/// (pmp-library does both). Of the four layouts the reader takes the first, big-endian before little-endian and with
/// colours before without, in which the faces fill the file exactly, all indices are valid, and colours have at most
/// four floats or, without colours, faces have at least 3 corners. If none fits, it takes the layout with colours in
/// the byte order that fits for more bytes, big-endian in doubt; then the file has surplus bytes, with a remark, or an
/// error. Every layout other than the standard one has a remark.
algebra3d::Result<ReadMesh> read_binary_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                            Wanted wanted, const std::atomic<bool>* cancel);

}  // namespace mesh_formats
