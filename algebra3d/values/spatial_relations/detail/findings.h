#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "algebra3d/values/spatial_relations/relation.h"

namespace algebra3d {

/// The question about two sets. It determines when the search may end.
enum class Question : std::uint8_t { meeting, touching, first_inside, overlap, witness, everything };

/// One of the two sets.
enum class Role : std::uint8_t { first, second };
constexpr Role other(Role role) {
  return role == Role::first ? Role::second : Role::first;
}
constexpr std::size_t index_of(Role role) {
  return static_cast<std::size_t>(role);
}
inline constexpr Role kRoles[] = {Role::first, Role::second};

/// The facts found so far about two sets that are not empty. Facts are only added, so the search may end as soon as
/// they answer the question; a fact that was not found by its end is false.
class Findings {
 public:
  explicit Findings(Question question) : question_(question) {}

  bool do_meet() const { return shared_dimension_ >= 0; }
  bool do_interiors_meet() const { return do_interiors_meet_; }
  /// True if the set has a point that is not in the other one.
  bool leaves(Role role) const { return leaves_[index_of(role)]; }
  int shared_dimension() const { return shared_dimension_; }
  int shared_boundary_dimension() const { return shared_boundary_dimension_; }
  const std::optional<MeetingWitness>& witness() const { return witness_; }

  /// True if the boundaries have to be compared, true if a witness is wanted.
  bool wants_boundaries() const { return question_ == Question::everything; }
  bool wants_witness() const { return question_ == Question::witness && !witness_; }
  /// True if the question is answered.
  bool is_complete() const {
    switch (question_) {
      case Question::meeting:
        return do_meet();
      case Question::touching:
        return do_interiors_meet_;
      case Question::first_inside:
        return leaves(Role::first);
      case Question::overlap:
        return do_interiors_meet_ && leaves(Role::first) && leaves(Role::second);
      case Question::witness:
        return witness_.has_value();
      default:
        return false;
    }
  }

  void add_common(int dimension) { shared_dimension_ = std::max(shared_dimension_, dimension); }
  void add_common_interior(int dimension) {
    do_interiors_meet_ = true;
    add_common(dimension);
  }
  void add_common_boundary(int dimension) {
    shared_boundary_dimension_ = std::max(shared_boundary_dimension_, dimension);
  }
  void add_leaving(Role role) { leaves_[index_of(role)] = true; }
  void add_witness(MeetingWitness witness) { witness_ = std::move(witness); }

 private:
  Question question_;
  bool do_interiors_meet_ = false;
  std::array<bool, 2> leaves_{};
  int shared_dimension_ = -1, shared_boundary_dimension_ = -1;
  std::optional<MeetingWitness> witness_;
};

}  // namespace algebra3d
