#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/validity/validity.h"
#include "unit/arrangement/solids.h"

/// The engine as the tests call it. No operation may fail on valid solids, and each result has to be one: what is wrong
/// is collected, so that the caller can say with which operands.
namespace algebra3d::solids {

using Solids = std::vector<const TriangleMesh*>;

inline Rational exact_volume_of(const TriangleMesh& mesh) {
  return exact_volume(mesh.points(), triangles_of(mesh)).value();
}

/// The proof of a large result takes longer than the operation.
enum class Proofs : std::uint8_t { each_result, none };

class SetOperations {
 public:
  explicit SetOperations(Proofs proofs = Proofs::each_result) : proofs_(proofs) {}

  TriangleMesh unite(const TriangleMesh& a, const TriangleMesh& b) { return unite_all({&a, &b}); }
  TriangleMesh intersect(const TriangleMesh& a, const TriangleMesh& b) { return intersect_all({&a, &b}); }
  TriangleMesh subtract(const TriangleMesh& a, const TriangleMesh& b) {
    return run("minus", {&a}, {&b}, [](const auto& windings) { return windings[0] > 0 && windings[1] == 0; });
  }
  TriangleMesh difference_of_both(const TriangleMesh& a, const TriangleMesh& b) {
    return run("symmetric difference", {&a}, {&b},
               [](const auto& windings) { return (windings[0] > 0) != (windings[1] > 0); });
  }
  TriangleMesh unite_all(const Solids& solids) {
    return run("union", solids, {}, [](const auto& windings) { return windings[0] > 0; });
  }
  TriangleMesh intersect_all(const Solids& solids) {
    const auto count = static_cast<std::int32_t>(solids.size());
    return run("intersection", solids, {}, [count](const auto& windings) { return windings[0] == count; });
  }

  /// Same set of points: no place is in one alone, and the volumes agree.
  bool same(const TriangleMesh& a, const TriangleMesh& b) {
    return difference_of_both(a, b).is_empty() && exact_volume_of(a) == exact_volume_of(b);
  }

  /// One line for each operation that failed or gave an invalid solid.
  const std::string& complaints() const { return complaints_; }
  std::size_t count() const { return count_; }

 private:
  TriangleMesh run(const char* name, const Solids& first, const Solids& second, const KeepRule& rule) {
    ++count_;
    std::vector<Operand> operands;
    for (const TriangleMesh* mesh : first) operands.push_back({mesh, 0});
    for (const TriangleMesh* mesh : second) operands.push_back({mesh, 1});
    Result<TriangleMesh> result = combine_solids(operands, rule);
    if (!result.ok()) {
      complaints_ += std::string(name) + ": " + result.error().message + "\n";
      return {};
    }
    if (proofs_ == Proofs::none) return std::move(result).value();
    const auto report = prove_volume(*result);
    if (!report->is_valid()) complaints_ += std::string(name) + ": " + report->text() + "\n";
    for (const std::string& violation : audit(*result)) complaints_ += std::string(name) + ": " + violation + "\n";
    for (std::size_t v = 0; v < result->vertex_count(); ++v)
      if (result->is_isolated(VertexId(v))) complaints_ += std::string(name) + ": an isolated vertex\n";
    return std::move(result).value();
  }

  Proofs proofs_;
  std::string complaints_;
  std::size_t count_ = 0;
};

}  // namespace algebra3d::solids
