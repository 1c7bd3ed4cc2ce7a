#include "algebra3d/kernel/arrangement/detail/result_mesh.h"

#include <algorithm>
#include <numeric>

#include "algebra3d/kernel/arrangement/detail/task_sizes.h"
#include "algebra3d/kernel/halfedge/face_order.h"
#include "base/interruption_scope.h"
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

/// Fewer are sorted as soon.
constexpr std::size_t kFewFaces = 512;

/// The operand that gives three quarters of the faces; else none.
OperandId main_operand(const Operands& operands, const TakenRuns& runs) {
  IdVector<OperandId, std::size_t> counts(operands.count());
  for (const TakenRun& run : runs) counts[run.operand] += run.count;
  for (const OperandId operand : counts.ids())
    if (counts[operand] >= kFewFaces && 4 * counts[operand] >= 3 * runs.face_count()) return operand;
  return {};
}

/// The new face of each face of the operand; none where it is not taken over.
std::vector<FaceId> new_faces(const Operands& operands, const TakenRuns& runs, OperandId operand) {
  std::vector<FaceId> result(operands.mesh(operand).face_count());
  for (const TakenRun& run : runs)
    if (run.operand == operand)
      for (std::size_t i = 0; i < run.count; ++i) result[run.first.index() + i] = FaceId(run.new_first.index() + i);
  return result;
}

/// The order of faces that a result takes over from one operand, in the hierarchy of that operand, if that one gives
/// three quarters of all that are taken over, and if they are not few; else null. It is good for the hierarchy of the
/// result if its frame is the same (FaceOrder), as it mostly is where a small part of a solid changes. Cost: linear.
std::shared_ptr<const FaceOrder> taken_order(const Operands& operands, const TakenRuns& runs) {
  const OperandId operand = main_operand(operands, runs);
  if (operand.is_none()) return nullptr;
  const BoxHierarchy& hierarchy = operands.hierarchy(operand);
  const std::vector<FaceId> new_face_of = new_faces(operands, runs, operand);
  auto order = std::make_shared<FaceOrder>();
  order->frame = hierarchy.frame();
  order->faces = parallel_collect(hierarchy.face_count(), kFacesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<PlacedFace> taken(end - begin);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const PlacedFace placed = hierarchy.placed(i);
      const FaceId face = new_face_of[placed.face()];
      taken[count] = PlacedFace(placed.place(), face.index());
      count += face.is_valid() ? 1 : 0;
    }
    taken.resize(count);
    return taken;
  });
  return order;
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

void ResultPlanes::take(const TakenRun& run) {
  const FacePlanes& known = subdivision_.operands.mesh(run.operand).planes();
  if (known.size() == 0) return;
  NewNumbers& new_numbers = numbers_[run.operand][run.is_flipped ? 1 : 0];
  if (new_numbers.empty()) new_numbers.resize(known.size(), kNone);
  const std::span<std::uint32_t> taken = planes_.numbers(run.new_first.index(), run.count);
  for (std::size_t i = 0; i < run.count; ++i) {
    const std::uint32_t given = known.number(run.first.index() + i);
    poll_interruption_at(i);
    if (given == kNone) continue;
    std::uint32_t& number = new_numbers[given];
    if (number == kNone) number = planes_.add(run.is_flipped ? known[given].flipped() : known[given]);
    taken[i] = number;
  }
}

void ResultPlanes::add(IdRange<FaceId> faces, PlaneId plane, bool is_flipped) {
  const IntegerPlane exact = subdivision_.complex.coefficients.find_or_compute(subdivision_.facets, plane);
  const std::uint32_t number = planes_.add(is_flipped ? exact.flipped() : exact);
  std::ranges::fill(planes_.numbers(faces.front().index(), faces.size()), number);
}

ResultMesh::ResultMesh(const Subdivision& subdivision, const PatchCorners& patch_corners, const KeptPatches& kept,
                       std::size_t region_triangles)
    : subdivision_(subdivision),
      runs_(subdivision.operands, subdivision.patches, kept),
      vertices_(subdivision, patch_corners, kept),
      at_nodes_(vertices_.at_nodes()),
      planes_(subdivision) {
  const std::size_t capacity = 3 * (runs_.face_count() + region_triangles);
  for (auto* values : {&mesh_.origins, &mesh_.opposites}) {
    values->reserve(capacity);
    values->resize(3 * runs_.face_count());
  }
  take_patches();
}

void ResultMesh::take_patches() {
  const auto take_points_and_planes = [&] {
    mesh_.points = vertices_.points();
    for (const TakenRun& run : runs_) planes_.take(run);
    mesh_.order = taken_order(subdivision_.operands, runs_);
  };
  const auto take_faces = [&] {
    const std::size_t count = runs_.face_count();
    parallel_for((count + kFacesPerTask - 1) / kFacesPerTask, 1, [&](std::size_t i) {
      this->take_faces(FaceId(i * kFacesPerTask), FaceId(std::min((i + 1) * kFacesPerTask, count)));
    });
    mesh_.outgoing = vertices_.outgoing(runs_);
  };
  parallel_invoke(subdivision_.operands.face_count() >= kFacesWorthATask, take_points_and_planes, take_faces);
}

/// The faces of the result in a range.
void ResultMesh::take_faces(FaceId first, FaceId last) {
  for (const TakenRun* run = &runs_.with(first); first < last; ++run) {
    const std::size_t skipped = first.index() - run->new_first.index();
    const std::size_t count = std::min<std::size_t>(run->count - skipped, last.index() - first.index());
    const FaceId from(run->first.index() + skipped);
    take_corners(*run, from, count);
    take_opposites(*run, from, count);
    first = FaceId(first.index() + count);
  }
}

void ResultMesh::take_corners(const TakenRun& run, FaceId first, std::size_t count) {
  const TriangleMesh& mesh = subdivision_.operands.mesh(run.operand);
  std::uint32_t* origin =
      &mesh_.origins[3 * std::size_t{TriangleMesh::face(run.along(TriangleMesh::halfedge(first))).index()}];
  for (const FaceId face : IdRange(first, FaceId(first.index() + count))) {
    const IndexTriangle corners = mesh.triangle(face);
    for (std::size_t i = 0; i < 3; ++i)
      origin[i] = vertices_[subdivision_.operands.input(run.operand, VertexId(corners[i]))].index();
    if (run.is_flipped) std::swap(origin[1], origin[2]);
    origin += 3;
  }
}

/// As if the faces on the other side of all edges were taken. Where they are not, both ends of the edge are open.
void ResultMesh::take_opposites(const TakenRun& run, FaceId first, std::size_t count) {
  const Operands& operands = subdivision_.operands;
  const TriangleMesh& mesh = operands.mesh(run.operand);
  const TakenRun* beyond = &run;
  for (const HalfedgeId h :
       IdRange(TriangleMesh::halfedge(first), TriangleMesh::halfedge(FaceId(first.index() + count)))) {
    const HalfedgeId opposite = mesh.opposite(h);
    if (!opposite.is_valid()) continue;
    const FaceId face = TriangleMesh::face(opposite);
    if (!beyond->contains(face)) {
      const TakenRun* found = runs_.find(operands.input(run.operand, face));
      if (found == nullptr) continue;
      beyond = found;
    }
    mesh_.opposites[run.along(h).index()] = beyond->along(opposite).index();
  }
}

void ResultMesh::add(const Region& region, std::span<const IndexTriangle> triangles) {
  LargeVector<std::uint32_t>& origins = mesh_.origins;
  const FaceId first(origins.size() / 3);
  std::size_t at = origins.size();
  origins.resize(at + 3 * triangles.size());
  mesh_.opposites.resize(origins.size());
  for (const IndexTriangle& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) origins[at + i] = vertex_at(NodeId(corners[i])).index();
    if (region.key.is_flipped()) std::swap(origins[at + 1], origins[at + 2]);
    at += 3;
  }
  if (region.has_exact_corner)
    planes_.add({first, FaceId(origins.size() / 3)}, region.key.plane(), region.key.is_flipped());
}

VertexId ResultMesh::vertex_at(NodeId node) {
  VertexId& vertex = at_nodes_[node];
  if (vertex.is_valid()) return vertex;
  vertex = VertexId(mesh_.points.size());
  mesh_.points.push_back(subdivision_.complex.nodes[node]);
  return vertex;
}

UnlinkedMesh ResultMesh::finish() {
  mesh_.planes = planes_.take_planes();
  return std::move(mesh_);
}

TriangleMesh linked(UnlinkedMesh mesh) {
  return {std::move(mesh.points),   std::move(mesh.origins), std::move(mesh.opposites),
          std::move(mesh.outgoing), std::move(mesh.planes),  std::move(mesh.order)};
}

}  // namespace algebra3d::arrangement
