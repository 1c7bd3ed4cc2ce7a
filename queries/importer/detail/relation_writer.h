#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "queries/importer/detail/file_loader.h"
#include "queries/store/store.h"

namespace queries {

/// The type of a relation of imported solids: Name: string, File: text, Solid: volume3d, Status: text, FacetsDropped:
/// int, and the reals AreaSeen, AreaDropped, AreaAdded, DroppedDistance, AddedDistance, VolumeBefore, VolumeAfter.
TypeExpr import_relation_type();
/// The type that earlier versions created, without the numbers.
TypeExpr earlier_import_relation_type();

/// Writes imported files into a relation in batches. A batch is one transaction of whole files, so that after a crash
/// the database is as after the last complete batch. A file whose path is already in the relation replaces that tuple,
/// which keeps its id; a file that could not be read never does. Used by one thread; the store outlives the writer,
/// which has exclusive use of it. Without `commit` the last batch is rolled back.
class RelationWriter {
 public:
  struct Limits {
    std::chrono::duration<double> time{5};
    double bytes = 256e6;
  };
  enum class Written : std::uint8_t {
    inserted,
    replaced,
    known,  ///< another import has written it; nothing was changed
    kept,   ///< the file could not be read; the tuple of an earlier import was kept
  };

  RelationWriter(Store& store, std::string relation, Limits limits)
      : store_(store), relation_name_(std::move(relation)), limits_(limits) {}
  ~RelationWriter();
  RelationWriter(const RelationWriter&) = delete;
  RelationWriter& operator=(const RelationWriter&) = delete;

  /// Creates the relation if it does not exist. To be called first. Errors: type_error if there is another object of
  /// that name; those of the store.
  Status prepare();
  /// True if `prepare` has created the relation.
  bool is_new() const { return is_new_; }
  /// True if the relation is of an earlier version without the numbers.
  bool lacks_measures() const { return lacks_measures_; }
  /// Whether this path with this content was imported into the relation.
  Result<bool> is_known(const Store::ImportedFile& file);
  /// Writes the file in the current batch.
  Result<Written> write(const LoadedFile& file);
  /// Deletes the tuples whose File satisfies `is_gone`, in the current batch, and forgets that these files were
  /// imported. Returns the number of tuples.
  Result<std::uint64_t> drop(const std::function<bool(const std::string& file)>& is_gone);
  /// Commits the current batch if it has reached a limit.
  Status commit_if_due();
  /// Commits the current batch.
  Status commit();

  std::uint64_t batch_count() const { return batch_count_; }          ///< committed batches with files
  std::uint64_t committed_count() const { return committed_count_; }  ///< files in committed batches
  std::uint64_t pending_count() const { return pending_count_; }      ///< files in the current batch

 private:
  using Clock = std::chrono::steady_clock;
  enum class Mode : std::uint8_t { none, reading, writing };

  Status create_relation();
  Status enter(Mode mode);
  void leave();
  Status find_earlier_tuples();
  Result<Written> put(const LoadedFile& file);

  Store& store_;
  std::string relation_name_;
  Limits limits_;

  bool lacks_measures_ = false;
  bool is_new_ = false;
  Mode mode_ = Mode::none;
  std::shared_ptr<Relation> relation_;  // set while writing
  Clock::time_point batch_start_;
  double batch_bytes_ = 0;
  std::uint64_t pending_count_ = 0;
  std::uint64_t committed_count_ = 0;
  std::uint64_t batch_count_ = 0;

  bool earlier_tuples_found_ = false;
  std::unordered_map<std::string, std::vector<TupleId>> earlier_tuples_;  // by the value of File
};

}  // namespace queries
