#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "algebra3d/base/error.h"
#include "base/byte_sink.h"
#include "base/context.h"
#include "base/output_path.h"
#include "mesh_formats/mesh_format.h"

namespace algebra3d {

/// Where an export goes: a file, which is written atomically, or a sink, which must outlive it.
class MeshDestination {
 public:
  /// The file that `file` means in a statement. Errors: those of Context::resolve_output.
  static Result<MeshDestination> file(const Context& context, const std::string& file);
  /// A sink, with a name for messages.
  static MeshDestination sink(ByteSink& sink, std::string name) { return {&sink, std::move(name)}; }

  /// For messages, as the user wrote it.
  const std::string& name() const { return name_; }
  /// Errors: those of MeshFormat::write_file, or of MeshFormat::write.
  Status write(const mesh_formats::MeshFormat& format, const mesh_formats::Facets& facets, std::string_view solid_name,
               mesh_formats::Encoding encoding) const;

 private:
  using Target = std::variant<OutputPath, ByteSink*>;
  MeshDestination(Target target, std::string name) : target_(std::move(target)), name_(std::move(name)) {}

  Target target_;
  std::string name_;
};

}  // namespace algebra3d
