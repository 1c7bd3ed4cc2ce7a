// Surfaces in their stored form beside Draco without quantization: sizes, and times to encode and to decode. All
// coordinates are floats, and meshes have the order that import gives them. Ours decodes to a linked mesh, checks a
// checksum and keeps the order of triangles and points; Draco decodes to triangles over points, and edgebreaker changes
// their order. The argument is the speed setting of Draco, from 0 (smallest) to 10. Models: see models.h.
#include <benchmark/benchmark.h>

#ifdef BENCH_WITH_DRACO
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#endif

#include <memory>
#include <string>
#include <vector>

#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/spatial.h"
#include "base/scheduler.h"
#include "models.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::Surface3d;
using algebra3d::Value;

constexpr std::uint32_t kSphere = 224;  // 1,003,520 triangles

/// The sphere, or a model, in floats and in the order of import.
TriangleMesh mesh_for(std::size_t shape_index) {
  Shape shape = shape_index == 0 ? sphere(kSphere) : models()[shape_index - 1];
  for (Vec3& p : shape.points)
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(p[axis]);
  return algebra3d::in_spatial_order(mesh_of(shape));
}

void set_counters(benchmark::State& state, std::size_t bytes, std::size_t triangles) {
  const auto count = static_cast<double>(triangles);
  state.counters["bytes_per_triangle"] = static_cast<double>(bytes) / count;
  state.counters["triangles_per_second"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
}

void encode_ours(benchmark::State& state, std::size_t shape) {
  const Value value = Value::of(Surface3d::trusted(mesh_for(shape)));
  std::size_t bytes = 0;
  for (auto step : state) bytes = encode(value).size();
  set_counters(state, bytes, value.get<Surface3d>().mesh().face_count());
}

void decode_ours(benchmark::State& state, std::size_t shape) {
  const Value value = Value::of(Surface3d::trusted(mesh_for(shape)));
  const std::string bytes = encode(value);
  for (auto step : state) {
    auto decoded = decode(value.type(), bytes, algebra3d::Origin::own_store);
    if (!decoded.ok()) state.SkipWithError("not decoded");
    state.PauseTiming();
    decoded = Value(value.type());
    state.ResumeTiming();
  }
  set_counters(state, bytes.size(), value.get<Surface3d>().mesh().face_count());
}

#ifdef BENCH_WITH_DRACO
std::unique_ptr<draco::Mesh> draco_mesh_of(const TriangleMesh& mesh) {
  auto made = std::make_unique<draco::Mesh>();
  draco::Mesh& result = *made;
  const auto point_count = static_cast<std::uint32_t>(mesh.vertex_count());
  result.set_num_points(point_count);
  result.SetNumFaces(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    draco::Mesh::Face face;
    for (std::size_t i = 0; i < 3; ++i) face[i] = draco::PointIndex(mesh.triangle(algebra3d::FaceId(f))[i]);
    result.SetFace(draco::FaceIndex(f), face);
  }
  draco::GeometryAttribute position;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 3 * sizeof(float), 0);
  const int id = result.AddAttribute(position, true, point_count);
  for (std::uint32_t v = 0; v < point_count; ++v) {
    const Vec3 p = mesh.point(algebra3d::VertexId(v)).approx;
    const std::array<float, 3> floats{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    result.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), floats.data());
  }
  return made;
}

bool encode_draco(const draco::Mesh& mesh, int method, int speed, draco::EncoderBuffer& buffer) {
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetSpeedOptions(speed, speed);
  buffer.Clear();
  return encoder.EncodeMeshToBuffer(mesh, &buffer).ok();
}

void encode_draco(benchmark::State& state, std::size_t shape, int method) {
  const auto mesh = draco_mesh_of(mesh_for(shape));
  draco::EncoderBuffer buffer;
  for (auto step : state)
    if (!encode_draco(*mesh, method, static_cast<int>(state.range(0)), buffer)) state.SkipWithError("not encoded");
  set_counters(state, buffer.size(), mesh->num_faces());
}

void decode_draco(benchmark::State& state, std::size_t shape, int method) {
  const auto mesh = draco_mesh_of(mesh_for(shape));
  draco::EncoderBuffer encoded;
  encode_draco(*mesh, method, static_cast<int>(state.range(0)), encoded);
  for (auto step : state) {
    draco::DecoderBuffer buffer;
    buffer.Init(encoded.data(), encoded.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) state.SkipWithError("not decoded");
    state.PauseTiming();
    std::move(decoded).value().reset();
    state.ResumeTiming();
  }
  set_counters(state, encoded.size(), mesh->num_faces());
}
#endif

template <typename Run>
auto* add(const std::string& name, const Run& run) {
  return benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void add_shape(std::size_t shape, const std::string& name) {
  using State = benchmark::State;
  add("encode/" + name + "/ours", [=](State& state) { encode_ours(state, shape); });
  add("decode/" + name + "/ours", [=](State& state) { decode_ours(state, shape); });
  add("decode/" + name + "/ours_one_thread",
      [=](State& state) { algebra3d::with_threads(1, [&] { decode_ours(state, shape); }); });
#ifdef BENCH_WITH_DRACO
  for (const auto& [method, method_name] :
       {std::pair(draco::MESH_SEQUENTIAL_ENCODING, "sequential"), {draco::MESH_EDGEBREAKER_ENCODING, "edgebreaker"}}) {
    const std::string peer = name + "/draco_" + method_name;
    add("encode/" + peer, [=](State& state) { encode_draco(state, shape, method); })->Arg(0)->Arg(5)->Arg(10);
    add("decode/" + peer, [=](State& state) { decode_draco(state, shape, method); })->Arg(0)->Arg(5)->Arg(10);
  }
#endif
}

}  // namespace

int main(int argc, char** argv) {
  add_shape(0, "sphere");
  for (std::size_t i = 0; i < models().size(); ++i) add_shape(i + 1, "model_" + std::to_string(i + 1));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
