// check, repair and convert: mesh files without a database.
#include "queries/shell/detail/mesh_commands.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/kernel/repair/amount.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "base/diagnostics.h"
#include "base/text.h"
#include "mesh_formats/mesh_format.h"
#include "mesh_formats/mesh_formats.h"
#include "queries/importer/import_command.h"
#include "queries/shell/detail/mesh_input.h"
#include "queries/shell/detail/screen.h"

namespace queries {
namespace {

using algebra3d::Context;
using algebra3d::Diagnostics;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::ImportedSolid;
using algebra3d::MeshFileForm;
using algebra3d::RepairOptions;
using algebra3d::Result;

/// The exit status for an error; reports the error.
int fail_with(const MeshConsole& console, const Error& error) {
  constexpr int kWrongUsageOfMesh = 2;
  constexpr int kInterruptedMesh = 130;
  console.errors << "error: " << printable(error.text()) << "\n";
  if (error.code == ErrorCode::interrupted) return kInterruptedMesh;
  return error.code == ErrorCode::wrong_usage ? kWrongUsageOfMesh : 1;
}

void tell(const MeshConsole& console, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) console.errors << "note: " << printable(remark) << "\n";
}

/// The name of the solid in a file that is written: the file's, without folder and ending.
std::string solid_name(const std::string& file) {
  return std::filesystem::path(file).stem().string();
}

/// One line: the file's name and what it is.
std::string line_of(const std::string& name, const std::string& status) {
  return printable_line(name + ": " + status) + "\n";
}

const mesh_formats::MeshFormats& known_formats() {
  return mesh_formats::known_mesh_formats();
}

std::string one_input() {
  return known_formats().names("or") + " file; - is standard input";
}
std::string output_file() {
  return "File to write; its ending " + known_formats().endings("or") + " says the format";
}

/// "default for .obj, .off"
std::string default_for(mesh_formats::Encoding encoding) {
  std::string text;
  for (const mesh_formats::MeshFormat& format : known_formats())
    if (format.forms.front().encoding == encoding)
      text += (text.empty() ? "default for " : ", ") + std::string(format.endings.front());
  return text;
}

void add_output_options(CLI::App& command, MeshOutput& output) {
  auto* ascii = command.add_flag("--ascii", output.is_ascii,
                                 fmt::format("Write text ({})", default_for(mesh_formats::Encoding::ascii)));
  command
      .add_flag("--binary", output.is_binary,
                fmt::format("Write a binary file ({})", default_for(mesh_formats::Encoding::binary)))
      ->excludes(ascii);
  command.add_flag("--force", output.may_replace, "Replace OUT if it exists, even if it is FILE itself");
}

std::string volume_text(const std::optional<algebra3d::Amount>& volume) {
  return volume ? volume->text(10) : "unknown, since the triangles are not closed";
}

void print_repair(const MeshConsole& console, const std::string& name, const ImportedSolid& imported) {
  console.out << line_of(name, imported.found.validity.is_valid() && imported.status.starts_with("ok")
                                   ? imported.status
                                   : imported.found.defects());
  if (!imported.repair) return;
  console.out << "  changed  " << printable(imported.repair->text()) << "\n";
  console.out << "  volume   before: " << volume_text(imported.repair->volume_before)
              << "; after: " << volume_text(imported.repair->volume_after) << "\n";
}

}  // namespace

const CLI::App* MeshCommands::add_check(CLI::App& app) {
  CLI::App* check =
      app.add_subcommand("check", "Check which mesh files are valid solids, and list the defects of the others");
  check
      ->add_option("FILE", files_,
                   known_formats().names("and") +
                       " files, folders, patterns in quotes such as 'parts/*.stl'; - is standard input")
      ->type_name("")
      ->required();
  check->add_flag("--quiet", is_quiet_, "Only files with defects");
  check->footer(
      "One line for each file: 'ok', or its defects with numbers and places. Nothing is repaired or changed.\n"
      "Exit status: 0 all files are valid solids, 1 a file is not or cannot be read, 2 wrong usage, 130 interrupted.\n"
      "Example: algebra3d check parts/");
  return check;
}

const CLI::App* MeshCommands::add_repair(CLI::App& app) {
  CLI::App* repair = app.add_subcommand("repair", "Make a valid solid of a mesh file, and say what was changed");
  repair->add_option("FILE", input_, one_input())->type_name("")->required();
  repair->add_option("-o,--output", output_.file, output_file())->type_name("OUT")->required();
  add_output_options(*repair, output_);
  add_repair_options(*repair, options_);
  repair->footer(
      "A file that is a valid solid is written as it is, its triangles in spatial order.\n"
      "OUT is written completely or not at all, and only if there is a solid. STL has floats; OBJ and OFF keep "
      "doubles.\n"
      "Exit status: 0 OUT was written, 1 it was not, 2 wrong usage, 130 interrupted.\n"
      "Example: algebra3d repair scan.stl -o scan-closed.stl --largest-hole 20");
  return repair;
}

const CLI::App* MeshCommands::add_convert(CLI::App& app) {
  CLI::App* convert = app.add_subcommand("convert", "Write a mesh file in another format, facet by facet, unrepaired");
  convert->add_option("FILE", input_, one_input())->type_name("")->required();
  convert->add_option("OUT", output_.file, output_file())->type_name("")->required();
  add_output_options(*convert, output_);
  convert->footer(
      "Polygons stay polygons between OBJ and OFF, and become triangles in STL. Equal corners of STL files become one\n"
      "point. Colours, normals and texture coordinates are lost; notes say so. To repair the mesh: algebra3d repair.\n"
      "Exit status: 0 OUT was written, 1 it was not, 2 wrong usage, 130 interrupted.\n"
      "Example: algebra3d convert part.off part.stl --ascii");
  return convert;
}

void MeshCommands::add_to(CLI::App& app) {
  check_ = add_check(app);
  repair_ = add_repair(app);
  convert_ = add_convert(app);
}

std::optional<int> MeshCommands::run(const MeshConsole& console) const {
  if (check_->parsed()) return check(console);
  if (repair_->parsed()) return repair(console);
  if (convert_->parsed()) return convert(console);
  return std::nullopt;
}

int MeshCommands::check(const MeshConsole& console) const {
  int status = 0;
  for (const std::string& argument : files_) {
    const auto files = mesh_files_of(argument);
    if (!files) {
      status = fail_with(console, files.error());
      continue;
    }
    for (const std::string& name : *files) {
      const auto checked =
          algebra3d::import_solid(read_mesh_input(name, console.cancel), RepairOptions::strict(), console.cancel);
      if (!checked) return fail_with(console, checked.error());
      const bool is_valid = checked->solid.has_value();
      if (!is_valid) status = 1;
      if (!is_valid || !is_quiet_)
        console.out << printable_line(checked->text_about(name == "-" ? "standard input" : name)) + "\n" << std::flush;
    }
  }
  return status;
}

int MeshCommands::repair(const MeshConsole& console) const {
  const Result<MeshFileForm> form = form_of(output_);
  if (!form) return fail_with(console, form.error());
  auto imported = algebra3d::import_solid(read_mesh_input(input_, console.cancel), options_, console.cancel);
  if (!imported) return fail_with(console, imported.error());
  const std::string name = input_ == "-" ? "standard input" : input_;
  if (!imported->solid) {
    console.errors << "error: " << printable(imported->text_about(name)) << "\n";
    return 1;
  }
  print_repair(console, name, *imported);
  if (imported->wrong_count) tell(console, {imported->wrong_count->text()});
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = console.cancel, .folder = {}};
  const auto written =
      algebra3d::export_solid(context, "repair", *imported->solid, solid_name(output_.file), output_.file, *form);
  tell(console, diagnostics.summary());
  if (!written) return fail_with(console, written.error());
  if (written->refusal) return fail_with(console, {ErrorCode::io_error, "{} was not written", output_.file});
  console.out << fmt::format("{}: {}, {}\n", printable(output_.file), form_text(*form),
                             algebra3d::counted(imported->solid->mesh().face_count(), "triangle"));
  return 0;
}

int MeshCommands::convert(const MeshConsole& console) const {
  const Result<MeshFileForm> form = form_of(output_);
  if (!form) return fail_with(console, form.error());
  const auto input = MeshInput::open(input_, console.cancel);
  if (!input) return fail_with(console, input.error());
  std::vector<std::string> remarks;
  const auto written = convert_mesh(input->bytes(), input->name(), *form, output_.file, remarks, console.cancel);
  tell(console, remarks);
  if (!written) return fail_with(console, written.error());
  if (written->rounding > 0)
    tell(console, {fmt::format("coordinates were rounded to floats, by at most {:.3g}", written->rounding)});
  const std::string points = written->point_count > 0 ? algebra3d::counted(written->point_count, "point") + ", " : "";
  console.out << fmt::format("{}: {}, {}{}\n", printable(output_.file), form_text(*form), points,
                             algebra3d::counted(written->face_count, "facet"));
  return 0;
}

}  // namespace queries
