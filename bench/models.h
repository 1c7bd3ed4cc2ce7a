#pragma once

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/repair/solid_from_soup.h"
#include "shapes.h"
#include "stl/stl_reader.h"

/// Real files that several benchmarks use.
namespace bench {

/// The solids in the STL files that ALGEBRA3D_MODELS names, with colons between them; files without a solid are left
/// out.
inline const std::vector<Shape>& models() {
  static const std::vector<Shape> all = [] {
    std::vector<Shape> shapes;
    const char* names = std::getenv("ALGEBRA3D_MODELS");
    std::istringstream list(names != nullptr ? names : "");
    for (std::string name; std::getline(list, name, ':');) {
      const auto file = mesh_formats::read_stl_file(name);
      if (!file.ok()) continue;
      const auto solid = algebra3d::solid_from_soup(file->soup);
      if (!solid.ok() || !solid->mesh) continue;
      Shape& shape = shapes.emplace_back();
      shape.points = solid->mesh->points().approx();
      for (std::uint32_t f = 0; f < solid->mesh->face_count(); ++f)
        shape.triangles.push_back(solid->mesh->triangle(algebra3d::FaceId(f)));
    }
    return shapes;
  }();
  return all;
}

/// A copy of the model: 0 turned about its middle and shifted by a tenth of its size, 1 shifted by 1e-9 of it.
inline Shape copy_of(const Shape& model, std::int64_t variant) {
  algebra3d::Box3 box;
  for (const Vec3& p : model.points) box.extend(p);
  const Vec3 size = box.max - box.min, middle = 0.5 * (box.min + box.max);
  if (variant == 1) return moved(model, kAxis, 0, 1e-9 * size);
  Shape centred = model;
  for (Vec3& p : centred.points) p = p - middle;
  return moved(std::move(centred), kAxis, kRoot2 / 2, middle + 0.1 * size);
}

}  // namespace bench
