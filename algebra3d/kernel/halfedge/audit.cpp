#include "algebra3d/kernel/halfedge/audit.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/halfedge/nonmanifold_tables.h"

namespace algebra3d {
namespace {

/// Disjoint sets of half-edges.
class HalfedgeSets {
 public:
  explicit HalfedgeSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

  std::uint32_t find(std::uint32_t h) {
    for (; parents_[h] != h; h = parents_[h]) parents_[h] = parents_[parents_[h]];
    return h;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parents_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parents_;  // never above the element: the root is the lowest of its set
};

std::string indices(const std::vector<std::uint32_t>& values) {
  return fmt::format("({})", fmt::join(values, " "));
}

/// True if `starts` divides `size` values into lists that are not empty.
bool are_list_starts(const std::vector<std::uint32_t>& starts, std::size_t size) {
  return !starts.empty() && starts.front() == 0 && starts.back() == size &&
         std::ranges::adjacent_find(starts, std::ranges::greater_equal()) == starts.end();
}

std::vector<std::uint32_t> indices_in_list(const std::vector<std::uint32_t>& starts,
                                           const std::vector<HalfedgeId>& values, std::size_t n) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = starts[n]; i < starts[n + 1]; ++i) result.push_back(values[i].index());
  return result;
}

}  // namespace

/// Derives from the origins alone what all else must be, and compares.
template <typename Layout>
struct MeshAuditor {
  using Mesh = HalfedgeMesh<Layout>;
  using Indices = std::vector<std::uint32_t>;

  const Mesh& mesh;
  std::vector<std::string> violations;
  std::vector<Indices> nonmanifold_edges;  // in order of first half-edge
  Indices opposites;                       // as they must be stored
  std::vector<Indices> fans;               // first half-edges, per vertex

  void run() {
    if (!check_sizes() || !check_origins()) return;
    derive_opposites();
    derive_fans();
    for (std::uint32_t h = 0; h < opposites.size(); ++h) check_opposite(h);
    for (std::uint32_t v = 0; v < fans.size(); ++v) check_outgoing(v);
    check_tables();
  }

 private:
  template <typename... Args>
  void report(fmt::format_string<Args...> format, Args&&... args) {
    violations.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  std::uint32_t next(std::uint32_t h) const { return mesh.next(HalfedgeId(h)).index(); }
  std::uint32_t origin(std::uint32_t h) const { return mesh.origins_[h]; }
  std::uint32_t target(std::uint32_t h) const { return mesh.origins_[next(h)]; }
  static bool has_opposite(std::uint32_t stored) { return (stored & Mesh::kNoOpposite) == 0; }

  bool check_sizes();
  bool check_origins();
  void derive_opposites();
  void derive_edge(const Indices& along);
  void derive_fans();
  static std::string state(std::uint32_t stored);
  void check_opposite(std::uint32_t h);
  void check_outgoing(std::uint32_t v);
  void check_tables();
  void check_edge_table(const NonManifoldTables& tables);
  void check_vertex_table(const NonManifoldTables& tables);
};

template <typename Layout>
bool MeshAuditor<Layout>::check_sizes() {
  const std::size_t before = violations.size();
  const std::size_t halfedge_count = mesh.origins_.size();
  for (std::string& violation : layout_violations(static_cast<const Layout&>(mesh), halfedge_count))
    violations.push_back(std::move(violation));
  if (halfedge_count > Mesh::kMaxHalfedges)
    report("{} half-edges, expected {} at most", halfedge_count, Mesh::kMaxHalfedges);
  if (mesh.opposites_.size() != halfedge_count)
    report("{} opposites, expected one per half-edge ({})", mesh.opposites_.size(), halfedge_count);
  if (mesh.outgoing_.size() != mesh.points_.size())
    report("{} outgoing half-edges, expected one per vertex ({})", mesh.outgoing_.size(), mesh.points_.size());
  return violations.size() == before;
}

template <typename Layout>
bool MeshAuditor<Layout>::check_origins() {
  const std::size_t before = violations.size();
  for (std::uint32_t h = 0; h < mesh.origins_.size(); ++h)
    if (origin(h) >= mesh.points_.size()) report("half-edge {}: origin {} is not a vertex", h, origin(h));
  return violations.size() == before;
}

template <typename Layout>
void MeshAuditor<Layout>::derive_opposites() {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> keyed;
  for (std::uint32_t h = 0; h < mesh.origins_.size(); ++h) keyed.emplace_back(std::minmax({origin(h), target(h)}), h);
  std::ranges::sort(keyed);
  opposites.assign(mesh.origins_.size(), Mesh::kBoundary);
  for (std::size_t i = 0; i < keyed.size();) {
    Indices along;
    for (const auto edge = keyed[i].first; i < keyed.size() && keyed[i].first == edge; ++i)
      along.push_back(keyed[i].second);
    derive_edge(along);
  }
  std::ranges::sort(nonmanifold_edges);
  for (std::uint32_t n = 0; n < nonmanifold_edges.size(); ++n)
    for (const std::uint32_t h : nonmanifold_edges[n]) opposites[h] = Mesh::kNoOpposite | n;
}

template <typename Layout>
void MeshAuditor<Layout>::derive_edge(const Indices& along) {
  const bool is_loop = origin(along[0]) == target(along[0]);
  if (along.size() == 1 && !is_loop) return;
  if (along.size() == 2 && origin(along[0]) == target(along[1]) && !is_loop) {
    opposites[along[0]] = along[1];
    opposites[along[1]] = along[0];
  } else {
    nonmanifold_edges.push_back(along);
  }
}

/// The corners at a vertex that are linked across manifold edges are a fan. It starts at the half-edge without opposite
/// if it is open, else at the lowest.
template <typename Layout>
void MeshAuditor<Layout>::derive_fans() {
  HalfedgeSets corners(opposites.size());
  for (std::uint32_t h = 0; h < opposites.size(); ++h)
    if (has_opposite(opposites[h])) corners.unite(h, next(opposites[h]));
  Indices starts(opposites.size());
  std::iota(starts.begin(), starts.end(), 0U);
  for (std::uint32_t h = 0; h < opposites.size(); ++h)
    if (!has_opposite(opposites[h])) starts[corners.find(h)] = h;
  fans.resize(mesh.points_.size());
  for (std::uint32_t h = 0; h < opposites.size(); ++h)
    if (corners.find(h) == h) fans[origin(h)].push_back(starts[h]);
  for (Indices& of_vertex : fans) std::ranges::sort(of_vertex);
}

template <typename Layout>
std::string MeshAuditor<Layout>::state(std::uint32_t stored) {
  if (stored == Mesh::kBoundary) return "boundary";
  if (has_opposite(stored)) return fmt::format("opposite {}", stored);
  return fmt::format("non-manifold edge {}", stored & ~Mesh::kNoOpposite);
}

template <typename Layout>
void MeshAuditor<Layout>::check_opposite(std::uint32_t h) {
  const std::uint32_t stored = mesh.opposites_[h];
  if (stored != opposites[h]) report("half-edge {}: {}, its edge demands {}", h, state(stored), state(opposites[h]));
  if (!has_opposite(stored)) return;
  if (stored >= opposites.size()) return report("half-edge {}: opposite {} is not a half-edge", h, stored);
  if (mesh.opposites_[stored] != h)
    report("half-edge {}: its opposite {} has {}", h, stored, state(mesh.opposites_[stored]));
  if (origin(h) != target(stored) || target(h) != origin(stored))
    report("half-edge {} from {} to {}: its opposite {} runs from {} to {}", h, origin(h), target(h), stored,
           origin(stored), target(stored));
}

template <typename Layout>
void MeshAuditor<Layout>::check_outgoing(std::uint32_t v) {
  const HalfedgeId stored = mesh.outgoing_[v];
  if (!stored.is_valid()) {
    if (!fans[v].empty()) report("vertex {}: no outgoing half-edge, but faces", v);
  } else if (stored.index() >= opposites.size()) {
    report("vertex {}: outgoing half-edge {} is not a half-edge", v, stored.index());
  } else if (origin(stored.index()) != v) {
    report("vertex {}: outgoing half-edge {} leaves vertex {}", v, stored.index(), origin(stored.index()));
  } else if (stored.index() != fans[v].front()) {
    report("vertex {}: outgoing half-edge {} is not the start of its first fan, {}", v, stored.index(),
           fans[v].front());
  }
}

template <typename Layout>
void MeshAuditor<Layout>::check_tables() {
  const bool is_needed =
      !nonmanifold_edges.empty() || std::ranges::any_of(fans, [](const Indices& starts) { return starts.size() > 1; });
  if (mesh.nonmanifold_ == nullptr) {
    if (is_needed) report("no side tables, but non-manifold edges or vertices");
    return;
  }
  if (!is_needed) report("side tables, but nothing is non-manifold");
  check_edge_table(*mesh.nonmanifold_);
  check_vertex_table(*mesh.nonmanifold_);
}

template <typename Layout>
void MeshAuditor<Layout>::check_edge_table(const NonManifoldTables& tables) {
  if (!are_list_starts(tables.edge_starts, tables.edge_halfedges.size()))
    return report("table of non-manifold edges: its {} starts do not divide {} half-edges", tables.edge_starts.size(),
                  tables.edge_halfedges.size());
  const std::size_t listed_count = tables.edge_starts.size() - 1;
  if (listed_count != nonmanifold_edges.size())
    report("table of non-manifold edges: {} listed, {} counted", listed_count, nonmanifold_edges.size());
  for (std::size_t n = 0; n < std::min(listed_count, nonmanifold_edges.size()); ++n) {
    const Indices listed = indices_in_list(tables.edge_starts, tables.edge_halfedges, n);
    if (listed != nonmanifold_edges[n])
      report("non-manifold edge {}: half-edges {} listed, {} counted", n, indices(listed),
             indices(nonmanifold_edges[n]));
  }
}

template <typename Layout>
void MeshAuditor<Layout>::check_vertex_table(const NonManifoldTables& tables) {
  if (tables.fan_starts.size() != tables.vertices.size() + 1 || !are_list_starts(tables.fan_starts, tables.fans.size()))
    return report("table of non-manifold vertices: its {} starts do not divide {} fans among {} vertices",
                  tables.fan_starts.size(), tables.fans.size(), tables.vertices.size());
  if (std::ranges::adjacent_find(tables.vertices, std::ranges::greater_equal()) != tables.vertices.end())
    report("table of non-manifold vertices: not ascending");
  std::vector<bool> is_listed(fans.size(), false);
  for (std::size_t n = 0; n < tables.vertices.size(); ++n) {
    const std::uint32_t v = tables.vertices[n];
    if (v >= fans.size()) {
      report("table of non-manifold vertices: {} is not a vertex", v);
      continue;
    }
    is_listed[v] = true;
    const Indices listed = indices_in_list(tables.fan_starts, tables.fans, n);
    if (fans[v].size() < 2) report("vertex {}: listed as non-manifold, but has {} fans", v, fans[v].size());
    if (listed != fans[v]) report("vertex {}: fans {} listed, {} counted", v, indices(listed), indices(fans[v]));
  }
  for (std::uint32_t v = 0; v < fans.size(); ++v)
    if (fans[v].size() > 1 && !is_listed[v])
      report("vertex {}: {} fans, but not in the table of non-manifold vertices", v, fans[v].size());
}

namespace {

template <typename Layout>
std::vector<std::string> audit_links(const HalfedgeMesh<Layout>& mesh) {
  MeshAuditor<Layout> auditor{mesh, {}, {}, {}, {}};
  auditor.run();
  return std::move(auditor.violations);
}

}  // namespace

std::vector<std::string> audit(const TriangleMesh& mesh) {
  std::vector<std::string> violations = audit_links(mesh);
  if (!violations.empty()) return violations;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const IntegerPlane* plane = mesh.planes().find(f);
    if (plane != nullptr && !(*plane == IntegerPlane::through(mesh.corners(FaceId(f)))))
      violations.push_back(fmt::format("face {}: the plane that is known is not that of its corners", f));
  }
  return violations;
}

std::vector<std::string> audit(const PolygonMesh& mesh) {
  return audit_links(mesh);
}

}  // namespace algebra3d
