#include "algebra3d/operators/import_solid.h"

#include <utility>

#include "algebra3d/repair/solid_from_soup.h"
#include "stl/stl_reader.h"

namespace algebra3d {
namespace {

/// The file's fault, or that of the statement?
bool is_of_file(const Error& error) {
  return error.code != ErrorCode::interrupted && error.code != ErrorCode::out_of_memory;
}

ImportedSolid refused(std::string reason) {
  return {.solid = std::nullopt, .status = std::move(reason), .remarks = {}};
}

}  // namespace

Result<ImportedSolid> import_solid(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  auto read = stl::read_stl_file(path, cancel);
  if (!read) {
    if (!is_of_file(read.error())) return std::move(read).error();
    return refused(read.error().message);
  }
  auto made = solid_from_soup(read->soup, cancel);
  if (!made) {
    if (!is_of_file(made.error())) return std::move(made).error();
    return refused(made.error().message);
  }
  ImportedSolid result;
  result.remarks = std::move(read->remarks);
  for (std::string& remark : made->report.remarks()) result.remarks.push_back(std::move(remark));
  if (!made->mesh) {
    result.status = made->report.defects();
    return result;
  }
  result.status = made->report.was_turned ? "ok: turned right side out" : "ok";
  result.solid = Volume3d::trusted(*std::move(made->mesh));
  return result;
}

}  // namespace algebra3d
