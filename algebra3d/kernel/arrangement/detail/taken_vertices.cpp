#include "algebra3d/kernel/arrangement/detail/taken_vertices.h"

#include <algorithm>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "base/scheduler.h"

namespace algebra3d::arrangement {
namespace {

constexpr std::size_t kVerticesPerTask = kFacesPerTask;

std::size_t block_count(const Operands& operands) {
  return (operands.vertex_count() + kVerticesPerTask - 1) / kVerticesPerTask;
}

/// Calls visit(block, operand, vertex) for all vertices, those of different blocks in parallel.
template <typename Visit>
void for_each_vertex(const Operands& operands, const Visit& visit) {
  parallel_for(block_count(operands), 1, [&](std::size_t block) {
    const InputVertexId begin(block * kVerticesPerTask);
    const InputVertexId end(std::min((block + 1) * kVerticesPerTask, operands.vertex_count()));
    OperandId operand = operands.operand_of(begin);
    for (const InputVertexId vertex : IdRange(begin, end)) {
      while (vertex >= *operands.vertices(operand).end()) operand = OperandId(operand.index() + 1);
      visit(block, operand, vertex);
    }
  });
}

}  // namespace

TakenVertices::TakenVertices(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept)
    : subdivision_(subdivision),
      operands_(subdivision.operands),
      numbers_(operands_.vertex_count()),
      at_nodes_(subdivision.complex.nodes.size()) {
  for (const OperandId operand : operands_.ids())
    for (const VertexId vertex : operands_.mesh(operand).nonmanifold_vertices())
      others_.push_back(operands_.input(operand, vertex));
  for (const InputVertexId vertex : others_) numbers_[vertex] = kOpen;
  for (const auto& [vertex, node] : subdivision_.complex.nodes_of_vertices) numbers_[vertex] = kOpen;
  number_settled(kept);
  number_nodes(patch_corners);
  number_others(kept);
}

/// Vertices off nodes have all their faces in one patch, or all in facets, if the faces are one fan.
void TakenVertices::number_settled(const KeptPatches& kept) {
  struct Block {
    std::size_t first = 0, count = 0;
    std::vector<InputVertexId> on_boundary = {};
  };
  std::vector<Block> blocks(block_count(operands_));
  for_each_vertex(operands_, [&](std::size_t block, OperandId operand, InputVertexId vertex) {
    VertexId& number = numbers_[vertex];
    if (number == kOpen) return;
    const TriangleMesh& mesh = operands_.mesh(operand);
    const HalfedgeId outgoing = mesh.outgoing(operands_.in_mesh(operand, vertex));
    if (!outgoing.is_valid() || !is_kept(operand, outgoing, kept)) return;
    number = mesh.is_boundary(outgoing) ? kOpen : VertexId(blocks[block].count++);
    if (number == kOpen) blocks[block].on_boundary.push_back(vertex);
  });
  for (Block& block : blocks) {
    block.first = settled_count_;
    settled_count_ += block.count;
    others_.insert(others_.end(), block.on_boundary.begin(), block.on_boundary.end());
  }
  for_each_vertex(operands_, [&](std::size_t block, OperandId, InputVertexId vertex) {
    VertexId& number = numbers_[vertex];
    if (number.is_valid() && number != kOpen) number = VertexId(blocks[block].first + number.index());
  });
}

bool TakenVertices::is_kept(OperandId operand, HalfedgeId halfedge, const KeptPatches& kept) const {
  const InputFaceId face = operands_.input(operand, TriangleMesh::face(halfedge));
  return kept_of_face(face, subdivision_.patches, kept) != 0;
}

void TakenVertices::number_nodes(const PatchCorners& patch_corners) {
  for (const NodeId node : at_nodes_.ids())
    if (patch_corners.is_corner(node)) at_nodes_[node] = VertexId(settled_count_ + node_count_++);
  for (const auto& [vertex, node] : subdivision_.complex.nodes_of_vertices) numbers_[vertex] = at_nodes_[node];
}

void TakenVertices::number_others(const KeptPatches& kept) {
  std::erase_if(others_, [&](InputVertexId vertex) {
    if (numbers_[vertex] != kOpen) return true;  // at a node
    const OperandId operand = operands_.operand_of(vertex);
    return std::ranges::none_of(operands_.mesh(operand).fans(operands_.in_mesh(operand, vertex)),
                                [&](HalfedgeId fan) { return is_kept(operand, fan, kept); });
  });
  for (std::size_t i = 0; i < others_.size(); ++i) numbers_[others_[i]] = VertexId(settled_count_ + node_count_ + i);
}

PointArray TakenVertices::points() const {
  PointArray points;
  points.reserve(settled_count_ + at_nodes_.size() + others_.size());
  for (const OperandId operand : operands_.ids()) {
    const IdRange<InputVertexId> vertices = operands_.vertices(operand);
    const auto is_settled = [&](InputVertexId vertex) { return numbers_[vertex].index() < settled_count_; };
    for (InputVertexId first = vertices.front(), last = first; first < *vertices.end(); first = last) {
      while (last < *vertices.end() && is_settled(last)) last = InputVertexId(last.index() + 1);
      points.append(operands_.mesh(operand).points(), operands_.in_mesh(operand, first).index(),
                    last.index() - first.index());
      while (last < *vertices.end() && !is_settled(last)) last = InputVertexId(last.index() + 1);
    }
  }
  for (const NodeId node : at_nodes_.ids())
    if (at_nodes_[node].is_valid()) points.push_back(subdivision_.complex.nodes[node]);
  for (const InputVertexId vertex : others_) {
    const OperandId operand = operands_.operand_of(vertex);
    points.push_back(operands_.mesh(operand).point(operands_.in_mesh(operand, vertex)));
  }
  return points;
}

/// The lowest half-edge that leaves a vertex is of the lowest face, which stays the lowest.
LargeVector<HalfedgeId> TakenVertices::outgoing(const TakenRuns& runs) const {
  LargeVector<HalfedgeId> result;
  result.resize(settled_count_);
  std::vector<const TakenRun*> last_runs(block_count(operands_));  // neighbours are mostly in one run
  for_each_vertex(operands_, [&](std::size_t block, OperandId operand, InputVertexId vertex) {
    const std::size_t number = numbers_[vertex].index();
    if (number >= settled_count_) return;
    const HalfedgeId halfedge = operands_.mesh(operand).outgoing(operands_.in_mesh(operand, vertex));
    const FaceId face = TriangleMesh::face(halfedge);
    const TakenRun*& run = last_runs[block];
    if (run == nullptr || run->operand != operand || !run->contains(face))
      run = runs.find(operands_.input(operand, face));
    result[number] = run->leaving(halfedge);
  });
  return result;
}

}  // namespace algebra3d::arrangement
