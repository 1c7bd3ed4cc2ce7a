#include "algebra3d/operators/import_solid.h"

#include <utility>

#include "algebra3d/repair/solid_from_soup.h"
#include "stl/stl_reader.h"

namespace algebra3d {
namespace {

/// What is the file's fault is an outcome; what is the statement's stays an error.
Result<ImportedSolid> refused_or_failed(Error error) {
  if (error.code == ErrorCode::interrupted || error.code == ErrorCode::out_of_memory) return error;
  return ImportedSolid{.solid = std::nullopt, .status = std::move(error.message), .remarks = {}};
}

}  // namespace

Result<ImportedSolid> import_solid(const std::filesystem::path& path, const RepairOptions& options,
                                   const Monitor& monitor) {
  auto read = stl::read_stl_file(path, monitor.cancel());
  if (!read.ok()) return refused_or_failed(std::move(read).error());
  auto made = solid_from_soup(read->soup, options, monitor);
  if (!made.ok()) return refused_or_failed(std::move(made).error());
  ImportedSolid result;
  result.status = made->status();
  result.remarks = std::move(read->remarks);
  for (std::string& remark : made->report.remarks()) result.remarks.push_back(std::move(remark));
  if (made->mesh && made->repair) result.remarks.push_back(result.status);
  if (made->mesh) result.solid = Volume3d::trusted(*std::move(made->mesh));
  return result;
}

}  // namespace algebra3d
