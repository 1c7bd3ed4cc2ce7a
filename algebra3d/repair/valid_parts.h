#pragma once

#include <vector>

#include "algebra3d/arrangement/arrangement.h"
#include "algebra3d/base/monitor.h"
#include "algebra3d/validity/face_set.h"

namespace algebra3d {

/// The faces of any mesh in parts, each of which is a valid surface without non-manifold edges: one part for all faces
/// that touch no other in more than a whole edge, and one for each other face, so that an arrangement of the parts
/// divides it at all others. Degenerate faces are left out.
class ValidParts {
 public:
  /// The faces in `known` are known to be a valid surface by themselves.
  /// Errors: interrupted. Exact. Cost: that of a proof.
  static Result<ValidParts> make(const TriangleMesh& mesh, const Monitor& monitor = {}, const FaceSet& known = {});
  /// Those faces that are named are parts by themselves, too.
  static Result<ValidParts> make(const TriangleMesh& mesh, const std::vector<bool>& are_alone,
                                 const Monitor& monitor = {}, const FaceSet& known = {});

  const std::vector<Operand>& operands() const { return operands_; }
  /// Faces that are parts by themselves.
  const std::vector<FaceId>& lone_faces() const { return lone_faces_; }

  ValidParts(ValidParts&& other) = default;
  ValidParts& operator=(ValidParts&& other) = default;
  ValidParts(const ValidParts&) = delete;
  ValidParts& operator=(const ValidParts&) = delete;
  ~ValidParts() = default;

 private:
  ValidParts() = default;

  std::vector<TriangleMesh> meshes_;  // what the operands refer to
  std::vector<FaceId> lone_faces_;
  std::vector<Operand> operands_;
};

}  // namespace algebra3d
