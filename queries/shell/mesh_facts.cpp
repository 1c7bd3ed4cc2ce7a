// What `algebra3d part.stl` shows.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/kernel/repair/mesh_volume.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "algebra3d/kernel/search/boxes.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "base/propagate.h"
#include "queries/shell/detail/mesh_commands.h"
#include "queries/shell/detail/mesh_input.h"
#include "queries/shell/detail/screen.h"

namespace queries {
namespace {

using algebra3d::Box3;
using algebra3d::ImportedSolid;
using algebra3d::MeshFile;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;

/// The facts about a file before anything is made of it.
struct FileFacts {
  std::string form;  // "STL, binary, 684 bytes"
  std::size_t triangle_count = 0;
  Box3 box;
  algebra3d::Amount area;
};

double farthest_coordinate(const Box3& box) {
  double farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = std::max({farthest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return farthest;
}

algebra3d::Amount area_of(const TriangleSoup& soup, const algebra3d::BinaryScale& scale) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += algebra3d::area_of({scale.scaled(a), scale.scaled(b), scale.scaled(c)});
  return scale.area(sum);
}

FileFacts facts_of(const MeshFile& mesh, std::size_t byte_count) {
  FileFacts facts;
  facts.form = form_text({mesh.format, mesh.encoding});
  facts.form += fmt::format(", {} bytes", byte_count);
  facts.triangle_count = mesh.soup.triangles.size();
  for (const TriangleSoup::Triangle& triangle : mesh.soup.triangles)
    for (const Vec3& corner : triangle) facts.box.extend(corner);
  facts.area = area_of(mesh.soup, algebra3d::BinaryScale(facts.box.is_empty() ? 0 : farthest_coordinate(facts.box)));
  return facts;
}

std::string row(std::string_view label, const std::string& value) {
  return fmt::format("  {:<10} {}\n", label, printable(value));
}

std::string size_text(const Box3& box) {
  if (box.is_empty()) return "empty";
  const Vec3 size = box.max - box.min;
  return fmt::format("({:.10g} {:.10g} {:.10g}) to ({:.10g} {:.10g} {:.10g}); {:.6g} x {:.6g} x {:.6g}", box.min.x,
                     box.min.y, box.min.z, box.max.x, box.max.y, box.max.z, size.x, size.y, size.z);
}

std::string repair_text(const ImportedSolid& imported) {
  if (!imported.solid) {
    const std::size_t reason = imported.status.find("not repaired: ");
    return imported.status.substr(reason == std::string::npos ? 0 : reason);
  }
  return "would give a solid: " + (imported.repair ? imported.repair->text() : imported.status);
}

/// "a valid solid; turned right side out": the status "ok: turned right side out" in other words.
std::string validity_text(std::string_view status) {
  constexpr std::size_t kOk = std::string_view("ok").size();
  if (status.size() <= kOk + 2) return "a valid solid";
  return "a valid solid; " + std::string(status.substr(kOk + 2));
}

/// Volume and area of the solid, or the area of the triangles.
Result<std::string> measures(const ImportedSolid& imported, const FileFacts& facts, const MeshConsole& console) {
  if (!imported.solid) return row("area", facts.area.text(10) + ", of the triangles");
  const algebra3d::TriangleMesh& mesh = imported.solid->mesh();
  A3D_ASSIGN(const algebra3d::Amount volume, algebra3d::measured_volume(mesh, console.cancel));
  const algebra3d::Amount area = area_of(mesh, algebra3d::BinaryScale(largest_coordinate(mesh)));
  const std::string when = imported.repair ? " after the repair" : "";
  return row("volume", volume.text(10) + when) + row("area", area.text(10) + when);
}

Status show_mesh_file(const std::string& name, const MeshConsole& console) {
  A3D_ASSIGN(const MeshInput input, MeshInput::open(name, console.cancel));
  A3D_ASSIGN(MeshFile mesh, algebra3d::read_mesh(input.bytes(), input.name(), nullptr, console.cancel));
  const FileFacts facts = facts_of(mesh, input.bytes().size());
  const std::vector<std::string> remarks = mesh.remarks;
  console.out << printable_line(input.name()) << "\n"
              << row("format", facts.form) << row("triangles", std::to_string(facts.triangle_count))
              << row("box", size_text(facts.box)) << std::flush;
  A3D_ASSIGN(const ImportedSolid imported, algebra3d::import_solid(std::move(mesh), {}, console.cancel));
  const bool is_valid = imported.solid && !imported.repair;
  console.out << row("validity", is_valid ? validity_text(imported.status) : imported.found.defects());
  if (!is_valid) console.out << row("repair", repair_text(imported));
  A3D_ASSIGN(const std::string measured, measures(imported, facts, console));
  console.out << measured;
  for (const std::string& note : remarks) console.out << row("note", note);
  if (!is_valid && imported.solid && name != "-")
    console.out << row("", fmt::format("`algebra3d repair {} -o OUT.stl` writes that solid", shell_word(name)));
  return {};
}

}  // namespace

int show_mesh_files(std::span<const std::string> files, const MeshConsole& console) {
  constexpr int kInterruptedHere = 130;
  int worst = 0;
  for (const std::string& file : files) {
    const Status status = show_mesh_file(file, console);
    console.out.flush();
    if (status) continue;
    console.errors << "error: " << printable(status.error().text()) << "\n";
    if (status.error().code == algebra3d::ErrorCode::interrupted) return kInterruptedHere;
    worst = 1;
  }
  return worst;
}

}  // namespace queries
