#include <cmath>
#include <span>

#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"
#include "base/propagate.h"

namespace algebra3d::c_interface {
namespace {

// Points are given to C code as they lie in memory.
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// What C code gives for a mesh.
struct GivenMesh {
  const double* coordinates;
  std::size_t point_count;
  std::span<const std::uint32_t> corners;
  const std::uint32_t* degrees;  // null: three corners each
  std::size_t face_count;
};

Result<std::vector<Vec3>> points_of(const GivenMesh& given) {
  std::vector<Vec3> points(given.point_count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    poll_interruption_at(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double coordinate = given.coordinates[3 * i + axis];
      if (!std::isfinite(coordinate))
        return Error{ErrorCode::invalid_value, "point {}: {} is {}, expected a finite number", i, "xyz"[axis],
                     coordinate};
      points[i][axis] = coordinate;
    }
  }
  return points;
}

Status check_corners(const GivenMesh& given) {
  if (given.corners.size() > PolygonMesh::kMaxHalfedges)
    return Error{ErrorCode::limit_exceeded, "{} corners of faces; a mesh may have {}", given.corners.size(),
                 PolygonMesh::kMaxHalfedges};
  for (std::size_t i = 0; i < given.corners.size(); ++i) {
    poll_interruption_at(i);
    if (given.corners[i] >= given.point_count)
      return Error{ErrorCode::invalid_value, "corner {}: there is no point {}, expected a number below {}", i,
                   given.corners[i], given.point_count};
  }
  return {};
}

Result<PolygonLayout> layout_of(const GivenMesh& given) {
  if (given.degrees == nullptr) {
    if (given.corners.size() != 3 * given.face_count)
      return Error{ErrorCode::invalid_value, "{} corners, expected {} for {} triangles", given.corners.size(),
                   3 * given.face_count, given.face_count};
    return PolygonLayout::of_degree(3);
  }
  LargeVector<std::uint32_t> starts{0};
  starts.reserve(given.face_count + 1);
  std::size_t end = 0;
  for (std::size_t face = 0; face < given.face_count; ++face) {
    poll_interruption_at(face);
    if (given.degrees[face] < 3)
      return Error{ErrorCode::invalid_value, "face {} has {} corners, expected at least 3", face, given.degrees[face]};
    end += given.degrees[face];
    if (end > given.corners.size()) break;
    starts.push_back(static_cast<std::uint32_t>(end));
  }
  if (end != given.corners.size() || starts.size() != given.face_count + 1)
    return Error{ErrorCode::invalid_value, "the faces have {}{} corners by their degrees, and {} are given",
                 end > given.corners.size() ? "at least " : "", end, given.corners.size()};
  return PolygonLayout(std::move(starts));
}

Result<Value> mesh_of(const GivenMesh& given) {
  A3D_ASSIGN(std::vector<Vec3> points, points_of(given));
  A3D_TRY(check_corners(given));
  A3D_ASSIGN(PolygonLayout layout, layout_of(given));
  return Value::of(Mesh3d(
      PolygonMesh(PointArray(std::move(points)), std::move(layout), {given.corners.begin(), given.corners.end()})));
}

/// What an a3d_mesh shows.
struct ShownMesh {
  Value value;
  std::vector<std::uint32_t> degrees;
};

std::vector<std::uint32_t> degrees_of(const PolygonMesh& mesh) {
  std::vector<std::uint32_t> degrees;
  if (mesh.is_empty() || mesh.common_degree() == 3) return degrees;
  degrees.reserve(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    poll_interruption_at(f);
    degrees.push_back(mesh.degree(FaceId(f)));
  }
  return degrees;
}

template <typename Mesh>
void show(const Mesh& mesh, a3d_mesh* result) {
  const PointArray& points = mesh.points();
  result->coordinates = points.approx().empty() ? nullptr : &points.approx().front().x;
  result->point_count = points.size();
  result->corners = mesh.origins().data();
  result->corner_count = mesh.origins().size();
  result->face_count = mesh.face_count();
  result->is_exact = points.exact_count() == 0 ? 1 : 0;
}

/// Errors: type_error.
Result<a3d_mesh> shown(const Value& value) {
  a3d_mesh result = {};
  const Type& type = value.type();
  std::vector<std::uint32_t> degrees;
  if (value.is_defined() && &type == &TypeOf<Mesh3d>::type()) {
    degrees = degrees_of(value.get<Mesh3d>().mesh());
    show(value.get<Mesh3d>().mesh(), &result);
  } else if (value.is_defined() && &type == &TypeOf<Volume3d>::type()) {
    show(value.get<Volume3d>().mesh(), &result);
  } else if (value.is_defined() && &type == &TypeOf<Surface3d>::type()) {
    show(value.get<Surface3d>().mesh(), &result);
  } else {
    return Error{ErrorCode::type_error, "expected a defined mesh3d, surface3d or volume3d, got {}{}",
                 value.is_defined() ? "a value of type " : "an undefined ", type.name()};
  }
  auto owner = std::make_unique<ShownMesh>(ShownMesh{value, std::move(degrees)});
  result.degrees = owner->degrees.empty() ? nullptr : owner->degrees.data();
  result.owner = owner.release();
  return result;
}

}  // namespace
}  // namespace algebra3d::c_interface

a3d_status a3d_make_mesh(a3d_session* session, const double* coordinates, size_t point_count, const uint32_t* corners,
                         size_t corner_count, const uint32_t* degrees, size_t face_count, a3d_value** result) {
  return algebra3d::c_interface::made(session, result, [&](algebra3d::Context&) {
    return algebra3d::c_interface::mesh_of(
        {coordinates, point_count, std::span(corners, corner_count), degrees, face_count});
  });
}

a3d_status a3d_mesh_of(a3d_session* session, const a3d_value* value, a3d_mesh* result) {
  return algebra3d::c_interface::done(
      session, [&](algebra3d::Context&) { return algebra3d::c_interface::shown(value->content); },
      [&](const a3d_mesh& mesh) { *result = mesh; });
}

void a3d_release_mesh(a3d_mesh* mesh) {
  delete static_cast<algebra3d::c_interface::ShownMesh*>(mesh->owner);
  *mesh = {};
}
