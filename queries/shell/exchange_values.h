#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "queries/session/session.h"

namespace queries {

/// Bytes of a document that are collected before they are written.
constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16U;

/// How results are written for other programs, as JSON or CSV.
struct ExchangeOptions {
  /// Solids, surfaces and point sets: their counts and box, their value list, or (solids) the name of a mesh file.
  enum class Geometry : std::uint8_t { summary, list, file };
  Geometry geometry = Geometry::summary;
  std::filesystem::path folder = {};  ///< of the mesh files
  std::string mesh_format = "obj";    ///< obj, off or stl
  bool rounds_fractions = false;      ///< coordinates `p/q` as the nearest doubles
  bool has_header = true;             ///< CSV: names of the attributes in the first line
};

/// Writes values as other programs read them. Geometry is read only where it is shown. Used by one thread.
class ExchangeValues {
 public:
  ExchangeValues(const algebra3d::Registry& registry, ExchangeOptions options)
      : registry_(registry), options_(std::move(options)) {}

  /// Appends the value of the attribute `name` as JSON; undefined is null. A solid whose file cannot be written is
  /// null, with a diagnostic. Errors: those of the store; io_error for a folder that cannot be made.
  Status append_json(const Value& value, const std::string& name, Context& context, std::string& json);
  /// Appends the value as a cell of a CSV file: nothing for undefined, quotes where the content needs them and around
  /// the empty string. Values without a form of their own are value lists, as in `(1.0 2.0 3.0)`.
  Status append_csv(const Value& value, const std::string& name, Context& context, std::string& csv);

  /// The same where the value is all of the result. Errors: besides, io_error for a solid whose file cannot be written.
  Status append_json_result(const Value& value, Context& context, std::string& json);
  Status append_csv_result(const Value& value, Context& context, std::string& csv);

  const ExchangeOptions& options() const { return options_; }

 private:
  /// What stands for a value: one of the two.
  struct Form {
    NestedList list;
    std::string json;  ///< a summary; empty if the list counts
  };
  Result<Form> form_of(const Value& value, const std::string& name, Context& context);
  Result<NestedList> written_file(const Value& solid, const std::string& name, Context& context);

  const algebra3d::Registry& registry_;
  ExchangeOptions options_;
  std::map<std::string, std::size_t> file_counts_;  // by the name of the attribute
};

/// Appends a cell of a CSV file. Source: [rfc4180].
void append_csv_text(std::string& csv, std::string_view text);

}  // namespace queries
