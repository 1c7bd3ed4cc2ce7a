// The commands of a session that save a database or an object as a nested list. The text is written object by object
// and tuple by tuple, first under another name, so that a failure leaves what was there.
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "queries/session/objects.h"
#include "queries/session/saved_list.h"
#include "queries/session/session.h"
#include "queries/streams/ordered_index.h"

namespace queries {
namespace {

class ListFile {
 public:
  explicit ListFile(std::filesystem::path file)
      : file_(std::move(file)), interim_(file_.string() + ".new-" + std::to_string(getpid())), out_(interim_) {}
  ~ListFile() {
    std::error_code ignored;
    std::filesystem::remove(interim_, ignored);
  }
  ListFile(const ListFile&) = delete;
  ListFile& operator=(const ListFile&) = delete;

  std::ofstream& out() { return out_; }
  Status check() const {
    if (out_) return {};
    return Error{ErrorCode::io_error, "save: {} cannot be written: {}", file_.string(), std::strerror(errno)};
  }
  Status finish() {
    out_.close();
    RETURN_IF_ERROR(check());
    std::error_code error;
    std::filesystem::rename(interim_, file_, error);
    if (error) return Error{ErrorCode::io_error, "save: {} cannot be written: {}", file_.string(), error.message()};
    return {};
  }

 private:
  std::filesystem::path file_;
  std::filesystem::path interim_;
  std::ofstream out_;
};

class ObjectWriter {
 public:
  ObjectWriter(Store& store, ListFile& file, Context& context) : store_(store), file_(file), context_(context) {}

  Status write(const ObjectInfo& info) {
    RETURN_IF_ERROR(context_.check_cancelled());
    if (!info.derived_text.empty()) {
      file_.out() << "    (DERIVED " << info.name << " " << info.derived_text << ")\n";
      return file_.check();
    }
    file_.out() << "    (OBJECT " << info.name << " () " << info.type.text();
    if (info.has_value) RETURN_IF_ERROR(write_value(info));
    file_.out() << ")\n";
    return file_.check();
  }

 private:
  Status write_value(const ObjectInfo& info) {
    if (info.type.is_function()) {
      file_.out() << " " << info.function_text << " ()";
      return {};
    }
    ASSIGN_OR_RETURN(const Datum value, store_.read(info.name));
    if (info.type.is_relation()) return write_relation(*value.relation());
    if (info.type.is("rtree3")) return write_index(info, *value.index(), "creatertree");
    if (info.type.is("btree")) return write_index(info, *value.ordered_index(), "createbtree");
    ASSIGN_OR_RETURN(const Value loaded, value.value().loaded());
    file_.out() << " " << loaded.to_nested().print() << " ()";
    return {};
  }

  Status write_relation(Relation& relation) {
    file_.out() << " (";
    ASSIGN_OR_RETURN(const TupleStreamPtr tuples, relation.scan());
    while (true) {
      RETURN_IF_ERROR(context_.check_cancelled());
      ASSIGN_OR_RETURN(const TuplePtr tuple, tuples->next());
      if (tuple == nullptr) break;
      file_.out() << "\n      (";
      for (std::size_t index = 0; index < tuple->attributes.size(); ++index) {
        ASSIGN_OR_RETURN(const Value loaded, tuple->attributes[index].loaded());
        file_.out() << (index > 0 ? " " : "") << loaded.to_nested().print();
      }
      file_.out() << ")";
      RETURN_IF_ERROR(file_.check());
    }
    file_.out() << ") ()";
    return {};
  }

  // An index is saved as the expression that makes it: its boxes lie in the relation.
  template <typename Index>
  Status write_index(const ObjectInfo& info, const Index& index, std::string_view maker) {
    if (index.is_definition()) {
      file_.out() << " (" << maker << " " << index.relation() << " " << index.attribute() << ") ()";
      return {};
    }
    context_.diagnostics.report(
        "save: '" + info.name +
        "' is a copy of a stream, with tuple numbers that mean nothing elsewhere; it is saved without a value");
    return {};
  }

  Store& store_;
  ListFile& file_;
  Context& context_;
};

}  // namespace

Status Session::run(const SaveDatabase& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  ListFile file(context.resolve(command.file));
  RETURN_IF_ERROR(file.check());
  Status status = in_transaction(false, [&]() -> Status {
    file.out() << kSavedHere << "\n(DATABASE " << store->file().stem().string()
               << "\n  (DESCRIPTIVE ALGEBRA)\n  (TYPES";
    ASSIGN_OR_RETURN(const auto types, store->types());
    for (const NamedType& type : types) file.out() << "\n    (TYPE " << type.name << " " << type.type.text() << ")";
    file.out() << ")\n  (OBJECTS\n";
    ASSIGN_OR_RETURN(const auto objects, store->objects());
    ObjectWriter writer(*store, file, context);
    for (const ObjectInfo& info : objects) RETURN_IF_ERROR(writer.write(info));
    file.out() << "  ))\n";
    return {};
  });
  return status ? file.finish() : status;
}

Status Session::run(const SaveObject& command, Presenter&, Context& context) {
  ASSIGN_OR_RETURN(Store * store, required_store());
  ListFile file(context.resolve(command.file));
  RETURN_IF_ERROR(file.check());
  Status status = in_transaction(false, [&]() -> Status {
    ASSIGN_OR_RETURN(const auto info, store->find(command.name));
    if (!info) return Error{ErrorCode::unknown_name, "there is no object '{}'", command.name};
    file.out() << kSavedHere << "\n";
    return ObjectWriter(*store, file, context).write(*info);
  });
  return status ? file.finish() : status;
}

}  // namespace queries
