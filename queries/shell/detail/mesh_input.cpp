#include "queries/shell/detail/mesh_input.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "base/polled_input.h"
#include "base/propagate.h"
#include "mesh_formats/unwritten_file.h"
#include "queries/importer/file_list.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::MeshFile;
using algebra3d::Result;

namespace {

bool is_endless_device(int descriptor) {
  struct stat facts {};
  return ::fstat(descriptor, &facts) == 0 && S_ISCHR(facts.st_mode) && ::isatty(descriptor) == 0;
}

// The input may have any size up to the memory limit.
Result<std::string> standard_input(const std::atomic<bool>* cancel) {
  if (is_endless_device(STDIN_FILENO)) return Error{ErrorCode::file_missing, "is a device"}.about("standard input");
  algebra3d::PolledInput bytes(STDIN_FILENO, cancel);
  return bytes.read_all(std::string().max_size(), "standard input");
}

}  // namespace

Result<MeshInput> MeshInput::open(const std::string& name, const std::atomic<bool>* cancel) {
  MeshInput input;
  if (name == "-") {
    input.name_ = "standard input";
    A3D_ASSIGN(input.text_, standard_input(cancel));
    return input;
  }
  input.name_ = name;
  A3D_ASSIGN(const algebra3d::InputFile file, algebra3d::InputFile::open(name));
  A3D_TRY(mesh_formats::refuse_unwritten(file));
  A3D_ASSIGN(input.content_, algebra3d::FileContent::read(file, cancel));
  return input;
}

Result<MeshFile> read_mesh_input(const std::string& name, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const MeshInput input, MeshInput::open(name, cancel));
  return algebra3d::read_mesh(input.bytes(), input.name(), nullptr, cancel);
}

Result<std::vector<std::string>> mesh_files_of(const std::string& argument) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(argument, error);
  const bool is_pattern =
      !std::filesystem::exists(argument, error) && argument.find_first_of("*?[") != std::string::npos;
  if (argument == "-" || (!is_folder && !is_pattern)) return std::vector{argument};
  A3D_ASSIGN(const FileList list, list_files(std::vector{argument}));
  if (!list.unread_folders.empty()) return Error{ErrorCode::io_error, "{}", list.unread_folders.front()};
  std::vector<std::string> files;
  const bool is_absolute = std::filesystem::path(argument).is_absolute();
  for (const ListedFile& file : list.files)
    files.push_back(is_absolute ? file.path.string()
                                : file.path.lexically_proximate(std::filesystem::current_path()).string());
  return files;
}

}  // namespace queries
