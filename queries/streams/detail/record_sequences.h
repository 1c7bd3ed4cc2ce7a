#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/context.h"
#include "base/propagate.h"
#include "base/work_memory.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/temporary_file.h"

namespace queries {

/// Sequences of records of one size, which share a temporary file: each is written in blocks, of which only the last
/// one is in memory. Filled first, then read.
template <typename Record>
class RecordSequences {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  class Reader;

  /// Errors: disk_full, io_error.
  static Result<RecordSequences> make(const algebra3d::Context& context, std::size_t records_in_block) {
    const auto folder = context.memory != nullptr ? context.memory->folder() : algebra3d::WorkMemory::default_folder();
    A3D_ASSIGN(auto file, TemporaryFile::make(folder));
    return RecordSequences(std::move(file), records_in_block);
  }

  /// Adds an empty sequence, whose number is that of those before it.
  void add_sequence() { sequences_.emplace_back(); }
  std::size_t count() const { return sequences_.size(); }
  std::size_t size(std::size_t sequence) const {
    return sequences_[sequence].blocks.size() * records_in_block_ + sequences_[sequence].unwritten.size();
  }

  Status append(std::size_t sequence, const Record& record) {
    Sequence& to = sequences_[sequence];
    to.unwritten.push_back(record);
    if (to.unwritten.size() < records_in_block_) return {};
    to.blocks.push_back(file_->size());
    const std::string_view bytes(reinterpret_cast<const char*>(to.unwritten.data()),
                                 records_in_block_ * sizeof(Record));
    to.unwritten.clear();
    return file_->append(bytes);
  }

  Reader read(std::size_t sequence) const { return Reader(*this, sequence); }

 private:
  struct Sequence {
    std::vector<std::uint64_t> blocks;  // where they begin in the file; all are full
    std::vector<Record> unwritten;
  };

  RecordSequences(std::unique_ptr<TemporaryFile> file, std::size_t records_in_block)
      : file_(std::move(file)), records_in_block_(records_in_block) {}

  std::unique_ptr<TemporaryFile> file_;
  std::size_t records_in_block_;
  std::vector<Sequence> sequences_;
};

/// Reads a sequence from its beginning, one block at a time. Nothing may be appended meanwhile.
template <typename Record>
class RecordSequences<Record>::Reader {
 public:
  Reader(const RecordSequences& from, std::size_t sequence)
      : file_(from.file_.get()),
        records_in_block_(from.records_in_block_),
        sequence_(&from.sequences_[sequence]),
        block_(sequence_->blocks.empty() ? 0 : records_in_block_) {}

  /// The next record, until the next call; null at the end.
  Result<const Record*> next() {
    if (position_ == records_.size()) A3D_TRY(begin_block());
    return position_ == records_.size() ? nullptr : &records_[position_++];
  }

 private:
  Status begin_block() {
    position_ = 0;
    records_ = {};
    if (next_block_ > sequence_->blocks.size()) return {};
    if (next_block_ == sequence_->blocks.size()) {
      records_ = sequence_->unwritten;
    } else {
      A3D_TRY(file_->read(sequence_->blocks[next_block_],
                          {reinterpret_cast<char*>(block_.data()), block_.size() * sizeof(Record)}));
      records_ = block_;
    }
    ++next_block_;
    return {};
  }

  const TemporaryFile* file_;
  std::size_t records_in_block_;
  const Sequence* sequence_;
  std::vector<Record> block_;
  std::span<const Record> records_;  // of the block, or of those that were not written
  std::size_t next_block_ = 0, position_ = 0;
};

}  // namespace queries
