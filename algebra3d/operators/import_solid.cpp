#include "algebra3d/operators/import_solid.h"

#include <utility>

#include "algebra3d/repair/surface_from_soup.h"

namespace algebra3d {
namespace {

/// What is the file's fault is an outcome; what is the statement's stays an error.
bool is_fault_of_file(const Error& error) {
  return error.code != ErrorCode::interrupted && error.code != ErrorCode::out_of_memory;
}

Result<ImportedSolid> refused_or_failed(Error error) {
  if (!is_fault_of_file(error)) return error;
  ImportedSolid result;
  result.status = std::move(error.message);
  return result;
}

Result<ImportedSurface> refused_surface_or_failed(Error error) {
  if (!is_fault_of_file(error)) return error;
  ImportedSurface result;
  result.reason = std::move(error.message);
  return result;
}

}  // namespace

Result<ImportedSolid> import_solid(const std::filesystem::path& path, std::optional<stl::MeshFormat> format,
                                   const RepairOptions& options, const Monitor& monitor) {
  auto read = read_mesh_file(path, format, monitor.cancel());
  if (!read.ok()) return refused_or_failed(std::move(read).error());
  auto made = solid_from_soup(read->soup, options, monitor);
  if (!made.ok()) return refused_or_failed(std::move(made).error());
  ImportedSolid result;
  result.status = made->status();
  result.remarks = std::move(read->remarks);
  for (std::string& remark : made->report.remarks()) result.remarks.push_back(std::move(remark));
  if (made->mesh && made->repair) result.remarks.push_back(result.status);
  if (made->mesh) result.solid = Volume3d::trusted(*std::move(made->mesh));
  result.found = std::move(made->report);
  result.repair = std::move(made->repair);
  return result;
}

Result<ImportedSurface> import_surface(const std::filesystem::path& path, const Monitor& monitor) {
  auto read = read_mesh_file(path, std::nullopt, monitor.cancel());
  if (!read.ok()) return refused_surface_or_failed(std::move(read).error());
  auto made = surface_from_soup(read->soup, {}, monitor);
  if (!made.ok()) return refused_surface_or_failed(std::move(made).error());
  ImportedSurface result;
  result.remarks = std::move(read->remarks);
  if (!made->repair.is_empty()) result.remarks.push_back("repaired: " + made->repair.text());
  result.surface = Surface3d::trusted(std::move(made->mesh));
  return result;
}

}  // namespace algebra3d
