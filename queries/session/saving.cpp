// The commands of a session that save a database or an object as a nested list. The text is written object by object
// and tuple by tuple, into a file that appears when it is whole, so that a failure leaves what was there.
#include <algorithm>

#include <fmt/format.h>

#include "algebra3d/values/types/value_text.h"
#include "base/atomic_file.h"
#include "base/propagate.h"
#include "queries/language/scanner.h"
#include "queries/session/detail/objects.h"
#include "queries/session/detail/saved_list.h"
#include "queries/session/session.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

Error cannot_write(Error reason) {
  return std::move(reason).about("save: the file cannot be written");
}

// Any file may hold a database, but a name in a list is a word. It is not used when the list is read.
std::string word_of_database(const std::filesystem::path& file) {
  std::string word = file.stem().string();
  if (is_identifier(word)) return word;
  std::ranges::replace_if(
      word, [](char c) { return !is_identifier(std::string("_") + c); }, '_');
  return is_identifier(word) ? word : "_" + word;
}

/// The file being saved, with the error that is reported for it.
class ListFile {
 public:
  static Result<ListFile> create(const algebra3d::OutputPath& path) {
    auto file = algebra3d::AtomicFile::create(path);
    if (!file) return cannot_write(std::move(file).error());
    return ListFile(std::move(file).value());
  }
  template <typename... Parts>
  Status write(const Parts&... parts) {
    std::string text;
    ((text += parts), ...);
    Status status = file_.append(text);
    return status ? status : cannot_write(std::move(status).error());
  }
  Status finish() {
    Status status = file_.commit();
    return status ? status : cannot_write(std::move(status).error());
  }

 private:
  explicit ListFile(algebra3d::AtomicFile file) : file_(std::move(file)) {}

  algebra3d::AtomicFile file_;
};

class ObjectWriter {
 public:
  ObjectWriter(Store& store, ListFile& file, Context& context) : store_(store), file_(file), context_(context) {}

  Status write(const ObjectInfo& info) {
    A3D_TRY(context_.check_cancelled());
    if (!info.derived_text.empty()) return write_derived(info);
    A3D_TRY(file_.write("    (OBJECT ", info.name, " () ", info.type.text()));
    if (info.has_value) A3D_TRY(write_value(info));
    return file_.write(")\n");
  }

 private:
  Status write_derived(const ObjectInfo& info) {
    A3D_TRY(file_.write("    (DERIVED ", info.name, " ", info.derived_text));
    if (is_defined(info)) A3D_TRY(file_.write(" ", kWasDefined));
    return file_.write(")\n");
  }

  // Whether a derived object has a value. An object that cannot be read is derived again all the same.
  bool is_defined(const ObjectInfo& info) {
    if (!info.has_value || info.type.is_relation() || is_index(info.type)) return false;
    const auto value = store_.read(info.name);
    const auto* single = value ? std::get_if<Value>(&value->content) : nullptr;
    return single != nullptr && single->is_defined();
  }

  Status write_value(const ObjectInfo& info) {
    if (info.type.is_function()) return file_.write(" ", info.function_text, " ()");
    A3D_ASSIGN(const Datum value, store_.read(info.name));
    if (info.type.is_relation()) {
      warn_of_tuple_numbers(info);
      return write_relation(*value.relation());
    }
    if (info.type.is("rtree3")) return write_index(info, *value.index(), "creatertree");
    if (info.type.is("btree")) return write_index(info, *value.ordered_index(), "createbtree");
    A3D_ASSIGN(const Value loaded, value.value().loaded());
    std::string text;
    append_text(loaded, text);
    return file_.write(" ", text, " ()");
  }

  void warn_of_tuple_numbers(const ObjectInfo& info) {
    for (const auto& attribute : info.type.element().attributes())
      if (attribute.type.is("tid"))
        context_.diagnostics.report("save: '" + info.name + "." + attribute.name +
                                    "' holds numbers of tuples, which may be others after a restore");
  }

  Status write_relation(Relation& relation) {
    A3D_TRY(file_.write(" ("));
    A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
    while (true) {
      A3D_TRY(context_.check_cancelled());
      A3D_ASSIGN(const TuplePtr tuple, tuples->next());
      if (tuple == nullptr) return file_.write(") ()");
      std::string row;
      for (const Value& attribute : tuple->attributes) {
        A3D_ASSIGN(const Value loaded, attribute.loaded());
        if (!row.empty()) row += ' ';
        append_text(loaded, row);
      }
      A3D_TRY(file_.write("\n      (", row, ")"));
    }
  }

  // An index is saved as the expression that makes it: its entries lie in the relation.
  template <typename Index>
  Status write_index(const ObjectInfo& info, const Index& index, std::string_view maker) {
    if (index.is_definition()) return file_.write(" (", maker, " ", index.relation(), " ", index.attribute(), ") ()");
    context_.diagnostics.report("save: '" + info.name +
                                "' is a copy of a stream, with tuple numbers that have no meaning elsewhere; it is "
                                "saved without a value");
    return {};
  }

  Store& store_;
  ListFile& file_;
  Context& context_;
};

}  // namespace

// Their values are not saved, as those of no derived object are.
Status Session::note_underivable(const std::string& name, Context& context) {
  A3D_ASSIGN(UnusableDefinitions unusable, unusable_definitions(context));
  if (!name.empty()) std::erase_if(unusable.underivable, [&](const Underivable& each) { return each.name != name; });
  if (unusable.underivable.empty()) return {};
  context.diagnostics.show(
      fmt::format("save: these objects cannot be derived again, and `restore` will leave them out: {}",
                  fmt::join(unusable.underivable_names(), ", ")));
  for (const Underivable& each : unusable.underivable)
    context.diagnostics.report(fmt::format("save: '{}' cannot be derived again: {}", each.name, each.reason));
  return {};
}

Status Session::run(const SaveDatabase& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_ASSIGN(const algebra3d::OutputPath path, context.resolve_output(command.file));
  A3D_ASSIGN(ListFile file, ListFile::create(path));
  Status status = in_transaction(false, [&]() -> Status {
    A3D_TRY(note_underivable({}, context));
    A3D_TRY(
        file.write(kSavedHere, "\n(DATABASE ", word_of_database(store->file()), "\n  (DESCRIPTIVE ALGEBRA)\n  (TYPES"));
    A3D_ASSIGN(const auto types, store->types());
    for (const NamedType& type : types) A3D_TRY(file.write("\n    (TYPE ", type.name, " ", type.type.text(), ")"));
    A3D_TRY(file.write(")\n  (OBJECTS\n"));
    A3D_ASSIGN(const auto objects, store->objects());
    ObjectWriter writer(*store, file, context);
    for (const ObjectInfo& info : objects) A3D_TRY(writer.write(info));
    return file.write("  ))\n");
  });
  return status ? file.finish() : status;
}

Status Session::run(const SaveObject& command, Presenter&, Context& context) {
  A3D_ASSIGN(Store * store, required_store());
  A3D_ASSIGN(const algebra3d::OutputPath path, context.resolve_output(command.file));
  A3D_ASSIGN(ListFile file, ListFile::create(path));
  Status status = in_transaction(false, [&]() -> Status {
    A3D_ASSIGN(const auto info, store->find(command.name));
    if (!info) return no_object(command.name, *store);
    A3D_TRY(note_underivable(command.name, context));
    A3D_TRY(file.write(kSavedHere, "\n"));
    return ObjectWriter(*store, file, context).write(*info);
  });
  return status ? file.finish() : status;
}

}  // namespace queries
