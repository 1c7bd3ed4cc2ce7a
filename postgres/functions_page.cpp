// Writes docs/postgresql_functions.md: the functions, symbols and casts that algebra3d--1.0.sql creates, by the
// families of the registry, and what of the registry is left out, with the reason. Usage:
// algebra3d_postgres_functions_page FILE.sql
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "exported.h"
#include "queries/streams/all.h"
#include "sql_script.h"

namespace {

using namespace algebra3d_postgres;

std::string joined(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : std::string(separator)) + part;
  return text;
}

// ---- Forms: functions of one name that differ in the type of one parameter are written once ----

struct FormParameter {
  std::string name;  ///< empty where the functions have different ones
  std::vector<std::string> types;
};

struct Form {
  std::vector<FormParameter> parameters;
  std::string result;

  std::string written(std::string_view name, std::string_view either = " | ") const {
    std::vector<std::string> parts;
    for (const FormParameter& parameter : parameters)
      parts.push_back(parameter.name + (parameter.name.empty() ? "" : " ") + joined(parameter.types, either));
    return std::string(name) + "(" + joined(parts, ", ") + ")" + (result.empty() ? "" : " → " + result);
  }
};

Form form_of(const CreatedFunction& function, std::string result) {
  Form form;
  for (const SqlParameter& parameter : function.parameters)
    form.parameters.push_back({parameter.name, {parameter.type}});
  std::erase(result, '"');
  form.result = std::move(result);
  return form;
}

/// Adds the types of `other`, if the forms differ in one parameter at most.
bool absorb(Form& form, const Form& other) {
  if (form.result != other.result || form.parameters.size() != other.parameters.size()) return false;
  FormParameter *differing = nullptr, *begin = form.parameters.data();
  for (std::size_t p = 0; p < form.parameters.size(); ++p) {
    if (form.parameters[p].types == other.parameters[p].types) continue;
    if (differing != nullptr) return false;
    differing = begin + p;
  }
  for (std::size_t p = 0; p < form.parameters.size(); ++p)
    if (form.parameters[p].name != other.parameters[p].name) form.parameters[p].name.clear();
  if (differing == nullptr) return true;
  for (const std::string& type : other.parameters[static_cast<std::size_t>(differing - begin)].types)
    if (std::ranges::find(differing->types, type) == differing->types.end()) differing->types.push_back(type);
  return true;
}

std::vector<Form> merged(std::vector<Form> forms) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < forms.size(); ++i)
      for (std::size_t j = i + 1; j < forms.size();) {
        if (absorb(forms[i], forms[j])) {
          forms.erase(forms.begin() + static_cast<std::ptrdiff_t>(j));
          changed = true;
        } else {
          ++j;
        }
      }
  }
  return forms;
}

// ---- The page ----

/// What the registry knows of the functions of one name.
struct Known {
  std::string family, doc, operator_name;
};

class Page {
 public:
  Page(std::ostream& out, SqlScript script) : out_(out), script_(std::move(script)) {
    for (std::size_t i = 0; i < a3d_function_count(); ++i) {
      const a3d_function& function = *a3d_function_at(i);
      known_.try_emplace(function.name, Known{function.family, function.doc, function.operator_name});
      if (function.kind == A3D_AGGREGATE) results_[signature_of(function)] = sql_type(function.result_type);
    }
    for (const auto& [signature, text] : script_.comments)
      docs_.try_emplace(signature.substr(0, signature.find('(')), text);
    queries::register_stream_operators(registry_);
  }

  void write() {
    collect();
    out_ << "# Functions of the extension of PostgreSQL\n\n"
            "Generated from the registry and `postgres/algebra3d--1.0.sql`; `scripts/check-generated` compares this "
            "page "
            "with them.\n"
            "How the extension is used is in `docs/postgresql.md`; domain, special cases and examples of each function "
            "are in\n`docs/operators.md`, under the name of the operator, which is given where it is another one.\n\n"
            "`a | b` stands for either type. A function gives NULL if an argument is NULL, unless it says otherwise. "
            "Where there\nis no function for `bigint`, one for `float8` takes it. Aggregates skip NULL. The default "
            "values of options, and what is\naccepted in them, are those of the operator.\n";
    write_contents();
    for (const std::string& family : families_) write_family(family);
    write_symbols();
    write_casts();
    write_left_out();
  }

 private:
  static std::string signature_of(const a3d_function& function) {
    std::vector<std::string> types;
    for (std::size_t p = 0; p < function.parameter_count; ++p) types.push_back(sql_type(function.parameters[p].type));
    return std::string(function.name) + "(" + joined(types, ", ") + ")";
  }
  static std::string anchor(std::string family) {
    std::erase(family, ',');
    std::ranges::replace(family, ' ', '-');
    std::ranges::transform(family, family.begin(), [](unsigned char c) { return std::tolower(c); });
    return family;
  }
  /// Functions behind the types and their comparisons, which statements reach by symbols.
  bool is_behind_a_type(const std::string& name) const {
    return !known_.contains(name) && std::ranges::any_of(kTypes, [&](std::string_view type) {
      return name.starts_with(std::string(type) + "_");
    });
  }

  void collect() {
    for (const CreatedFunction& function : script_.functions) {
      if (function.is_internal || is_behind_a_type(function.name)) continue;
      by_name_[function.name].push_back(&function);
      created_.insert(function.signature());
    }
    for (const algebra3d::Family& family : registry_.families()) families_.push_back(family.name);
    families_.emplace_back(kOwnFamily);
    for (const auto& [name, functions] : by_name_) in_family_[family_of(name)].push_back(name);
    std::erase_if(families_, [&](const std::string& family) { return !in_family_.contains(family); });
  }
  std::string family_of(const std::string& name) const {
    const auto known = known_.find(name);
    return known == known_.end() ? std::string(kOwnFamily) : known->second.family;
  }

  void write_contents() {
    out_ << "\n| family | functions |\n|---|---|\n";
    for (const std::string& family : families_) {
      out_ << "| [" << family << "](#" << anchor(family) << ") |";
      for (const std::string& name : in_family_[family]) out_ << " `" << name << "`";
      out_ << " |\n";
    }
    out_ << "\nAt the end: [symbols](#symbols), [casts](#casts), and [what is left out](#what-is-left-out).\n";
  }

  void write_family(const std::string& family) {
    out_ << "\n## " << family << "\n";
    for (const std::string& name : in_family_[family]) write_functions(name, by_name_[name]);
  }

  std::string doc_of(const std::string& name) const {
    // Of functions that have no comment in the script.
    static const std::map<std::string, std::string> own = {
        {"as_text", "The value list of a value."},
        {"boxes_meet", "True if the boxes of doubles around two values meet; false if one is empty."}};
    if (const auto doc = docs_.find(name); doc != docs_.end()) return doc->second;
    if (const auto known = known_.find(name); known != known_.end()) return known->second.doc;
    const auto doc = own.find(name);
    return doc == own.end() ? "" : doc->second;
  }

  void write_functions(const std::string& name, const std::vector<const CreatedFunction*>& functions) {
    std::vector<Form> forms;
    bool takes_null = false, is_volatile = false;
    for (const CreatedFunction* function : functions) {
      const auto result = results_.find(function->signature());
      forms.push_back(
          form_of(*function, function->is_aggregate && result != results_.end() ? result->second : function->result));
      takes_null |= !function->is_aggregate && !function->is_strict;
      is_volatile |= function->is_volatile;
    }
    const auto known = known_.find(name);
    out_ << "\n### `" << name << "`\n\n" << doc_of(name);
    if (known != known_.end() && known->second.operator_name != name)
      out_ << " Operator `" << known->second.operator_name << "`.";
    if (functions.front()->is_aggregate) out_ << " An aggregate.";
    if (takes_null) out_ << " Takes NULL.";
    if (is_volatile) out_ << " Not IMMUTABLE.";
    out_ << "\n\n";
    for (const Form& form : merged(std::move(forms))) out_ << "    " << form.written(name) << "\n";
  }

  void write_symbols() {
    std::vector<std::pair<std::string, std::string>> order;  // symbol and function
    std::map<std::pair<std::string, std::string>, std::vector<Form>> forms;
    std::vector<std::string> comparisons;
    std::vector<Form> compared;
    for (const CreatedOperator& created : script_.operators) {
      if (is_behind_a_type(created.function)) {  // the comparisons have a function for each type
        if (std::ranges::find(comparisons, created.symbol) == comparisons.end()) comparisons.push_back(created.symbol);
        compared.push_back({{{"", {created.left}}}, ""});
        continue;
      }
      const auto key = std::pair(created.symbol, created.function);
      if (!forms.contains(key)) order.push_back(key);
      forms[key].push_back({{{"", {created.left}}, {"", {created.right}}}, ""});
    }
    out_ << "\n## Symbols\n\n| symbol | function | types |\n|---|---|---|\n| `" << joined(comparisons, "` `")
         << "` | the canonical order of two values of one type | " << types_of(std::move(compared)) << " |\n";
    for (const auto& key : order)
      out_ << "| `" << key.first << "` | `" << key.second << "` | " << types_of(std::move(forms[key])) << " |\n";
  }
  static std::string types_of(std::vector<Form> forms) {
    std::vector<std::string> lines;
    for (const Form& form : merged(std::move(forms))) {
      std::vector<std::string> sides;
      for (const FormParameter& side : form.parameters) sides.push_back(joined(side.types, ", "));
      lines.push_back(joined(sides, " with "));
    }
    return joined(lines, "<br>");
  }

  void write_casts() {
    out_ << "\n## Casts\n\n";
    if (script_.casts.empty()) {
      out_ << "None but those between each type and text, by its input and output.\n";
      return;
    }
    out_ << "| from | to | when |\n|---|---|---|\n";
    for (const CreatedCast& cast : script_.casts)
      out_ << "| `" << cast.from << "` | `" << cast.to << "` | " << cast.context << " |\n";
  }

  /// Why SQL lacks a function of the registry; empty if it has it. `taken` holds the signatures seen before.
  std::string reason_of(const a3d_function& function, std::set<std::string>& taken) const {
    if (function.reads_files != 0) return "reads files of the server's computer";
    if (function.writes_files != 0) return "writes files on the server's computer";
    if (is_generic(function.family)) return "PostgreSQL has it for every type: comparison, `IS NULL`, `CASE`";
    if (!has_known_types(function)) return "has a type that the extension lacks";
    if (!has_own_type(function)) return "has no type of the extension: SQL has functions of its own for plain values";
    const std::string signature = signature_of(function);
    if (!created_.contains(signature)) return "is there in another form";
    return taken.insert(signature).second ? "" : "is a duplicate where int is bigint, and string is text";
  }

  void write_left_out() {
    using Names = std::map<std::string, std::vector<Form>>;
    std::map<std::string, Names> left_out;                 // by reason
    std::map<std::string, std::set<std::string>> reasons;  // of the functions of one name; "" of those that are there
    std::set<std::string> taken;
    for (std::size_t i = 0; i < a3d_function_count(); ++i) {
      const a3d_function& function = *a3d_function_at(i);
      const std::string reason = reason_of(function, taken);
      reasons[function.name].insert(reason);
      if (!reason.empty()) left_out[reason][function.name].push_back(library_form(function));
    }
    out_ << "\n## What is left out\n\nFunctions of the registry that the extension does not have. Where only some "
            "functions "
            "of a name are left out, they are\nlisted with the types of the library.\n\n| reason | functions "
            "|\n|---|---|\n";
    for (auto& [reason, names] : left_out) {
      out_ << "| " << reason << " |";
      for (auto& [name, forms] : names) {
        if (reasons[name].size() == 1) {
          out_ << " `" << name << "`";
          continue;
        }
        for (const Form& form : merged(std::move(forms))) out_ << " `" << form.written(name, " or ") << "`";
      }
      out_ << " |\n";
    }
    out_ << "| is relational: SQL has its own statements for streams, relations, tuples and functions |";
    for (const algebra3d::Operator* op : registry_.operators())
      if (op->kind() == algebra3d::OperatorKind::relational) out_ << " `" << op->name << "`";
    out_ << " |\n";
  }
  static Form library_form(const a3d_function& function) {
    Form form;
    for (std::size_t p = 0; p < function.parameter_count; ++p)
      form.parameters.push_back({"", {function.parameters[p].type}});
    return form;
  }

  static constexpr std::string_view kOwnFamily = "the extension itself";

  std::ostream& out_;
  SqlScript script_;
  algebra3d::Registry registry_ = algebra3d::make_registry();
  std::map<std::string, Known> known_;          // by name
  std::map<std::string, std::string> docs_;     // likewise
  std::map<std::string, std::string> results_;  // of aggregates, by signature
  std::map<std::string, std::vector<const CreatedFunction*>> by_name_;
  std::set<std::string> created_;  // signatures
  std::vector<std::string> families_;
  std::map<std::string, std::vector<std::string>> in_family_;
};

}  // namespace

int main(int argc, char** argv) {
  std::ifstream file(argc == 2 ? argv[1] : "");
  if (!file) {
    std::cerr << "usage: algebra3d_postgres_functions_page FILE.sql\n";
    return 2;
  }
  a3d_session* const session = a3d_open(nullptr);
  if (session == nullptr) return 1;
  Page(std::cout, read_script(std::string(std::istreambuf_iterator<char>(file), {}))).write();
  a3d_close(session);
  return std::cout.flush() ? 0 : 1;
}
