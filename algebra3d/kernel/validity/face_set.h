#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace algebra3d {

/// A set of faces of one mesh. The empty set needs no mesh.
class FaceSet {
 public:
  FaceSet() = default;
  /// `are_in`: one flag per face of the mesh.
  explicit FaceSet(std::vector<bool> are_in) : are_in_(std::move(are_in)) {}

  bool contains(std::uint32_t face) const { return !are_in_.empty() && are_in_[face]; }
  bool is_empty() const { return are_in_.empty(); }
  void remove(std::uint32_t face) { are_in_[face] = false; }

 private:
  std::vector<bool> are_in_;
};

}  // namespace algebra3d
