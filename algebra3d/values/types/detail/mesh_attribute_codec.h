#pragma once

#include "algebra3d/base/error.h"
#include "algebra3d/kernel/halfedge/mesh_attributes.h"
#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/nested_list.h"

namespace algebra3d {

// The attributes of a mesh3d in value lists and in binary.

/// ((element "name" kind (value*))*), a value as a real, (u v), (x y z), a text or undefined.
NestedList attributes_to_nested(const MeshAttributes& attributes);
/// Reads them for a mesh. Errors: invalid_value, with the number of the attribute from 0.
Result<MeshAttributes> attributes_from_nested(const NestedList& list, const PolygonMesh& mesh);

void write_attributes(ByteWriter& writer, const MeshAttributes& attributes);
/// Reads what `write_attributes` has written for `mesh`; none if the reader fails.
MeshAttributes read_attributes(ByteReader& reader, const PolygonMesh& mesh);

}  // namespace algebra3d
