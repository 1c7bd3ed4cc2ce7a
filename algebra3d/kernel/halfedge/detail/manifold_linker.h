#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/halfedge/detail/mesh_linker.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"
#include "base/indices.h"
#include "base/interruption_scope.h"
#include "base/scheduler.h"

namespace algebra3d {

/// Links a mesh in one pass over the faces, if everything is manifold: a half-edge waits in a list of its
/// target for the opposite one. Where faces that are near each other have near numbers, the lists are short and in the
/// cache, and nothing is sorted.
template <typename Layout>
class ManifoldLinker {
  using Mesh = HalfedgeMesh<Layout>;
  using Links = typename Mesh::Links;

 public:
  /// `given`: none, proposed (each half-edge is linked or kUnlinkedHalfedge), or all_but_between_open_vertices, with
  /// the half-edges that leave such vertices, ascending.
  ManifoldLinker(Mesh& mesh, Links given, std::span<const std::uint32_t> open_corners)
      : mesh_(mesh), given_(given), settled_(mesh.outgoing_.size()), open_corners_(open_corners) {}

  /// Fills opposites and outgoing half-edges. False if an edge or a vertex is not manifold, or if a list gets long (at
  /// the hub of a large fan whose triangles are in random order): then what was not given is without meaning.
  bool link() {
    constexpr std::size_t kWorthAThread = 50000;
    bool matched = false;
    mesh_.outgoing_.resize(mesh_.vertex_count());
    parallel_invoke(
        corner_count() > kWorthAThread, [&] { matched = match_halfedges(); }, [&] { choose_outgoing(); });
    if (matched && mark_boundary() && is_manifold()) return true;
    mesh_.outgoing_.resize(settled_);
    return false;
  }

 private:
  static constexpr std::uint32_t kNobody = kNone;
  static constexpr std::size_t kLongestList = 64;

  bool has_settled() const { return given_ == Links::all_but_between_open_vertices; }
  /// Number of the half-edges that leave vertices which are not settled.
  std::size_t corner_count() const { return has_settled() ? open_corners_.size() : mesh_.halfedge_count(); }
  bool match_halfedges();
  bool match_between_open_vertices();
  LargeVector<std::uint32_t> unlinked() const;
  bool match(std::uint32_t h, std::uint32_t from, std::uint32_t to);
  void choose_outgoing();
  bool mark_boundary();
  bool is_manifold() const;
  std::size_t count_fan(VertexId v) const;
  std::size_t count_large_fan(VertexId v) const;

  HalfedgeMesh<Layout>& mesh_;
  Links given_;
  std::size_t settled_;  // number of the settled vertices: the first ones
  std::span<const std::uint32_t> open_corners_;
  // Per vertex that is not settled: a half-edge to it that waits; opposites have the rest.
  LargeVector<std::uint32_t> waiting_;
};

template <typename Layout>
bool ManifoldLinker<Layout>::match_halfedges() {
  waiting_.assign(mesh_.vertex_count() - settled_, kNobody);
  if (has_settled()) return match_between_open_vertices();
  if (given_ == Links::proposed)
    return std::ranges::all_of(
        unlinked(), [&](std::uint32_t h) { return match(h, mesh_.origins_[h], mesh_.target(HalfedgeId(h)).index()); });
  const std::size_t face_count = mesh_.face_count();
  for (std::size_t f = 0; f < face_count; ++f) {
    poll_interruption_at(f);
    const std::uint32_t first = mesh_.halfedge(FaceId(f)).index();
    const std::uint32_t last = first + mesh_.degree(FaceId(f)) - 1;
    for (std::uint32_t h = first; h <= last; ++h) {
      const std::uint32_t to = mesh_.origins_[h == last ? first : h + 1];
      if (!match(h, mesh_.origins_[h], to)) return false;
    }
  }
  return true;
}

template <typename Layout>
bool ManifoldLinker<Layout>::match_between_open_vertices() {
  return std::ranges::all_of(open_corners_, [&](std::uint32_t h) {
    poll_interruption_at(h);
    const std::uint32_t to = mesh_.target(HalfedgeId(h)).index();
    return to < settled_ || match(h, mesh_.origins_[h], to);
  });
}

template <typename Layout>
LargeVector<std::uint32_t> ManifoldLinker<Layout>::unlinked() const {
  LargeVector<std::uint32_t> result(mesh_.halfedge_count());
  std::size_t count = 0;
  for (std::uint32_t h = 0; h < result.size(); ++h) {  // without a branch that nobody could predict
    result[count] = h;
    count += mesh_.opposites_[h] == Mesh::kUnlinkedHalfedge ? 1U : 0U;
  }
  result.resize(count);
  return result;
}

/// Gives each vertex that is not settled the lowest half-edge that leaves it.
template <typename Layout>
void ManifoldLinker<Layout>::choose_outgoing() {
  std::fill(mesh_.outgoing_.begin() + static_cast<std::ptrdiff_t>(settled_), mesh_.outgoing_.end(), HalfedgeId());
  const auto choose = [&](std::size_t h) { mesh_.outgoing_[mesh_.origins_[h]] = HalfedgeId(h); };
  if (has_settled())
    std::for_each(open_corners_.rbegin(), open_corners_.rend(), choose);
  else
    for (std::size_t h = mesh_.halfedge_count(); h-- > 0;) choose(h);
}

/// Links `h` with a half-edge that waits for it, or lets it wait.
template <typename Layout>
bool ManifoldLinker<Layout>::match(std::uint32_t h, std::uint32_t from, std::uint32_t to) {
  if (from == to) return false;
  std::uint32_t* place = &waiting_[from - settled_];
  for (std::size_t length = 0; *place != kNobody; ++length) {
    const std::uint32_t other = *place;
    if (mesh_.origins_[other] == to) {
      *place = mesh_.opposites_[other];
      mesh_.opposites_[other] = h;
      mesh_.opposites_[h] = other;
      return true;
    }
    if (length == kLongestList) return false;
    place = &mesh_.opposites_[other];
  }
  std::uint32_t& last = waiting_[to - settled_];
  mesh_.opposites_[h] = std::exchange(last, h);
  return true;
}

/// Half-edges that still wait are on the boundary, or along edges that are not manifold. False where one vertex has
/// several such.
template <typename Layout>
bool ManifoldLinker<Layout>::mark_boundary() {
  return std::ranges::all_of(waiting_, [&](std::uint32_t first) {
    if (first == kNobody) return true;
    if (mesh_.opposites_[first] != kNobody) return false;
    mesh_.opposites_[first] = Mesh::kBoundary;
    mesh_.outgoing_[mesh_.origins_[first]] = HalfedgeId(first);
    return true;
  });
}

/// Whether the walks round the vertices that are not settled meet all half-edges that leave these, and none has two
/// half-edges to the same one.
template <typename Layout>
bool ManifoldLinker<Layout>::is_manifold() const {
  constexpr std::size_t kVerticesPerTask = 20000;
  const std::size_t tasks = (mesh_.vertex_count() - settled_ + kVerticesPerTask - 1) / kVerticesPerTask;
  std::vector<std::size_t> met(tasks);
  parallel_for(tasks, 1, [&](std::size_t task) {
    const std::size_t begin = settled_ + task * kVerticesPerTask;
    const std::size_t end = std::min(mesh_.vertex_count(), begin + kVerticesPerTask);
    std::size_t count = 0;
    for (std::size_t v = begin; v < end; ++v) count += count_fan(VertexId(v));
    met[task] = count;
  });
  std::size_t sum = 0;
  for (const std::size_t count : met) sum += count;
  return sum == corner_count();
}

/// The number of half-edges in the fan of `v`; 0 if two edges of the fan have the same other end.
template <typename Layout>
std::size_t ManifoldLinker<Layout>::count_fan(VertexId v) const {
  std::array<std::uint32_t, 16> ends;  // NOLINT(cppcoreguidelines-pro-type-member-init): `count` of them are set
  std::size_t count = 0;
  const HalfedgeId first = mesh_.outgoing_[v.index()];
  for (HalfedgeId h = first; h.is_valid();) {
    if (count == ends.size()) return count_large_fan(v);
    const HalfedgeId incoming = mesh_.prev(h);
    const std::uint32_t end = mesh_.origins_[incoming.index()];
    for (std::size_t i = 0; i < count; ++i)
      if (ends[i] == end) return 0;
    ends[count++] = end;
    h = mesh_.opposite(incoming);
    if (h == first) break;
  }
  return count;
}

template <typename Layout>
std::size_t ManifoldLinker<Layout>::count_large_fan(VertexId v) const {
  std::vector<std::uint64_t> ends;
  const HalfedgeId first = mesh_.outgoing_[v.index()];
  HalfedgeId h = first;
  do {
    const HalfedgeId incoming = mesh_.prev(h);
    ends.push_back(std::uint64_t{mesh_.origins_[incoming.index()]} << 32);
    h = mesh_.opposite(incoming);
  } while (h.is_valid() && h != first);
  mesh_linker::sort_entries(ends);
  return std::ranges::adjacent_find(ends) == ends.end() ? ends.size() : 0;
}

}  // namespace algebra3d
