// mesh_operators [FILE...]: imports mesh files that are solids and applies the operators of meshes to them, by name.
// Without files, takes them from standard input, one in each line.
//
// For each result one line of fields with tabs between: file, operation, number of faces, Euler's characteristic, sum
// of the genera, and `ok` or what is wrong: a violated invariant, a boundary, no manifold, not oriented, attributes
// lost. Edits are random, the same in each run, and each works on the result of those before; only the last one has a
// line, with the number of edits that were refused behind `ok`, and so has each one after which something is wrong.
#include <cstdio>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/types/mesh3d.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"

namespace {

using namespace algebra3d;

Value number(std::size_t n) {
  return Value::of<std::int64_t>(static_cast<std::int64_t>(n));
}
Value name(const char* text) {
  return Value::of<std::string>(text);
}

/// The result of an operator; undefined values are results, too.
Value call(const std::string& operator_name, const std::vector<Value>& arguments) {
  static const Registry registry = make_registry();
  std::vector<TypeExpr> types;
  types.reserve(arguments.size());
  for (const Value& argument : arguments) types.emplace_back(argument.type().name());
  const auto resolved = registry.resolve(*registry.find_operator(operator_name), types);
  if (!resolved) throw std::runtime_error(resolved.error().message);
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = {}};
  std::vector<Value> values = arguments;
  auto result = Registry::call(*resolved, values, context);
  if (!result) throw std::runtime_error(result.error().message);
  return *std::move(result);
}

template <typename Mesh>
std::string violation(const Mesh& mesh) {
  if (const auto found = audit(mesh); !found.empty()) return found.front();
  if (!is_closed(mesh)) return "has a boundary";
  if (!is_manifold(mesh)) return "is not a manifold";
  if (!is_consistently_oriented(mesh)) return "is not oriented";
  return "ok";
}

class Operations {
 public:
  Operations(std::string file, Volume3d solid) : file_(std::move(file)), solid_(std::move(solid)) {}

  void run() {
    const Value solid = Value::of(solid_);
    const Value triangles = with_attributes(call("volume2mesh", {solid}));
    const Value polygons = with_attributes(call("volume2mesh", {solid, Value::of<bool>(true)}));
    conversions(solid, triangles, polygons);
    subdivisions(solid, triangles, polygons);
    simplifications(solid, triangles);
    // Two polygons may share two edges, which would be one edge of the dual.
    show("dual", call("dual", {triangles}));
    for (const Value& mesh : {triangles, polygons}) edits(mesh);
  }

 private:
  template <typename Mesh>
  void show(const std::string& operation, const Mesh& mesh, const std::string& verdict) const {
    const auto handles = genus(mesh);
    std::printf("%s\t%s\t%zu\t%lld\t%lld\t%s\n", file_.c_str(), operation.c_str(), mesh.face_count(),
                static_cast<long long>(euler_characteristic(mesh)), handles ? static_cast<long long>(*handles) : -1,
                verdict.c_str());
    std::fflush(stdout);
  }
  void show(const std::string& operation, const Value& value, bool has_attributes = false) const {
    if (!value.is_defined()) {
      std::printf("%s\t%s\t0\t0\t0\tundefined\n", file_.c_str(), operation.c_str());
      return;
    }
    if (&value.type() == &TypeOf<Volume3d>::type())
      return show(operation, value.get<Volume3d>().mesh(), violation(value.get<Volume3d>().mesh()));
    if (&value.type() == &TypeOf<Surface3d>::type())
      return show(operation, value.get<Surface3d>().mesh(), violation(value.get<Surface3d>().mesh()));
    show(operation, value.get<Mesh3d>().mesh(), verdict_of(value.get<Mesh3d>(), has_attributes));
  }
  static std::string verdict_of(const Mesh3d& mesh, bool has_attributes) {
    if (!mesh.attributes().fits(mesh.mesh())) return "attributes do not fit";
    if (mesh.attributes().all().size() != (has_attributes ? 4U : 0U)) return "attributes lost";
    return violation(mesh.mesh());
  }

  static Value with_attributes(Value mesh) {
    for (const char* elements : {"vertex", "edge", "halfedge", "face"})
      mesh = call("withAttribute", {mesh, name(elements), name("Weight"), Value::of<double>(1.5)});
    return mesh;
  }

  void conversions(const Value& solid, const Value& triangles, const Value& polygons) const {
    show("volume2mesh", triangles, true);
    show("volume2mesh, merged", polygons, true);
    show("mesh2surface", call("mesh2surface", {triangles}));
    show("triangulate", call("triangulate", {polygons}), true);
    for (const Value& mesh : {triangles, polygons}) {
      const Value back = call("mesh2volume", {mesh});
      show("mesh2volume", back);
      if (!back.is_defined() || std::is_neq(back.type().compare(back, solid)))
        std::printf("%s\tmesh2volume\t0\t0\t0\tis another solid\n", file_.c_str());
    }
  }

  void subdivisions(const Value& solid, const Value& triangles, const Value& polygons) const {
    for (const char* scheme : {"catmull-clark", "doo-sabin", "loop", "butterfly", "modified-butterfly"}) {
      show(scheme, call("subdivide", {solid, name(scheme), number(1)}));
      show(scheme, call("subdivide", {triangles, name(scheme), number(1)}), true);
    }
    for (const char* scheme : {"catmull-clark", "doo-sabin"})
      show(std::string(scheme) + ", polygons", call("subdivide", {polygons, name(scheme), number(1)}), true);
    for (const char* scheme : {"catmull-clark", "loop"})
      show("limitPosition", call("limitPosition", {triangles, name(scheme)}), true);
  }

  void simplifications(const Value& solid, const Value& triangles) const {
    const Value ratio = name("ratio"), share = Value::of<double>(0.2), crease = Value::of<double>(30);
    show("simplify solid", call("simplify", {solid, ratio, share}));
    show("simplify solid, creases", call("simplify", {solid, ratio, share, crease}));
    show("simplify mesh", call("simplify", {triangles, ratio, share}), true);
    show("simplify mesh, creases", call("simplify", {triangles, ratio, share, crease}), true);
  }

  void edits(Value mesh) const {
    std::mt19937 random(19);
    const std::size_t rounds = mesh.get<Mesh3d>().mesh().face_count() < 4000 ? 12 : 3;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < 6 * rounds; ++i) {
      const Value edited = edit(mesh, i % 6, random);
      refused += edited.is_defined() ? 0 : 1;
      if (!edited.is_defined()) continue;
      mesh = edited;
      if (const std::string verdict = verdict_of(mesh.get<Mesh3d>(), true); verdict != "ok")
        show("edit " + std::to_string(i), mesh, true);
    }
    show("edits", mesh.get<Mesh3d>().mesh(),
         verdict_of(mesh.get<Mesh3d>(), true) + ", " + std::to_string(refused) + " of " + std::to_string(6 * rounds) +
             " refused");
  }

  static Value edit(const Value& value, std::size_t kind, std::mt19937& random) {
    const PolygonMesh& mesh = value.get<Mesh3d>().mesh();
    const Value edge = number(random() % edge_count(mesh));
    const FaceId f(random() % mesh.face_count());
    const VertexId v(random() % mesh.vertex_count());
    const Value point = Value::of<Point3d>({ExactPoint(mesh.point(v))});
    switch (kind) {
      case 0:
        return call("flipEdge", {value, edge});
      case 1:
        return call("splitEdge", {value, edge, Value::of<double>(0.375)});
      case 2:
        return call("collapseEdge", {value, edge});
      case 3: {
        const HalfedgeId h = mesh.halfedge(f, static_cast<std::uint32_t>(random() % mesh.degree(f)));
        return call("splitFace", {value, number(f.index()), number(mesh.origin(h).index()),
                                  number(mesh.target(mesh.next(h)).index())});
      }
      case 4: {
        const HalfedgeId out = mesh.outgoing(v), other = mesh.opposite(mesh.prev(out));
        return call("splitVertex", {value, number(v.index()), number(mesh.target(out).index()),
                                    number(mesh.target(other).index()), point});
      }
      default:
        return call("moveVertex", {value, number(v.index()), point});
    }
  }

  std::string file_;
  Volume3d solid_;
};

void examine(const std::string& path) {
  try {
    const auto imported = import_solid(path);
    if (!imported) throw std::runtime_error(imported.error().message);
    if (!imported->solid) throw std::runtime_error("is not a solid");
    Operations(path, *imported->solid).run();
  } catch (const std::runtime_error& error) {
    std::printf("%s\tfailed\t0\t0\t0\t%s\n", path.c_str(), error.what());
  }
}

}  // namespace

int main(int count, char** arguments) {
  for (int i = 1; i < count; ++i) examine(arguments[i]);
  if (count > 1) return 0;
  for (std::string path; std::getline(std::cin, path);) examine(path);
  return 0;
}
