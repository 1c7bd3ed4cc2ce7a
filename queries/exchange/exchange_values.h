#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include "queries/session/session.h"

namespace queries {

/// True for values that are shown as a summary (count and box) and not as lists: geometry.
bool is_summarised(const Value& value);

/// Size of the output buffer.
constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16U;

/// Options for results as JSON or CSV.
struct ExchangeOptions {
  /// The form of solids, surfaces, meshes and point sets: count and box, value list, or (but for point sets) the name
  /// of a mesh file.
  enum class Geometry : std::uint8_t { summary, list, file };
  Geometry geometry = Geometry::summary;
  std::filesystem::path folder = {};  ///< of the mesh files
  std::string mesh_ending = "obj";    ///< ending of a mesh format, without the point
  bool rounds_fractions = false;      ///< write coordinates `p/q` as the nearest doubles
  bool has_header = true;             ///< CSV: attribute names in the first line
  /// JSON: a nested relation with more tuples is a summary.
  std::size_t most_nested_tuples = std::numeric_limits<std::size_t>::max();
};

/// Writes values for other programs. Geometry is loaded only if it is written. Used by one thread.
class ExchangeValues {
 public:
  explicit ExchangeValues(ExchangeOptions options) : options_(std::move(options)) {}

  /// Appends the value of the attribute `name` as JSON; undefined is null, a nested relation an array of objects. A
  /// value whose mesh file cannot be written is null, with a diagnostic. Errors: those of the store; io_error for a
  /// folder that cannot be created.
  Status append_json(const Value& value, const std::string& name, Context& context, std::string& json);
  /// Appends the value as a CSV cell: empty for undefined, quoted if necessary and for the empty string. Values without
  /// a CSV form are value lists, as in `(1.0 2.0 3.0)`. Errors: also type_error for a nested relation.
  Status append_csv(const Value& value, const std::string& name, Context& context, std::string& csv);

  /// Append a value that is the whole result. Errors: also io_error for one whose file cannot be written.
  Status append_json_result(const Value& value, Context& context, std::string& json);
  Status append_csv_result(const Value& value, Context& context, std::string& csv);

  const ExchangeOptions& options() const { return options_; }

 private:
  /// The form of a value: one of the two members.
  struct Form {
    NestedList list;
    std::string json;  ///< a summary; empty if the list is used
  };
  Status append_nested(const Value& relation, Context& context, std::string& json);
  Result<Form> form_of(const Value& value, const std::string& name, Context& context);
  Result<NestedList> written_file(const Value& value, const std::string& name, Context& context);

  ExchangeOptions options_;
  std::map<std::string, std::size_t> file_counts_;  // by the name of the attribute
};

/// The error for an attribute that CSV cannot have.
Error no_nested_in_csv(const std::string& name);

/// Appends a cell of a CSV file. Source: [rfc4180].
void append_csv_text(std::string& csv, std::string_view text);

}  // namespace queries
