#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"

// Operators that take a surface3d, volume3d or mesh3d as their first argument, by one function template.

namespace algebra3d::detail {

/// The overloads of a scalar operator; `names` are those of the other parameters.
template <auto OfSurface, auto OfSolid, auto OfMesh, typename... Names>
std::vector<Overload> mesh_overloads(Names... names) {
  return {overload<OfSurface>("surface", names...), overload<OfSolid>("solid", names...),
          overload<OfMesh>("mesh", names...)};
}

/// The overloads of a table operator.
template <auto OfSurface, auto OfSolid, auto OfMesh, typename... Names>
std::vector<Overload> mesh_tables(std::initializer_list<std::string_view> columns, Names... names) {
  return {table<OfSurface>(columns, "surface", names...), table<OfSolid>(columns, "solid", names...),
          table<OfMesh>(columns, "mesh", names...)};
}

// Sample values of examples.
inline const std::string kFoldedSurface = "(surface3d (((0 0 0) (2 0 0) (0 2 0)) ((0 0 0) (0 2 0) (0 0 2))))";
inline const std::string kFlatSquare = "(mesh3d (((0 0 0) (2 0 0) (2 2 0) (0 2 0)) ((0 1 2 3))))";
inline const std::string kThreeAtAnEdge =
    "(mesh3d (((0 0 0) (1 0 0) (0 1 0) (0 -1 0) (0 0 1)) ((0 1 2) (1 0 3) (0 1 4))))";

}  // namespace algebra3d::detail
