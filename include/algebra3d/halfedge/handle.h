#pragma once

#include "algebra3d/base/strong_id.h"

namespace algebra3d {

/// The elements of a mesh, by their numbers from 0; `is_valid()` is false for none. A half-edge belongs to one face and
/// leaves one of its corners. Edges are undirected: manifold, boundary or non-manifold ones, numbered in order of the
/// first half-edges along them.
using VertexId = StrongId<struct VertexKind>;
using HalfedgeId = StrongId<struct HalfedgeKind>;
using EdgeId = StrongId<struct EdgeKind>;
using FaceId = StrongId<struct FaceKind>;

}  // namespace algebra3d
