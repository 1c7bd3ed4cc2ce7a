// importCSV: the lines of a CSV file as tuples.
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/scalars.h"
#include "base/error_subject.h"
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/detail/csv_layout.h"
#include "queries/streams/detail/import_columns.h"

namespace queries {
namespace {

using algebra3d::Type;

/// `place`: where in the file.
Error in_file(const std::string& name, Error error, const std::string& place = {}) {
  if (error.code == ErrorCode::interrupted) return error;
  // Errors of the system are about the file.
  if (error.code == ErrorCode::file_missing || error.code == ErrorCode::io_error)
    return std::move(error).about("importCSV");
  if (!place.empty()) error = std::move(error).about(place);
  return algebra3d::in_text_of(name, std::move(error)).about("importCSV");
}

/// The tuples of a CSV file, read as they are asked for.
class CsvTuples final : public TupleStream {
 public:
  CsvTuples(std::string name, CsvReader reader, CsvLayout layout, CsvOptions options, Context& context)
      : name_(std::move(name)),
        reader_(std::move(reader)),
        layout_(std::move(layout)),
        options_(std::move(options)),
        types_(attribute_types(layout_.tuple)),
        context_(context) {}

  Result<TuplePtr> next() override {
    while (true) {
      A3D_TRY(context_.check_cancelled());
      const auto has_record = reader_.next(record_);
      if (!has_record) return in_file(name_, has_record.error());
      if (!*has_record) return TuplePtr();
      const bool is_header = is_first_ && layout_.has_header;
      is_first_ = false;
      // The only column of a file may be empty; in others an empty line is not a tuple.
      if (is_header || (record_.is_blank() && layout_.columns.size() > 1)) continue;
      return tuple();
    }
  }

 private:
  Result<TuplePtr> tuple() {
    if (record_.cells.size() != layout_.columns.size()) {
      const std::string problem = wrong_length_text(record_, layout_.columns.size());
      if (!options_.errors_are_undefined) return in_file(name_, {ErrorCode::file_format, problem});
      context_.diagnostics.report_undefined("importCSV: a line of another length; cells that are missing are undefined",
                                            name_ + " " + problem);
    }
    Tuple made;
    made.attributes.reserve(types_.size());
    for (std::size_t i = 0; i < types_.size(); ++i) {
      A3D_ASSIGN(Value value, value_at(layout_.sources[i], *types_[i]));
      made.attributes.push_back(std::move(value));
    }
    return std::make_shared<const Tuple>(std::move(made));
  }

  Result<Value> value_at(std::size_t column, const Type& type) {
    if (column >= record_.cells.size()) return Value(type);
    const CsvCell& cell = record_.cells[column];
    const bool is_characters = type.storage() == Type::Storage::text;
    if (is_undefined_cell(cell, options_) || (cell.text.empty() && !is_characters)) return Value(type);
    auto value =
        value_of_text(type, is_characters ? cell.text : with_decimal_point(cell.text, decimal_of(type)), context_);
    if (value || value.error().code == ErrorCode::interrupted) return value;
    const std::string place = fmt::format("line {}, column {}", record_.line, layout_.columns[column]);
    if (!options_.errors_are_undefined) return in_file(name_, std::move(value).error(), place);
    context_.diagnostics.report_undefined("importCSV: " + value.error().text(), name_ + " " + place);
    return Value(type);
  }

  // Numbers alone are written with the decimal sign of the file.
  char decimal_of(const Type& type) const {
    const bool is_number = type.storage() == Type::Storage::integer || type.storage() == Type::Storage::real;
    return is_number ? options_.decimal : '.';
  }

  std::string name_;
  CsvReader reader_;
  CsvLayout layout_;
  CsvOptions options_;
  std::vector<const Type*> types_;
  Context& context_;
  CsvRecord record_;
  bool is_first_ = true;
};

TupleStreamPtr no_csv_tuples() {
  return make_stream([]() -> Result<TuplePtr> { return TuplePtr(); });
}

/// `guessed`: the layout that was found when the command was checked.
Result<Datum> run_csv_import(const Value& file, const CsvOptions& options, const TypeExpr& tuple,
                             const std::optional<CsvLayout>& guessed, Context& context) {
  if (!file.is_defined()) return Datum{no_csv_tuples()};
  const std::string& name = algebra3d::characters_of(file);
  A3D_ASSIGN(const std::filesystem::path path, context.resolve(name));
  auto layout = guessed ? Result<CsvLayout>(*guessed) : stated_csv_layout(path, options, tuple);
  if (!layout) return in_file(name, layout.error());
  auto reader = open_csv(path, layout->separator, options);
  if (!reader) return in_file(name, reader.error());
  if (const auto same = reader->file().check_state(layout->guessed_from); !same) return in_file(name, same.error());
  return Datum{TupleStreamPtr(
      std::make_shared<CsvTuples>(name, std::move(reader).value(), std::move(layout).value(), options, context))};
}

Result<BoundOperator> map_import_csv(std::span<const ArgumentType> arguments, Context& context) {
  const MappingCheck check("importCSV", arguments);
  A3D_ASSIGN(const ImportArguments given, import_arguments(check));
  const auto options = parse_csv_options(given.options);
  if (!options) return check.error(options.error().text());
  std::optional<CsvLayout> guessed;
  TypeExpr tuple = given.tuple.value_or(TypeExpr());
  if (!given.tuple) {
    A3D_ASSIGN(const std::string name, constant_file_name(check, "importCSV"));
    A3D_ASSIGN(const std::filesystem::path path, context.resolve(name));
    auto layout = guess_csv_layout(path, *options, context);
    if (!layout) return in_file(name, layout.error());
    guessed = std::move(layout).value();
    tuple = guessed->tuple;
    std::vector<std::string> attributes;
    for (const auto& attribute : tuple.attributes()) attributes.push_back(attribute.name);
    const std::string note = renaming_note("importCSV", guessed->columns, attributes);
    if (!note.empty()) context.diagnostics.report(note);
  }
  return BoundOperator{
      TypeExpr::stream(tuple),
      [options = *options, tuple, guessed](const std::vector<Datum>& values, Context& running) -> Result<Datum> {
        return run_csv_import(values[0].value(), options, tuple, guessed, running);
      }};
}

}  // namespace

void register_csv_import(algebra3d::OperatorGroup& group) {
  group.add({
      .name = "importCSV",
      .syntax = "importCSV(_ ...)",
      .doc = "The lines of a CSV file as tuples, in order; types are guessed or those of a given relation.",
      .detail =
          "`importCSV(FILE)` reads the file when the command is checked: a column of whole numbers is int, one of "
          "numbers real, one of TRUE and FALSE bool, any other string; `007` and numbers that an int or a real "
          "cannot hold stay strings. `importCSV(FILE, R)` takes attributes and types from the relation R, whose "
          "tuples are ignored: the columns of these names, or all columns by their position if there is no header. A "
          "last argument holds options: 'separator=;' (or comma, semicolon, tab, pipe, blank; else guessed), "
          "'header=no' (or yes; else the first line is a header if all its cells are texts), 'decimal=,', 'skip=2' "
          "(lines before the header), 'undefined=NA', 'errors=undefined' (a wrong cell is undefined and a line too "
          "short is filled up, with a diagnostic that gives the line; else these are errors). An empty cell is "
          "undefined, a quoted empty cell the empty string. The file is UTF-8. Quotes are those of RFC 4180. "
          "Relative names start at the folder of the session.",
      .exactness = algebra3d::Exactness::exact,
      .frame_use = algebra3d::FrameUse::coordinates,
      .is_pure = false,
      .reads_files = true,
      .sources = {"rfc4180"},
      .stream = reading_stream_operator(map_import_csv),
      .signatures = {"(text) -> stream(tuple)", "(text rel) -> stream(tuple)", "(text text) -> stream(tuple)",
                     "(text rel text) -> stream(tuple)"},
      .handles_undefined = true,
      .query_examples = {{"importCSV([const text value undefined], [const rel(tuple([Name: string])) value ()]) count",
                          "0"}},
      .query_errors = {{"query importCSV(5) count", "importCSV: expected text, got int"},
                       {"query importCSV('no such file.csv') count", "no such file.csv: No such file or directory"},
                       {"query importCSV('a.csv', 'header=perhaps') count",
                        "importCSV: header: expected yes or no, found \"perhaps\""}},
  });
}

}  // namespace queries
