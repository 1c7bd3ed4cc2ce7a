#include "queries/language/documentation.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "algebra3d/operators/registry/operator.h"
#include "queries/language/example_queries.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

using algebra3d::Family;
using algebra3d::Operator;
using algebra3d::OperatorKind;
using algebra3d::QueryError;
using algebra3d::QueryExample;
using algebra3d::Registry;
using algebra3d::Type;

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += separator;
    text += part;
  }
  return text;
}

// Operators over every type have one signature per type: the first few say enough.
std::vector<std::string> shown_signatures(const Operator& op) {
  constexpr std::size_t kShown = 8;
  std::vector<std::string> all = op.all_signatures();
  if (all.size() <= kShown) return all;
  const std::size_t more = all.size() - kShown;
  all.resize(kShown);
  all.push_back("... and " + std::to_string(more) + " more of the same form");
  return all;
}

std::string with_query(const std::string& query) {
  return query.starts_with("query ") ? query : "query " + query;
}

/// The rule for undefined arguments if the description says nothing else.
std::string undefined_rule(const Operator& op) {
  if (op.kind() == OperatorKind::aggregate) return "Undefined values are left out.";
  if (op.accepts_undefined()) return "Handles undefined arguments itself.";
  return op.kind() == OperatorKind::table ? "No rows if an argument is undefined." : "Undefined if an argument is.";
}

/// "constant", "linear in the size of the file; reads files"
std::string cost_text(const Operator& op) {
  std::string text(describe(op.cost));
  if (op.reads_files) text += "; reads files";
  if (op.writes_files) text += "; writes files";
  if (op.changes_relations) text += "; changes stored relations";
  if (!op.is_pure && !op.reads_files && !op.writes_files && !op.changes_relations)
    text += "; not a function of its arguments alone";
  return text;
}

// A cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string example_table(const Operator& op, const Registry& registry) {
  std::string rows;
  for (const auto& [query, result] : example_queries(registry, op))
    rows += "| `" + cell(query) + "` | `" + cell(result) + "` |\n";
  for (const auto& [query, message] : failing_queries(registry, op))
    rows += "| `" + cell(query) + "` | error: " + cell(message) + " |\n";
  return rows.empty() ? "" : "\n| query | result |\n|---|---|\n" + rows;
}

/// The place of a heading within a page, as GitHub and others make it of its words.
std::string anchor_of(std::string_view heading) {
  std::string anchor;
  for (const char c : heading)
    if (c == ' ')
      anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return anchor;
}

std::string operator_section(const Operator& op, const Registry& registry) {
  std::string text = "\n### `" + op.name + "`\n\n`" + op.written() + "`\n\n" + op.doc;
  if (!op.detail.empty()) text += " " + op.detail;
  if (!op.language_note.empty()) text += " " + op.language_note;
  if (op.kind() != OperatorKind::relational && op.kind() != OperatorKind::aggregate && op.accepts_undefined())
    text += " " + undefined_rule(op);
  text += "\n\n";
  for (const std::string& signature : shown_signatures(op)) text += "- `" + signature + "`\n";
  text += "\nExactness: " + std::string(describe(op.exactness)) + ". Cost: " + cost_text(op) + ".";
  if (op.kind() != OperatorKind::relational) text += " In other hosts: `" + op.host_name + "`.";
  text += "\n";
  if (!op.sources.empty()) text += "\nSources: [" + joined(op.sources, "], [") + "].\n";
  return text + example_table(op, registry);
}

std::string type_row(const Type& type) {
  std::vector<std::string> kinds;
  for (const Type::Kind kind : type.kinds()) kinds.emplace_back(Type::kind_name(kind));
  return "| `" + std::string(type.name()) + "` | " + joined(kinds, ", ") + " | `" + cell(std::string(type.notation())) +
         "` | " + cell(std::string(type.doc())) + " |\n";
}

std::string contents_row(const Family& family, const Registry& registry) {
  std::vector<std::string> names;
  for (const Operator* op : registry.operators_of(family.name)) names.push_back("`" + cell(op->name) + "`");
  return fmt::format("| [{}](#{}) | {} |\n", family.name, anchor_of(family.name), joined(names, " "));
}

std::string family_section(const Family& family, const Registry& registry) {
  std::string text = "\n## " + family.name + "\n\n" + family.doc + "\n";
  for (const Operator* op : registry.operators_of(family.name)) text += operator_section(*op, registry);
  return text;
}

// The rules that hold for all operators, said once.
constexpr std::string_view kRules =
    "\nUnless an operator says otherwise, its result is undefined if an argument is; an operator that returns a\n"
    "stream then returns an empty one, and aggregates skip undefined values. An int is accepted where a real is\n"
    "expected, a string where a text is expected. An aggregate is written with the attribute of a stream that holds\n"
    "its values; its signature has a `*`. `In other hosts` is the name of the function in SQL, Python and other\n"
    "languages with such names.\n";

}  // namespace

std::string help_text(const Operator& op, const Registry& registry) {
  std::string text = op.name + "    " + op.written() + "\n\n  " + op.doc + "\n";
  if (!op.detail.empty()) text += "  " + op.detail + "\n";
  if (!op.language_note.empty()) text += "  " + op.language_note + "\n";
  text += "  " + undefined_rule(op) + "\n\nSignatures\n";
  for (const std::string& signature : shown_signatures(op)) text += "  " + signature + "\n";
  text += "\nExactness\n  " + std::string(describe(op.exactness)) + "\n\nCost\n  " + cost_text(op) + "\n";
  const std::vector<QueryExample> examples = example_queries(registry, op);
  if (!examples.empty()) text += "\nExamples\n";
  for (const auto& [query, result] : examples) text += fmt::format("  {}\n      {}\n", with_query(query), result);
  const std::vector<QueryError> errors = failing_queries(registry, op);
  if (!errors.empty()) text += "\nErrors\n";
  for (const auto& [query, message] : errors) text += fmt::format("  {}\n      {}\n", query, message);
  text += "\nFamily\n  " + op.family + "\n";
  if (!op.sources.empty()) text += "\nSources\n  " + joined(op.sources, ", ") + " (see docs/references.md)\n";
  return text;
}

std::string help_overview(const std::vector<const Operator*>& operators) {
  std::size_t width = 0;
  for (const Operator* op : operators) width = std::max(width, op->written().size());
  width = std::min<std::size_t>(width, 40);
  std::string text;
  for (const Operator* op : operators) {
    const std::string written = op->written();
    text += "  " + written;
    text += written.size() > width ? "\n  " + std::string(width, ' ') : std::string(width - written.size(), ' ');
    text += "  " + op->doc + "\n";
  }
  return text;
}

std::string family_overview(const Registry& registry) {
  std::size_t width = 0;
  for (const Family& family : registry.families()) width = std::max(width, family.name.size());
  std::string text;
  for (const Family& family : registry.families()) text += fmt::format("  {:{}}  {}\n", family.name, width, family.doc);
  return text;
}

std::string reference_page(const Registry& registry) {
  std::string text =
      "# Operators\n\n"
      "Generated by `algebra3d help --markdown` from the descriptions in the registry; `scripts/check-generated`\n"
      "compares this page with that output. Every example is run as a test.\n" +
      std::string(kRules) + "\n| family | operators |\n|---|---|\n";
  for (const Family& family : registry.families()) text += contents_row(family, registry);
  text += "\n## Types\n\n| type | kinds | value list | meaning |\n|---|---|---|---|\n";
  for (const Type* type : listed_types(registry)) text += type_row(*type);
  for (const Family& family : registry.families()) text += family_section(family, registry);
  return text;
}

}  // namespace queries
