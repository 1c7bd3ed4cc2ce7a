#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/nonmanifold_tables.h"
#include "algebra3d/kernel/halfedge/halfedge_mesh.h"
#include "base/interruption_scope.h"
#include "base/radix_sort.h"
#include "base/scheduler.h"

namespace algebra3d {

namespace mesh_linker {

/// Sorts by the upper halves; entries with equal ones keep their order. Linear, so that the hub of a large fan costs no
/// more than other vertices.
inline void sort_hub(std::span<std::uint64_t> entries) {
  std::vector<std::uint64_t> buffer(entries.size());
  radix_sort<32>(entries, std::span(buffer), [](std::uint64_t entry) { return entry >> 32U; });
}

/// Sorts entries of which those with equal upper halves are in order.
inline void sort_entries(std::span<std::uint64_t> entries) {
  // Buckets have six entries on average: insertion sort. A hub of a large fan has any number.
  if (entries.size() > 2048) return sort_hub(entries);
  if (entries.size() > 32) {
    std::ranges::sort(entries);
    return;
  }
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const std::uint64_t entry = entries[i];
    std::size_t place = i;
    for (; place > 0 && entries[place - 1] > entry; --place) entries[place] = entries[place - 1];
    entries[place] = entry;
  }
}

/// Half-edges that leave vertices which are not settled, ascending.
inline std::vector<std::uint32_t> open_corners(std::span<const std::uint32_t> origins, std::size_t settled) {
  constexpr std::size_t kHalfedgesPerTask = 50000;
  return parallel_collect(origins.size(), kHalfedgesPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> result(end - begin);
    std::size_t count = 0;
    for (std::size_t h = begin; h < end; ++h) {  // without a branch that nobody could predict
      result[count] = static_cast<std::uint32_t>(h);
      count += origins[h] >= settled ? 1U : 0U;
    }
    result.resize(count);
    return result;
  });
}

}  // namespace mesh_linker

/// Fills a mesh whose points and origins stand: opposites that are unlinked, outgoing half-edges, side tables. The
/// known parts of settled vertices (see the constructors) stay as they are.
template <typename Layout>
struct MeshLinker {
  using Mesh = HalfedgeMesh<Layout>;
  using Links = typename Mesh::Links;
  /// A half-edge as seen from its edge's smaller end: larger end in the upper half, then the half-edge's index and, in
  /// the lowest bit, whether it leaves the smaller end. So order is by edge, then by half-edge.
  using Entry = std::uint64_t;

  Mesh& mesh;
  NonManifoldTables tables;
  Links links;
  /// Number of the settled vertices: the first ones.
  std::size_t settled;
  /// Half-edges that leave vertices that are not settled, ascending; not listed if no vertex is settled.
  std::vector<std::uint32_t> corners;
  /// Half-edges that are to be linked, ascending; not listed if these are all.
  std::vector<std::uint32_t> unlinked;
  /// Half-edges that are found to have no opposite.
  std::vector<std::uint32_t> alone;

  /// `open_corners`: as mesh_linker::open_corners gives them, for Links::all_but_between_open_vertices.
  MeshLinker(Mesh& linked, Links links_known, std::vector<std::uint32_t> open_corners)
      : mesh(linked), links(links_known), settled(linked.outgoing_.size()), corners(std::move(open_corners)) {
    if (links == Links::some) find_unlinked();
    if (links == Links::all_but_between_open_vertices) find_unlinked_between_open_vertices();
  }

  void build() {
    const std::vector<bool> is_open = open_vertices();
    link_edges();
    const std::vector<std::uint32_t> corner_counts = choose_outgoing();
    find_nonmanifold_vertices(corner_counts, is_open);
    if (tables.edge_starts.size() == 1 && tables.vertices.empty()) return;
    mesh.nonmanifold_ = std::make_shared<const NonManifoldTables>(std::move(tables));
  }

 private:
  static std::uint32_t halfedge_of(Entry e) { return static_cast<std::uint32_t>(e) >> 1; }
  static std::uint32_t larger_end(Entry e) { return static_cast<std::uint32_t>(e >> 32); }
  static bool same_direction(Entry a, Entry b) { return ((a ^ b) & 1) == 0; }

  void find_unlinked();
  void find_unlinked_between_open_vertices();
  template <typename Visit>
  void for_each_unlinked(Visit visit) const;
  template <typename Visit>
  void for_each_corner_downwards(Visit visit) const;
  std::vector<bool> open_vertices() const;
  std::vector<std::uint32_t> bucket_starts() const;
  std::vector<Entry> entries_by_smaller_end(std::vector<std::uint32_t>& ends) const;
  void link_edges();
  void link_bucket(std::uint32_t smaller_end, std::span<Entry> bucket);
  void link_edge(std::uint32_t smaller_end, std::span<const Entry> edge);
  void number_nonmanifold_edges();

  std::vector<std::uint32_t> choose_outgoing();
  HalfedgeId next_in_fan(HalfedgeId h) const { return mesh.opposite(mesh.prev(h)); }
  template <typename Visit>
  void walk_fan(HalfedgeId first, Visit visit) const;
  void find_nonmanifold_vertices(const std::vector<std::uint32_t>& corner_counts, const std::vector<bool>& is_open);
  void list_fans();
};

template <typename Layout>
void MeshLinker<Layout>::find_unlinked() {
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    if (mesh.opposites_[h] == Mesh::kUnlinkedHalfedge) unlinked.push_back(h);
}

template <typename Layout>
void MeshLinker<Layout>::find_unlinked_between_open_vertices() {
  for (const std::uint32_t h : corners)
    if (mesh.target(HalfedgeId(h)).index() >= settled) unlinked.push_back(h);
}

/// Calls visit(h, v) for all half-edges and the vertices that they leave, the last ones first, except settled vertices.
template <typename Layout>
template <typename Visit>
void MeshLinker<Layout>::for_each_corner_downwards(Visit visit) const {
  if (links == Links::all_but_between_open_vertices) {
    for (std::size_t i = corners.size(); i-- > 0;) visit(HalfedgeId(corners[i]), mesh.origins_[corners[i]]);
    return;
  }
  for (std::size_t h = mesh.halfedge_count(); h-- > 0;) {
    poll_interruption_at(h);
    visit(HalfedgeId(h), mesh.origins_[h]);
  }
}

/// Calls visit(h, a, b) for the ends of each half-edge that is to be linked, in order.
template <typename Layout>
template <typename Visit>
void MeshLinker<Layout>::for_each_unlinked(Visit visit) const {
  const LargeVector<std::uint32_t>& origins = mesh.origins_;
  for (const std::uint32_t h : unlinked) visit(h, origins[h], origins[mesh.next(HalfedgeId(h)).index()]);
  if (links != Links::none) return;
  const std::size_t face_count = mesh.face_count();
  for (std::size_t f = 0; f < face_count; ++f) {
    poll_interruption_at(f);
    const std::uint32_t first = mesh.halfedge(FaceId(f)).index();
    const std::uint32_t last = first + mesh.degree(FaceId(f)) - 1;
    for (std::uint32_t h = first; h < last; ++h) visit(h, origins[h], origins[h + 1]);
    visit(last, origins[last], origins[first]);
  }
}

/// The vertices that need not be manifold, of those that are not settled.
template <typename Layout>
std::vector<bool> MeshLinker<Layout>::open_vertices() const {
  std::vector<bool> is_open(mesh.vertex_count() - settled);
  for (const std::uint32_t h : corners) is_open[mesh.origins_[h] - settled] = true;
  for_each_unlinked([&](std::uint32_t, std::uint32_t a, std::uint32_t) { is_open[a - settled] = true; });
  return is_open;
}

template <typename Layout>
std::vector<std::uint32_t> MeshLinker<Layout>::bucket_starts() const {
  std::vector<std::uint32_t> starts(mesh.vertex_count() - settled + 1, 0);
  for_each_unlinked([&](std::uint32_t, std::uint32_t a, std::uint32_t b) { ++starts[std::min(a, b) - settled]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts) {
    const std::uint32_t count = start;
    start = sum;
    sum += count;
  }
  return starts;
}

/// Counting sort; turns the bucket starts that it is given into bucket ends.
template <typename Layout>
std::vector<typename MeshLinker<Layout>::Entry> MeshLinker<Layout>::entries_by_smaller_end(
    std::vector<std::uint32_t>& ends) const {
  std::vector<Entry> entries(ends.back());
  for_each_unlinked([&](std::uint32_t h, std::uint32_t a, std::uint32_t b) {
    const bool upwards = a < b;
    entries[ends[(upwards ? a : b) - settled]++] = (Entry{upwards ? b : a} << 32) | (Entry{h} << 1) | Entry{upwards};
  });
  return entries;
}

template <typename Layout>
void MeshLinker<Layout>::link_edges() {
  std::vector<std::uint32_t> ends = bucket_starts();
  std::vector<Entry> entries = entries_by_smaller_end(ends);
  std::uint32_t start = 0;
  for (std::size_t v = settled; v < mesh.vertex_count(); ++v) {
    poll_interruption_at(v);
    const std::uint32_t end = ends[v - settled];
    link_bucket(static_cast<std::uint32_t>(v), std::span(entries).subspan(start, end - start));
    start = end;
  }
  number_nonmanifold_edges();
}

template <typename Layout>
void MeshLinker<Layout>::link_bucket(std::uint32_t smaller_end, std::span<Entry> bucket) {
  mesh_linker::sort_entries(bucket);
  for (std::size_t first = 0, last = 0; first < bucket.size(); first = last) {
    while (last < bucket.size() && larger_end(bucket[last]) == larger_end(bucket[first])) ++last;
    link_edge(smaller_end, bucket.subspan(first, last - first));
  }
}

template <typename Layout>
void MeshLinker<Layout>::link_edge(std::uint32_t smaller_end, std::span<const Entry> edge) {
  const bool is_loop = larger_end(edge[0]) == smaller_end;
  if (edge.size() == 2 && !same_direction(edge[0], edge[1]) && !is_loop) {
    mesh.opposites_[halfedge_of(edge[0])] = halfedge_of(edge[1]);
    mesh.opposites_[halfedge_of(edge[1])] = halfedge_of(edge[0]);
  } else if (edge.size() == 1 && !is_loop) {
    mesh.opposites_[halfedge_of(edge[0])] = Mesh::kBoundary;
    alone.push_back(halfedge_of(edge[0]));
  } else {
    for (const Entry e : edge) tables.edge_halfedges.emplace_back(halfedge_of(e));
    tables.edge_starts.push_back(static_cast<std::uint32_t>(tables.edge_halfedges.size()));
  }
}

/// Orders the non-manifold edges by first half-edge and writes their numbers in place of opposites.
template <typename Layout>
void MeshLinker<Layout>::number_nonmanifold_edges() {
  const NonManifoldTables found = std::move(tables);
  tables = {};
  std::vector<std::uint32_t> order(found.edge_starts.size() - 1);
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return found.edge_halfedges[found.edge_starts[i]]; });
  tables.edge_halfedges.reserve(found.edge_halfedges.size());
  for (std::uint32_t number = 0; number < order.size(); ++number) {
    poll_interruption_at(number);
    for (std::uint32_t i = found.edge_starts[order[number]]; i < found.edge_starts[order[number] + 1]; ++i) {
      const HalfedgeId h = found.edge_halfedges[i];
      mesh.opposites_[h.index()] = Mesh::kNoOpposite | number;
      alone.push_back(h.index());
      tables.edge_halfedges.push_back(h);
    }
    tables.edge_starts.push_back(static_cast<std::uint32_t>(tables.edge_halfedges.size()));
  }
}

/// Gives each vertex its first fan's start: a half-edge without opposite if there is one, else the lowest that leaves
/// it. Returns how many half-edges leave each vertex that is not settled.
template <typename Layout>
std::vector<std::uint32_t> MeshLinker<Layout>::choose_outgoing() {
  mesh.outgoing_.resize(mesh.vertex_count());
  std::vector<std::uint32_t> corner_counts(mesh.vertex_count() - settled, 0);
  // Downwards, so that the lowest one is written last.
  for_each_corner_downwards([&](HalfedgeId h, std::uint32_t v) {
    mesh.outgoing_[v] = h;
    ++corner_counts[v - settled];
  });
  for (const std::uint32_t h : alone) mesh.outgoing_[mesh.origins_[h]] = HalfedgeId();
  for (const std::uint32_t h : alone) {
    HalfedgeId& lowest = mesh.outgoing_[mesh.origins_[h]];
    lowest = std::min(lowest, HalfedgeId(h));  // the invalid handle is greater than all
  }
  return corner_counts;
}

template <typename Layout>
template <typename Visit>
void MeshLinker<Layout>::walk_fan(HalfedgeId first, Visit visit) const {
  HalfedgeId h = first;
  do {
    visit(h);
    h = next_in_fan(h);
  } while (h.is_valid() && h != first);
}

/// A vertex is manifold if the walk from its outgoing half-edge meets all half-edges that leave it.
template <typename Layout>
void MeshLinker<Layout>::find_nonmanifold_vertices(const std::vector<std::uint32_t>& corner_counts,
                                                   const std::vector<bool>& is_open) {
  for (std::size_t v = settled; v < mesh.vertex_count(); ++v) {
    poll_interruption_at(v);
    if (!is_open[v - settled]) continue;
    std::uint32_t met = 0;
    walk_fan(mesh.outgoing_[v], [&](HalfedgeId) { ++met; });
    if (met != corner_counts[v - settled]) tables.vertices.push_back(static_cast<std::uint32_t>(v));
  }
  if (!tables.vertices.empty()) list_fans();
}

/// Lists the fans of all non-manifold vertices: open ones first, since they have but one start, then what is left, the
/// closed ones, each from its lowest half-edge.
template <typename Layout>
void MeshLinker<Layout>::list_fans() {
  std::vector<bool> is_pending(mesh.vertex_count(), false);
  for (const std::uint32_t v : tables.vertices) is_pending[v] = true;
  std::vector<bool> is_listed(mesh.halfedge_count(), false);
  std::vector<std::pair<std::uint32_t, HalfedgeId>> fans;
  for (const bool open : {true, false}) {
    for (std::size_t h = 0; h < mesh.halfedge_count(); ++h) {
      poll_interruption_at(h);
      const std::uint32_t v = mesh.origins_[h];
      if (!is_pending[v] || is_listed[h] || (open && mesh.opposite(HalfedgeId(h)).is_valid())) continue;
      fans.emplace_back(v, HalfedgeId(h));
      walk_fan(HalfedgeId(h), [&](HalfedgeId met) { is_listed[met.index()] = true; });
    }
  }
  std::ranges::sort(fans);
  tables.fans.reserve(fans.size());
  for (const auto& [v, h] : fans) {
    if (!tables.fans.empty() && mesh.origins_[tables.fans.back().index()] != v)
      tables.fan_starts.push_back(static_cast<std::uint32_t>(tables.fans.size()));
    tables.fans.push_back(h);
  }
  tables.fan_starts.push_back(static_cast<std::uint32_t>(tables.fans.size()));
  for (std::size_t i = 0; i < tables.vertices.size(); ++i)
    mesh.outgoing_[tables.vertices[i]] = tables.fans[tables.fan_starts[i]];
}

}  // namespace algebra3d
