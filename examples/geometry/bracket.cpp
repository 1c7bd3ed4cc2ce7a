// Makes a bracket from two boxes and a hole, measures it, and writes it as an STL file that is read again.
#include <iostream>

#include "algebra3d/geometry/mesh_files.h"
#include "algebra3d/geometry/solid.h"

using algebra3d::Result;
using algebra3d::Solid;
using algebra3d::Status;

namespace {

Result<Solid> bracket() {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid foot, Solid::box({0, 0, 0}, {60, 30, 6}));
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid wall, Solid::box({0, 0, 0}, {6, 30, 40}));
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid drill, Solid::box({35, 10, -1}, {45, 20, 7}));
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid hole, drill.rotated({40, 15, 0}, {0, 0, 1}, 30));
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid body, unite(foot, wall));
  return subtract(body, hole);
}

Status run() {
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid part, bracket());
  std::cout << "triangles " << part.triangle_count() << "\nvolume " << part.volume() << "\n";
  ALGEBRA3D_RETURN_IF_ERROR(write_solid(part, "bracket.stl"));
  ALGEBRA3D_ASSIGN_OR_RETURN(const algebra3d::ReadSolid read, algebra3d::read_solid("bracket.stl"));
  std::cout << "read again: " << read.status << "\n";
  return {};
}

}  // namespace

int main() {
  const Status status = run();
  if (!status) std::cerr << status.error().text() << "\n";
  return status ? 0 : 1;
}
