#pragma once

#include <string>

// Values that the examples of several operator families are made of, as query text.

namespace algebra3d {

inline const std::string kOrigin = "makePoint3D(0, 0, 0)";
inline const std::string kUndefinedPoint = "[const point3d value undefined]";
inline const std::string kUndefinedSolid = "[const volume3d value undefined]";
inline const std::string kUnitCube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";
inline const std::string kCubeOfTwo = "createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))";

}  // namespace algebra3d
