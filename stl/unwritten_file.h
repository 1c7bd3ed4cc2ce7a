#pragma once

#include "algebra3d/base/error.h"
#include "stl/input_file.h"

namespace stl {

/// Refuses a mesh file of which a megabyte or more was never written (a sparse file, as unfinished copies and downloads
/// leave it), before its zeros are read: they can be terabytes.
/// Errors: file_format, with the numbers of bytes, and for a binary STL file also with the count in its header; those
/// of reading.
algebra3d::Status refuse_unwritten(const InputFile& file);

}  // namespace stl
