#pragma once

#include <string>

// Sample values that the examples of several operator families use, in the notation of examples
// (registry/example_notation.h).

namespace algebra3d {

inline const std::string kOrigin = "(makePoint3D 0 0 0)";
inline const std::string kUndefinedPoint = "(point3d undefined)";
inline const std::string kUndefinedSolid = "(volume3d undefined)";
inline const std::string kUndefinedMesh = "(mesh3d undefined)";
inline const std::string kUnitCube = "(createCube (makePoint3D 0 0 0) (makePoint3D 1 1 1))";
inline const std::string kInnerCube = "(createCube (makePoint3D 0.5 0.5 0.5) (makePoint3D 1.5 1.5 1.5))";
inline const std::string kUnitRegion = "(rect2region (rectangle2 0 1 0 1))";
inline const std::string kCubeOfTwo = "(createCube (makePoint3D 0 0 0) (makePoint3D 2 2 2))";

}  // namespace algebra3d
