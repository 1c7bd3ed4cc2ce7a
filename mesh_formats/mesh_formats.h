#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/error.h"
#include "mesh_formats/mesh_format.h"

namespace mesh_formats {

/// The table of formats, which it owns. Concurrent calls of const members are safe.
class MeshFormats {
 public:
  explicit MeshFormats(std::vector<MeshFormat> formats) : formats_(std::move(formats)) {}
  MeshFormats(const MeshFormats&) = delete;
  MeshFormats(MeshFormats&&) = delete;
  MeshFormats& operator=(const MeshFormats&) = delete;
  MeshFormats& operator=(MeshFormats&&) = delete;
  ~MeshFormats() = default;

  auto begin() const { return formats_.begin(); }
  auto end() const { return formats_.end(); }

  /// The format by name ("STL"); null if there is none.
  const MeshFormat* named(std::string_view name) const;

  /// The format by the ending of a file name; null if none.
  const MeshFormat* of_name(std::string_view file_name) const;

  /// The first format that is sure of the content, whatever the file name; null if none. `head` and `size` as in
  /// MeshFormat::detect.
  const MeshFormat* of_content(std::string_view head, std::size_t size) const;
  const MeshFormat* of_content(std::string_view bytes) const { return of_content(bytes, bytes.size()); }

  /// Detects the format of a file from its bytes and name; reads at most the first statement.
  ///
  /// 1. If a format is sure of the content, it is taken, whatever the name.
  /// 2. Else a file of another program is refused, whatever its name; see `refuse_foreign`.
  /// 3. Else the ending of the name decides: so an OFF file may begin with its counts, an OBJ file may have only
  ///    comments, and errors of a faulty file come from the reader of its format.
  /// 4. Else a format for which the content is possible.
  ///
  /// Errors: file_format for everything else. Cost: constant but for the comments.
  algebra3d::Result<const MeshFormat*> detect(std::string_view bytes, std::string_view file_name) const;

  /// `detect` for the file at `path`. Errors: also those of InputFile and FileContent (file_missing, io_error with the
  /// system's reason, ...).
  algebra3d::Result<const MeshFormat*> detect_file(const std::filesystem::path& path) const;

  /// The names as a list, "STL, OBJ or OFF", with the given conjunction.
  std::string names(std::string_view conjunction) const;
  /// A format and one of its forms.
  struct FormatForm {
    const MeshFormat* format;  ///< not null
    const FileForm* form;      ///< not null
  };
  /// The forms of all formats, in order.
  std::vector<FormatForm> forms() const;
  /// The words of all forms as a list: "stl, stl-ascii, obj, off or off-binary".
  std::string form_words(std::string_view conjunction) const;
  /// The endings as a list, ".stl, .obj or .off", each with the prefix `before`.
  std::string endings(std::string_view conjunction, std::string_view before = "") const;

 private:
  std::vector<MeshFormat> formats_;
};

/// The formats of this library, in the order of lists.
const MeshFormats& known_mesh_formats();

}  // namespace mesh_formats
