#pragma once

#include <vector>

#include "algebra3d/base/monitor.h"
#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/operand.h"
#include "algebra3d/kernel/validity/face_set.h"

namespace algebra3d {

/// The faces of any mesh as operands of an autorefinement: a list of valid surfaces, as Closure::together demands, so
/// that an arrangement of them divides the mesh at its own crossings. One part holds the faces that `disentangle`
/// (validity.h) finds free of conflicts with each other; every other face with an area (an entangled one) is a part of
/// its own. Degenerate faces are left out.
class ValidParts {
 public:
  /// `known`: faces that an earlier proof found to be a valid surface by themselves. Errors: interrupted. Exact. Cost:
  /// that of a proof.
  static Result<ValidParts> make(const TriangleMesh& mesh, const Monitor& monitor = {}, const FaceSet& known = {});
  /// As above; faces flagged in `are_alone`, one flag per face, also become parts of their own. For faces at edges that
  /// were non-manifold in the mesh from which this one was taken (repair/detail/winding_segmentation.h).
  static Result<ValidParts> make(const TriangleMesh& mesh, const std::vector<bool>& are_alone,
                                 const Monitor& monitor = {}, const FaceSet& known = {});
  /// Divides the mesh into fewer parts than `make` where many edges are non-manifold, as where boundaries cross that
  /// are joined in vertices. Faces that alternate around an edge, as those of solids do, stay together; others that
  /// meet in a non-manifold edge go to different sheets. Only entangled faces of each sheet become parts of their own.
  /// Errors and cost as above.
  static Result<ValidParts> in_sheets(const TriangleMesh& mesh, const Monitor& monitor = {});

  /// One operand per part, all of group 0. Valid as long as this object.
  const std::vector<Operand>& operands() const { return operands_; }
  /// The faces that are parts of their own, ascending.
  const std::vector<FaceId>& lone_faces() const { return lone_faces_; }

  ValidParts(ValidParts&& other) = default;
  ValidParts& operator=(ValidParts&& other) = default;
  ValidParts(const ValidParts&) = delete;
  ValidParts& operator=(const ValidParts&) = delete;
  ~ValidParts() = default;

 private:
  ValidParts() = default;
  void add_alone(const TriangleMesh& mesh, FaceId face);
  void list_operands();

  std::vector<TriangleMesh> meshes_;  // the operands refer to them
  std::vector<FaceId> lone_faces_;
  std::vector<Operand> operands_;
};

}  // namespace algebra3d
