#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algebra3d/kernel/halfedge/mesh_attributes.h"

namespace algebra3d {

/// New values of attributes, each a weighted mean of others. Numbers are averaged; a text is kept if all have it. A
/// mean is undefined if one of the others is, or if texts differ. Blends are numbered after the values that are there,
/// in the order in which they are added, and may refer to earlier ones.
class ValueBlends {
 public:
  struct Term {
    std::uint32_t value;
    double weight;
  };

  /// `value_count`: number of values that are there.
  explicit ValueBlends(std::size_t value_count = 0) : value_count_(value_count) {}

  /// The number of the new value; kNone if a term has kNone. Weights must be positive.
  std::uint32_t add(std::span<const Term> terms);
  /// The value at a share of the way from one to another.
  std::uint32_t add_between(std::uint32_t first, std::uint32_t second, double share);

  std::size_t size() const { return starts_.size() - 1; }
  /// The values, and those of the blends behind them. `values` must be canonical, and as many as were announced.
  AttributeValues appended_to(const AttributeValues& values) const;

 private:
  std::size_t value_count_;
  std::vector<std::size_t> starts_{0};  // per blend the first of its terms, and the end
  std::vector<Term> terms_;
};

/// The blends among the sources of elements.
struct ElementBlends {
  ValueBlends vertices, edges, halfedges, faces;

  ElementBlends() = default;
  /// No blends of the elements of a mesh.
  explicit ElementBlends(const PolygonMesh& mesh);
};

/// The attributes of the elements that are the sources, some of which are blends.
MeshAttributes taken_over(const MeshAttributes& attributes, const ElementSources& sources, const ElementBlends& blends);

/// The attributes of a mesh whose vertices were merged. A corner that is now at the place of another vertex of `source`
/// takes the value that this vertex has in the same chart; a chart is a set of faces connected across edges on both
/// sides of which the values agree. Without a corner in the chart it keeps its own value. So texture coordinates stay
/// those of the place, and seams stay seams. `result`: the mesh of the sources. Cost: linear.
MeshAttributes taken_over_merged(const MeshAttributes& attributes, const PolygonMesh& source, const PolygonMesh& result,
                                 ElementSources sources, const ElementBlends& blends);

}  // namespace algebra3d
