#pragma once

#include <array>
#include <cstdint>

#include "algebra3d/arrangement/facets.h"

namespace algebra3d {

/// All facets of one mesh, which must outlive this.
class MeshFacets {
 public:
  explicit MeshFacets(const TriangleMesh& mesh) : operand_{{{&mesh, 0}}}, operands_(operand_), facets_(operands_) {
    for (std::uint32_t face = 0; face < operands_.face_count(); ++face) facets_.add(face);
    facets_.number_planes();
  }
  MeshFacets(const MeshFacets&) = delete;
  MeshFacets& operator=(const MeshFacets&) = delete;

  const arrangement::Facets* operator->() const { return &facets_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(facets_.size()); }
  std::uint32_t face_count() const { return operands_.face_count(); }
  /// The front of the facet is seen clockwise there if `is_flipped`.
  Projection projection(std::uint32_t facet) const { return facets_.planes()[facets_[facet].plane].projection; }
  bool is_flipped(std::uint32_t facet) const { return facets_[facet].orientation < 0; }

 private:
  std::array<Operand, 1> operand_;
  arrangement::Operands operands_;
  arrangement::Facets facets_;
};

}  // namespace algebra3d
