#pragma once

#include "algebra3d/base/error.h"
#include "base/input_file.h"

namespace mesh_formats {

/// Refuses a sparse mesh file with at least a megabyte of holes, as left by unfinished copies and downloads, before its
/// zeros are read, which may be terabytes. Errors: file_format, with the numbers of bytes, and for a binary STL file
/// also with the count in its header; those of reading.
algebra3d::Status refuse_unwritten(const algebra3d::InputFile& file);

}  // namespace mesh_formats
