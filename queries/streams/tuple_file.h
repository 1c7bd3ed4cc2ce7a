#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "algebra3d/base/context.h"
#include "queries/streams/datum.h"
#include "queries/streams/temporary_file.h"

namespace algebra3d {
class ByteReader;
}

namespace queries {

/// Tuples of one type, put aside in a temporary file in the order in which they come, and read again from any place.
/// Small values are written as they are; values that the database defers stay deferred. A tuple that is read equals the
/// one that was appended, with its id. Owned by those that write and read it, while their statement runs.
class TupleFile : public std::enable_shared_from_this<TupleFile> {
 public:
  class Scan;

  /// In the folder of the context's work memory. Errors: disk_full, io_error.
  static Result<std::shared_ptr<TupleFile>> make(const algebra3d::Context& context);
  TupleFile(const TupleFile&) = delete;
  TupleFile& operator=(const TupleFile&) = delete;

  Status append(const Tuple& tuple);
  /// Where the next tuple will begin.
  std::uint64_t end() const { return file_->size() + unwritten_.size(); }
  /// The tuples from `begin` up to `end`, which are ends of tuples or 0.
  std::shared_ptr<Scan> scan(std::uint64_t begin, std::uint64_t end);

  /// What a scan, or the writing, keeps in memory besides one tuple.
  static constexpr std::size_t kBufferBytes = std::size_t{32} * 1024;

 private:
  explicit TupleFile(std::unique_ptr<TemporaryFile> file) : file_(std::move(file)) {}
  void append_value(const Value& value);
  void append_deferred(const algebra3d::DeferredValue& value);
  Status flush();

  std::unique_ptr<TemporaryFile> file_;
  std::string unwritten_;
  std::vector<const algebra3d::Type*> types_;  // of the attributes, from the first tuple
  std::vector<std::shared_ptr<const algebra3d::DeferredSource>> sources_;
};

/// Reads forward through a buffer.
class TupleFile::Scan final : public TupleStream {
 public:
  Scan(std::shared_ptr<TupleFile> file, std::uint64_t begin, std::uint64_t end)
      : file_(std::move(file)), next_(begin), end_(end) {}
  Result<TuplePtr> next() override;
  /// Where the next tuple begins.
  std::uint64_t position() const { return next_; }

 private:
  Result<std::string_view> bytes(std::uint64_t count);
  Status refill(std::uint64_t count);
  Result<Value> read_value(const algebra3d::Type& type, algebra3d::ByteReader& reader) const;

  std::shared_ptr<TupleFile> file_;
  std::uint64_t next_;  // of the bytes that have not been given out
  std::uint64_t end_;
  std::string buffer_;
  std::size_t position_ = 0;
};

}  // namespace queries
