#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/conversions/mesh_file.h"
#include "base/file_content.h"

namespace queries {

/// The bytes of a mesh file named on the command line; `-` is standard input.
class MeshInput {
 public:
  /// Errors: those of InputFile, refuse_unwritten and FileContent; io_error for standard input.
  static algebra3d::Result<MeshInput> open(const std::string& name, const std::atomic<bool>* cancel);

  [[nodiscard]] std::string_view bytes() const { return content_ ? content_->bytes() : std::string_view(text_); }
  /// The name for messages: "standard input" for `-`.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::optional<algebra3d::FileContent> content_;
  std::string text_;  // of standard input
};

/// The triangles of a mesh file named on the command line. Errors: those of MeshInput::open and read_mesh.
algebra3d::Result<algebra3d::MeshFile> read_mesh_input(const std::string& name, const std::atomic<bool>* cancel);

/// The files of an argument: the mesh files below a folder, the matches of a pattern, or the argument itself. Errors:
/// those of list_files.
algebra3d::Result<std::vector<std::string>> mesh_files_of(const std::string& argument);

}  // namespace queries
