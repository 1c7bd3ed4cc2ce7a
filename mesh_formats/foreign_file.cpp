#include "mesh_formats/foreign_file.h"

#include <algorithm>
#include <array>
#include <string>

#include "mesh_formats/file_ending.h"

namespace mesh_formats {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Status;

namespace {

/// The number of first bytes of a file in which names of its format are looked for.
constexpr std::size_t kLookedAt = std::size_t{64} << 10U;

struct Sign {
  std::string_view text;
  ForeignKind kind;
};

constexpr ForeignKind shapes(std::string_view name) {
  return {name, ForeignContent::shapes};
}

constexpr std::array kBeginnings{
    Sign{"SQLite format 3", {"a SQLite database"}},
    Sign{"\x1f\x8b", {"compressed by gzip"}},
    Sign{"\x28\xb5\x2f\xfd", {"compressed by zstd"}},
    Sign{"\xfd"
         "7zXZ",
         {"compressed by xz"}},
    Sign{"BZh", {"compressed by bzip2"}},
    Sign{"7z\xbc\xaf", {"a 7z archive"}},
    Sign{"Rar!\x1a", {"a RAR archive"}},
    Sign{"\x7f"
         "ELF",
         {"a program"}},
    Sign{"MZ\x90", {"a program"}},
    Sign{"\xcf\xfa\xed\xfe", {"a program"}},
    Sign{"\x89PNG", {"a PNG image"}},
    Sign{"\xff\xd8\xff", {"a JPEG image"}},
    Sign{"%PDF", {"a PDF document"}},
    Sign{"version https://git-lfs", {"a pointer of Git LFS without the content of the file"}},
    Sign{"\xff\xfe", {"text in UTF-16, not UTF-8"}},
    Sign{"\xfe\xff", {"text in UTF-16, not UTF-8"}},
    Sign{"ply\n", shapes("a PLY file")},
    Sign{"ply\r", shapes("a PLY file")},
    Sign{"glTF", shapes("a binary glTF file (GLB)")},
    Sign{"Kaydara FBX", shapes("an FBX file")},
    Sign{"; FBX ", shapes("an FBX file")},
    Sign{"#VRML V", shapes("a VRML file")},
    Sign{"# vtk DataFile", shapes("a VTK file")},
    Sign{"$MeshFormat", shapes("a Gmsh file")},
    Sign{"DBRep_DrawableShape", shapes("a BREP file of Open CASCADE")},
    Sign{"CASCADE Topology", shapes("a BREP file of Open CASCADE")},
    Sign{"#usda ", shapes("a USD file")},
    Sign{"PXR-USDC", shapes("a USD file")},
    Sign{"BLENDER", shapes("a Blender file")},
    Sign{"LASF", shapes("a LAS file of points")},
    Sign{"AutoCAD Binary DXF", shapes("a DXF file")},
    Sign{"AC10", shapes("a DWG drawing")},
};

/// The first of them that occurs in XML decides.
constexpr std::array kXmlElements{
    Sign{"<COLLADA", shapes("a COLLADA file")},  Sign{"<X3D", shapes("an X3D file")},
    Sign{"<amf", shapes("an AMF file")},         Sign{"/3dmanufacturing/", shapes("the model of a 3MF file")},
    Sign{"CityModel", shapes("a CityGML file")}, Sign{"<VTKFile", shapes("a VTK file")},
};

constexpr std::array kEndings{
    Sign{".ply", shapes("a PLY file")},       Sign{".3mf", shapes("a 3MF file")},
    Sign{".step", shapes("a STEP file")},     Sign{".stp", shapes("a STEP file")},
    Sign{".ifc", shapes("an IFC file")},      Sign{".gltf", shapes("a glTF file")},
    Sign{".glb", shapes("a GLB file")},       Sign{".iges", shapes("an IGES file")},
    Sign{".igs", shapes("an IGES file")},     Sign{".fbx", shapes("an FBX file")},
    Sign{".dae", shapes("a COLLADA file")},   Sign{".dxf", shapes("a DXF file")},
    Sign{".dwg", shapes("a DWG drawing")},    Sign{".3ds", shapes("a 3DS file")},
    Sign{".wrl", shapes("a VRML file")},      Sign{".x3d", shapes("an X3D file")},
    Sign{".amf", shapes("an AMF file")},      Sign{".blend", shapes("a Blender file")},
    Sign{".skp", shapes("a SketchUp file")},  Sign{".sldprt", shapes("a SolidWorks part")},
    Sign{".brep", shapes("a BREP file")},     Sign{".usd", shapes("a USD file")},
    Sign{".usdz", shapes("a USD file")},      Sign{".vtk", shapes("a VTK file")},
    Sign{".x_t", shapes("a Parasolid file")}, Sign{".jt", shapes("a JT file")},
};

bool holds(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

bool begins_value(std::string_view text, std::string_view after, std::string_view first_of) {
  if (!text.starts_with(after)) return false;
  const std::size_t next = text.find_first_not_of(" \t\r\n", after.size());
  return next != std::string_view::npos && holds(first_of, text.substr(next, 1));
}

/// A member that every file of the format has, in the order of the text.
ForeignKind kind_of_json(std::string_view text) {
  if (holds(text, "\"CityJSON")) return shapes("a CityJSON file");
  if (holds(text, "\"asset\"") && (holds(text, "\"version\"") || holds(text, "\"generator\"")))
    return shapes("a glTF file");
  constexpr std::array<std::string_view, 5> kGeoJsonTypes{"\"FeatureCollection\"", "\"Feature\"", "\"Polygon\"",
                                                          "\"MultiPolygon\"", "\"GeometryCollection\""};
  const bool is_geojson = holds(text, "\"type\"") &&
                          std::ranges::any_of(kGeoJsonTypes, [&](std::string_view type) { return holds(text, type); });
  if (is_geojson) return {"a GeoJSON file", ForeignContent::regions};
  return {"a JSON file", ForeignContent::rows};
}

/// In any case of the letters: what a server answers in place of a file that it has not.
bool is_html(std::string_view text) {
  constexpr std::size_t kLongest = 14;
  std::string word(text.substr(0, kLongest));
  std::ranges::transform(word, word.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return word.starts_with("<!doctype html") || word.starts_with("<html");
}

ForeignKind kind_of_xml(std::string_view text) {
  if (is_html(text)) return {"a web page (HTML)"};
  for (const Sign& element : kXmlElements)
    if (holds(text, element.text)) return element.kind;
  return {text.starts_with("<?xml") ? "an XML file" : ""};
}

/// ISO 10303-21; the schema names what it describes.
ForeignKind kind_of_step(std::string_view text) {
  constexpr std::size_t kNameOfSchema = 100;
  const std::size_t schema = text.find("FILE_SCHEMA");
  const bool is_ifc = schema != std::string_view::npos && holds(text.substr(schema, kNameOfSchema), "IFC");
  return shapes(is_ifc ? "an IFC file" : "a STEP file");
}

ForeignKind kind_of_zip(std::string_view head) {
  if (holds(head, "3D/") && holds(head, ".model")) return shapes("a 3MF file");
  return {"a ZIP archive (as .3mf and .xlsx files are)"};
}

/// Group 0 with the word SECTION: the beginning of every DXF file in text, but for comments.
bool is_dxf(std::string_view text) {
  if (!text.starts_with("0")) return false;
  const std::size_t word = text.find_first_not_of(" \t\r\n", 1);
  return word > 1 && word != std::string_view::npos && text.substr(word).starts_with("SECTION");
}

/// The first line of an IGES file: 72 columns of text, the letter of the start section, and the number 1.
bool is_iges(std::string_view head) {
  constexpr std::size_t kSection = 72, kColumns = 80;
  return head.size() > kColumns && head[kSection] == 'S' && head[kColumns - 1] == '1' &&
         head.substr(0, kColumns).find_first_of("\r\n") == std::string_view::npos &&
         (head[kColumns] == '\n' || head[kColumns] == '\r') &&
         head.substr(kSection + 1, kColumns - kSection - 2).find_first_not_of(" 0") == std::string_view::npos;
}

// A tar archive begins with the name of its first file.
bool is_tar(std::string_view head) {
  constexpr std::size_t kMagicPlace = 257;
  return head.size() > kMagicPlace && head.substr(kMagicPlace).starts_with("ustar");
}

// Text of Latin letters in UTF-16 has a zero in every second byte, also without a mark at the beginning.
bool is_utf16(std::string_view head) {
  constexpr std::size_t kSampleBytes = 64, kLeastBytes = 16;
  const std::string_view sample = head.substr(0, kSampleBytes);
  if (sample.size() < kLeastBytes) return false;
  const auto is_text = [](char c) { return c == '\t' || c == '\r' || c == '\n' || (c >= ' ' && c <= '~'); };
  const auto is_pair = [&](std::size_t i, std::size_t zero) {
    return sample[i + zero] == 0 && is_text(sample[i + 1 - zero]);
  };
  for (const std::size_t zero : {0, 1}) {
    std::size_t i = 0;
    while (i + 1 < sample.size() && is_pair(i, zero)) i += 2;
    if (i + 1 >= sample.size()) return true;
  }
  return false;
}

std::string_view without_blanks_before(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

}  // namespace

ForeignKind foreign_kind(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kLookedAt);
  for (const Sign& beginning : kBeginnings)
    if (head.starts_with(beginning.text)) return beginning.kind;
  if (head.starts_with("PK\x03\x04")) return kind_of_zip(head);
  if (is_utf16(head)) return {"text in UTF-16, not UTF-8"};
  if (is_tar(head)) return {"a tar archive"};
  if (is_iges(head)) return shapes("an IGES file");
  const std::string_view text = without_blanks_before(head);
  if (text.starts_with("ISO-10303-21")) return kind_of_step(text);
  if (begins_value(text, "{", "\"") || begins_value(text, "[", "{[")) return kind_of_json(text);
  if (text.starts_with("<")) return kind_of_xml(text);
  return is_dxf(text) ? shapes("a DXF file") : ForeignKind{};
}

ForeignKind foreign_kind_of_name(std::string_view file_name) {
  const std::string ending = file_ending(file_name);
  const auto* const found = std::ranges::find(kEndings, ending, &Sign::text);
  return found == kEndings.end() ? ForeignKind{} : found->kind;
}

Status refuse_foreign(std::string_view bytes, std::string_view file_name, std::string_view expected) {
  const ForeignKind kind = foreign_kind(bytes);
  if (kind.name.empty()) return {};
  return Error{ErrorCode::file_format, "it is {}; expected an {} file{}", kind.name, expected,
               kind.content == ForeignContent::shapes ? ", as the program that made it may save" : ""}
      .about(file_name);
}

}  // namespace mesh_formats
