#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/kernel/halfedge/given_arrays.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/spatial.h"
#include "base/interruption_scope.h"
#include "base/large_allocator.h"
#include "base/propagate.h"

namespace algebra3d::c_interface {
namespace {

// Points lie in memory as C code takes and gives them.
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// The arrays of a mesh, as C code gives them.
struct GivenMesh {
  std::vector<Vec3> points;
  std::span<const std::uint32_t> corners;
  const std::uint32_t* degrees;  ///< null: three corners each
  std::size_t face_count;
};

Result<PolygonLayout> layout_of_faces(const GivenMesh& given) {
  if (given.degrees != nullptr) return layout_of({given.degrees, given.face_count}, given.corners.size());
  if (given.corners.size() == 3 * given.face_count) return PolygonLayout::of_degree(3);
  return Error{ErrorCode::invalid_value, "{} corners, expected {} for {} triangles", given.corners.size(),
               3 * given.face_count, given.face_count};
}

Result<Value> mesh_of(GivenMesh given) {
  A3D_TRY(check_points(given.points));
  A3D_TRY(check_corners(given.points.size(), given.corners));
  A3D_ASSIGN(PolygonLayout layout, layout_of_faces(given));
  return Value::of(Mesh3d(PolygonMesh(PointArray(std::move(given.points)), std::move(layout),
                                      {given.corners.begin(), given.corners.end()})));
}

/// The owner of the arrays of an a3d_mesh.
struct ShownMesh : Held {
  ShownMesh(const a3d_session& session, Value its_value, std::vector<std::uint32_t> its_degrees)
      : Held(session), value(std::move(its_value)), degrees(std::move(its_degrees)) {}

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
Result<a3d_mesh> shown(const a3d_session& session, const Value& value) {
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
  auto owner = std::make_unique<ShownMesh>(session, value, std::move(degrees));
  result.degrees = owner->degrees.empty() ? nullptr : owner->degrees.data();
  result.owner = owner.release();
  return result;
}

}  // namespace

extern "C" {

a3d_status a3d_make_mesh(a3d_session* session, const double* coordinates, size_t point_count, const uint32_t* corners,
                         size_t corner_count, const uint32_t* degrees, size_t face_count, a3d_value** result) {
  return made(session, result, [&](Context&) {
    std::vector<Vec3> points(point_count);
    for (std::size_t i = 0; i < 3 * point_count; ++i) points[i / 3][i % 3] = coordinates[i];
    return mesh_of({std::move(points), std::span(corners, corner_count), degrees, face_count});
  });
}

a3d_status a3d_mesh_of(a3d_session* session, const a3d_value* value, a3d_mesh* result) {
  return done(
      session, [&](Context&) { return shown(*session, value->content); },
      [&](const a3d_mesh& mesh) { *result = mesh; });
}

void a3d_release_mesh(a3d_mesh* mesh) {
  give_up(static_cast<ShownMesh*>(mesh->owner));
  *mesh = {};
}

}  // extern "C"
}  // namespace algebra3d::c_interface
