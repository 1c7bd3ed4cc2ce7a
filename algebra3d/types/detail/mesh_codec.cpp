#include "algebra3d/types/detail/mesh_codec.h"

#include <array>
#include <optional>

#include "algebra3d/types/detail/codec_points.h"
#include "algebra3d/types/detail/corner_code.h"

// Triangles that come one after the other mostly share an edge, and points are mostly numbered in the order in which
// triangles first use them. So a triangle is coded by the place, in a short list of recent edges, of the edge that it
// shares, and by its third corner relative to the next unused point. The idea of a front of open edges is that of
// [gumhold1998]; there the coder chooses the order of triangles, here it is given, so that a list of recent edges takes
// the place of the front. Measured on the binary STL files of the corpus: 0.84 bytes per triangle after compression,
// where corners relative to the next unused point alone take 1.46.

namespace algebra3d {
namespace {

using Triangle = TriangleMesh::Triangle;

struct Edge {
  std::uint32_t from, to;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// The last edges that wait for a second triangle, in the direction in which that triangle has them. The latest edge is
/// at place 0.
class RecentEdges {
 public:
  static constexpr std::size_t kSize = 64;

  std::size_t size() const { return size_; }
  Edge at(std::size_t place) const { return edges_[(start_ + size_ - 1 - place) % kSize]; }

  std::optional<std::size_t> find(Edge edge) const {
    for (std::size_t place = 0; place < size_; ++place)
      if (at(place) == edge) return place;
    return std::nullopt;
  }

  void push(Edge edge) {
    edges_[(start_ + size_) % kSize] = edge;
    if (size_ < kSize)
      ++size_;
    else
      start_ = (start_ + 1) % kSize;
  }

  void erase(std::size_t place) {
    for (; place > 0; --place) edges_[(start_ + size_ - 1 - place) % kSize] = at(place - 1);
    --size_;
  }

 private:
  std::array<Edge, kSize> edges_{};
  std::size_t start_ = 0;
  std::size_t size_ = 0;
};

/// What encoder and decoder know of the triangles so far; both make the same steps.
class Front {
 public:
  static constexpr std::uint8_t kNoSharedEdge = 0;
  static constexpr std::uint8_t kMaxCode = RecentEdges::kSize * 3;

  const RecentEdges& edges() const { return edges_; }

  std::uint64_t encode(std::uint32_t point) { return corners_.encode(point); }
  std::uint64_t decode(std::uint64_t code) { return corners_.decode(code); }

  void add(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) edges_.push({t[(i + 1) % 3], t[i]});
  }
  /// The triangle is at the edge of that place, and its corner `first` is where this edge begins.
  void add(const Triangle& t, std::size_t place, std::size_t first) {
    edges_.erase(place);
    for (std::size_t i = first + 1; i < first + 3; ++i) edges_.push({t[(i + 1) % 3], t[i % 3]});
  }

 private:
  RecentEdges edges_;
  CornerCode corners_;
};

struct SharedEdge {
  std::size_t place, first;
};

/// The latest edge that a triangle shares.
std::optional<SharedEdge> find_shared_edge(const RecentEdges& edges, const Triangle& t) {
  for (std::size_t place = 0; place < edges.size(); ++place) {
    const Edge edge = edges.at(place);
    for (std::size_t first = 0; first < 3; ++first)
      if (edge.from == t[first] && edge.to == t[(first + 1) % 3]) return SharedEdge{place, first};
  }
  return std::nullopt;
}

bool read_corners(ByteReader& reader, std::span<const std::uint8_t> codes, std::size_t point_count,
                  std::vector<Triangle>& triangles) {
  std::size_t corner_count = 0;
  for (const std::uint8_t code : codes) corner_count += code == Front::kNoSharedEdge ? 3 : 1;
  const std::vector<std::uint64_t> corners = reader.planes(corner_count, 1, 5);
  if (!reader.ok()) return false;
  Front front;
  auto corner = corners.begin();
  bool within = true;
  const auto next_point = [&] {
    const std::uint64_t point = front.decode(*corner++);
    within = within && point < point_count;
    return static_cast<std::uint32_t>(point);
  };
  for (const std::uint8_t code : codes) {
    Triangle& t = triangles.emplace_back();
    if (code == Front::kNoSharedEdge) {
      for (std::uint32_t& point : t) point = next_point();
      front.add(t);
    } else {
      const std::size_t place = (code - 1U) / 3;
      const std::size_t first = (code - 1U) % 3;
      within = within && place < front.edges().size();
      if (!within) return false;
      const Edge edge = front.edges().at(place);
      t[first] = edge.from;
      t[(first + 1) % 3] = edge.to;
      t[(first + 2) % 3] = next_point();
      front.add(t, place, first);
    }
    if (!within) return false;
  }
  return true;
}

}  // namespace

void write_mesh(ByteWriter& writer, const TriangleMesh& mesh) {
  write_points(writer, mesh.points());
  writer.varint(mesh.face_count());
  std::vector<std::uint64_t> corners;
  corners.reserve(2 * mesh.face_count());
  Front front;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(FaceId(f));
    const auto shared = find_shared_edge(front.edges(), t);
    if (shared) {
      writer.u8(static_cast<std::uint8_t>(1 + 3 * shared->place + shared->first));
      corners.push_back(front.encode(t[(shared->first + 2) % 3]));
      front.add(t, shared->place, shared->first);
    } else {
      writer.u8(Front::kNoSharedEdge);
      for (const std::uint32_t point : t) corners.push_back(front.encode(point));
      front.add(t);
    }
  }
  writer.planes(corners, 1);
}

TriangleMesh read_mesh(ByteReader& reader) {
  PointArray points = read_points(reader);
  const std::size_t face_count = reader.count(2);  // a code and a corner at least
  reader.require(face_count <= TriangleMesh::kMaxFaces, "fewer triangles");
  std::vector<std::uint8_t> codes;
  codes.reserve(face_count);
  for (const char code : reader.raw(face_count)) codes.push_back(static_cast<std::uint8_t>(code));
  for (const std::uint8_t code : codes) reader.require(code <= Front::kMaxCode, "codes of triangles up to 192");
  if (!reader.ok()) return {};
  std::vector<Triangle> triangles;
  triangles.reserve(face_count);
  if (!read_corners(reader, codes, points.size(), triangles)) {
    reader.fail("corners and edges within the mesh");
    return {};
  }
  return {std::move(points), triangles};
}

}  // namespace algebra3d
