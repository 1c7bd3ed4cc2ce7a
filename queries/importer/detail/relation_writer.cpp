#include "queries/importer/detail/relation_writer.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include "algebra3d/values/types/scalars.h"
#include "base/diagnostics.h"
#include "base/propagate.h"
#include "queries/streams/relation.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {
namespace {

using algebra3d::Text;
using algebra3d::Volume3d;

constexpr std::size_t kFileAttribute = 1;

Value real_or_undefined(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Value::of<double>(*number) : Value(algebra3d::TypeOf<double>::type());
}

Value count_or_undefined(const std::optional<std::uint64_t>& count) {
  return count ? Value::of(static_cast<std::int64_t>(*count)) : Value(algebra3d::TypeOf<std::int64_t>::type());
}

Tuple tuple_of(const LoadedFile& file, bool has_measures) {
  Value solid = file.solid ? Value::of(*file.solid) : Value(algebra3d::TypeOf<Volume3d>::type());
  Tuple tuple{{Value::of(file.name), Value::of(Text{file.path}), std::move(solid), Value::of(Text{file.status})}, 0};
  if (!has_measures) return tuple;
  const algebra3d::ImportMeasures& m = file.measures;
  tuple.attributes.push_back(count_or_undefined(m.facets_dropped));
  for (const auto& number : {m.area_seen, m.area_dropped, m.area_added, m.dropped_distance, m.added_distance,
                             m.volume_before, m.volume_after})
    tuple.attributes.push_back(real_or_undefined(number));
  return tuple;
}

}  // namespace

TypeExpr import_relation_type() {
  return TypeExpr::rel(TypeExpr::tuple({{"Name", "string"},
                                        {"File", "text"},
                                        {"Solid", "volume3d"},
                                        {"Status", "text"},
                                        {"FacetsDropped", "int"},
                                        {"AreaSeen", "real"},
                                        {"AreaDropped", "real"},
                                        {"AreaAdded", "real"},
                                        {"DroppedDistance", "real"},
                                        {"AddedDistance", "real"},
                                        {"VolumeBefore", "real"},
                                        {"VolumeAfter", "real"}}));
}

TypeExpr earlier_import_relation_type() {
  return TypeExpr::rel(
      TypeExpr::tuple({{"Name", "string"}, {"File", "text"}, {"Solid", "volume3d"}, {"Status", "text"}}));
}

RelationWriter::~RelationWriter() {
  leave();
}

Status RelationWriter::prepare() {
  A3D_TRY(enter(Mode::reading));
  A3D_ASSIGN(const auto existing, store_.find(relation_name_));
  leave();
  lacks_measures_ = existing && existing->type == earlier_import_relation_type();
  const TypeExpr type = lacks_measures_ ? existing->type : import_relation_type();
  if (existing && !(existing->type == type))
    return Error{ErrorCode::type_error, "'{}' is of type {}; an import needs {}", relation_name_, existing->type.text(),
                 type.text()};
  if (existing && existing->has_value) return {};
  A3D_TRY(store_.begin(true));
  mode_ = Mode::writing;
  is_new_ = !existing;
  if (is_new_) A3D_TRY(store_.create(relation_name_, type));
  return create_relation();
}

// An object without a value cannot be written to, so the relation begins as an empty one.
Status RelationWriter::create_relation() {
  algebra3d::Diagnostics diagnostics;
  const algebra3d::Context context{.diagnostics = diagnostics, .folder = {}};
  const TypeExpr type = lacks_measures_ ? earlier_import_relation_type() : import_relation_type();
  const auto empty = std::make_shared<MemoryRelation>(type.element(), TupleBuffer(std::vector<TuplePtr>()));
  A3D_TRY(store_.assign(relation_name_, Datum{std::shared_ptr<Relation>(empty)}, context));
  A3D_TRY(store_.commit());
  mode_ = Mode::none;
  return {};
}

// A transaction that has only read cannot always become one that writes (another process may have written meanwhile),
// and it holds nothing that would be lost: it is ended, and a new one begun.
Status RelationWriter::enter(Mode mode) {
  if (mode_ == mode || mode_ == Mode::writing) return {};
  leave();
  A3D_TRY(store_.begin(mode == Mode::writing));
  mode_ = mode;
  if (mode == Mode::reading) return {};
  batch_start_ = Clock::now();
  A3D_ASSIGN(const Datum datum, store_.read(relation_name_));
  relation_ = datum.relation();
  return {};
}

void RelationWriter::leave() {
  if (mode_ == Mode::none) return;
  relation_.reset();
  store_.rollback();
  mode_ = Mode::none;
}

Result<bool> RelationWriter::is_known(const Store::ImportedFile& file) {
  A3D_TRY(enter(Mode::reading));
  return store_.is_imported(relation_name_, file);
}

Result<RelationWriter::Written> RelationWriter::write(const LoadedFile& file) {
  A3D_TRY(enter(Mode::writing));
  if (file.identity) {
    // Asked again where nobody else can write: two imports at the same time take no file twice.
    A3D_ASSIGN(const bool known, store_.is_imported(relation_name_, *file.identity));
    if (known) return Written::known;
  }
  A3D_ASSIGN(const Written written, put(file));
  if (file.identity) A3D_TRY(store_.remember_imported(relation_name_, *file.identity));
  ++pending_count_;
  batch_bytes_ += static_cast<double>(file.size);
  return written;
}

Result<RelationWriter::Written> RelationWriter::put(const LoadedFile& file) {
  A3D_TRY(find_earlier_tuples());
  const auto earlier = earlier_tuples_.find(file.path);
  if (earlier == earlier_tuples_.end()) {
    A3D_TRY(relation_->insert(tuple_of(file, !lacks_measures_)));
    return Written::inserted;
  }
  // A disk that cannot be read today must not cost the solids that were imported yesterday.
  if (!file.identity) return Written::kept;
  const std::vector<TupleId>& ids = earlier->second;
  A3D_TRY(relation_->update(ids.front(), tuple_of(file, !lacks_measures_)));
  for (std::size_t i = 1; i < ids.size(); ++i) A3D_TRY(relation_->erase(ids[i]));
  return Written::replaced;
}

Result<std::uint64_t> RelationWriter::drop(const std::function<bool(const std::string& file)>& is_gone) {
  A3D_TRY(enter(Mode::writing));
  A3D_TRY(find_earlier_tuples());
  std::uint64_t count = 0;
  for (auto entry = earlier_tuples_.begin(); entry != earlier_tuples_.end();) {
    const auto& [file, ids] = *entry;
    if (!is_gone(file)) {
      ++entry;
      continue;
    }
    for (const TupleId id : ids) A3D_TRY(relation_->erase(id));
    A3D_TRY(store_.forget_imported(relation_name_, file));
    count += ids.size();
    entry = earlier_tuples_.erase(entry);
  }
  return count;
}

// One pass before the first file is written, which reads no geometry: so a changed file finds its tuple without an
// index on the attribute. Each file is written once, so that later tuples need not be entered.
Status RelationWriter::find_earlier_tuples() {
  if (earlier_tuples_found_) return {};
  A3D_ASSIGN(const TupleStreamPtr tuples, relation_->scan());
  for (;;) {
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) break;
    A3D_ASSIGN(const Value file, tuple->attributes[kFileAttribute].loaded());
    if (file.is_defined()) earlier_tuples_[file.get<Text>().content].push_back(tuple->id);
  }
  earlier_tuples_found_ = true;
  return {};
}

Status RelationWriter::commit_if_due() {
  if (mode_ != Mode::writing) return {};
  if (batch_bytes_ < limits_.bytes && Clock::now() - batch_start_ < limits_.time) return {};
  return commit();
}

Status RelationWriter::commit() {
  if (mode_ != Mode::writing) {
    leave();
    return {};
  }
  relation_.reset();
  A3D_TRY(store_.commit());
  mode_ = Mode::none;
  if (pending_count_ > 0) ++batch_count_;
  committed_count_ += pending_count_;
  pending_count_ = 0;
  batch_bytes_ = 0;
  return {};
}

}  // namespace queries
