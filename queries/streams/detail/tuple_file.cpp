#include "queries/streams/detail/tuple_file.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"
#include "base/work_memory.h"

namespace queries {

using algebra3d::ByteReader;
using algebra3d::ByteWriter;
using algebra3d::Context;

namespace {

// A tuple is its length in bytes (eight of them), its id, and for each attribute a form and what belongs to it. Nobody
// else ever sees the file, so it has no version and no checksums.
enum class Form : std::uint8_t { undefined, integer, real, boolean, encoded, deferred };

constexpr std::size_t kLengthBytes = sizeof(std::uint64_t);

template <typename T>
constexpr bool is_of(const algebra3d::Type& type) {
  return &type == &algebra3d::TypeOf<T>::type();
}

}  // namespace

Result<std::shared_ptr<TupleFile>> TupleFile::make(const Context& context) {
  const auto folder = context.memory != nullptr ? context.memory->folder() : algebra3d::WorkMemory::default_folder();
  A3D_ASSIGN(auto file, TemporaryFile::make(folder));
  return std::shared_ptr<TupleFile>(new TupleFile(std::move(file)));
}

Status TupleFile::append(const Tuple& tuple) {
  if (types_.empty())
    for (const Value& value : tuple.attributes) types_.push_back(&value.type());
  assert(types_.size() == tuple.attributes.size());
  const std::size_t begin = unwritten_.size();
  ByteWriter writer(unwritten_);
  writer.u64(0);
  writer.u64(static_cast<std::uint64_t>(tuple.id));
  for (const Value& value : tuple.attributes) append_value(value);
  const std::uint64_t length = unwritten_.size() - begin - kLengthBytes;
  std::string head;
  ByteWriter(head).u64(length);
  unwritten_.replace(begin, kLengthBytes, head);
  return unwritten_.size() < kBufferBytes ? Status() : flush();
}

void TupleFile::append_value(const Value& value) {
  ByteWriter writer(unwritten_);
  const auto form = [&](Form which) { writer.u8(static_cast<std::uint8_t>(which)); };
  if (!value.is_defined()) return form(Form::undefined);
  if (const auto deferred = value.deferred()) return form(Form::deferred), append_deferred(*deferred);
  if (is_of<std::int64_t>(value.type())) {
    form(Form::integer);
    return writer.u64(static_cast<std::uint64_t>(value.get<std::int64_t>()));
  }
  if (is_of<double>(value.type())) return form(Form::real), writer.f64(value.get<double>());
  if (is_of<bool>(value.type())) return form(Form::boolean), writer.u8(value.get<bool>() ? 1 : 0);
  form(Form::encoded);
  std::string bytes;
  value.type().encode(value, bytes);
  writer.text(bytes);
}

void TupleFile::append_deferred(const algebra3d::DeferredValue& value) {
  const auto source = value.source();
  auto known = std::ranges::find_if(sources_, [&](const auto& each) { return each->is_same_as(*source); });
  if (known == sources_.end()) known = sources_.insert(known, source);
  ByteWriter writer(unwritten_);
  writer.varint(static_cast<std::uint64_t>(known - sources_.begin()));
  std::string reference;
  value.append_reference(reference);
  writer.text(reference);
}

Status TupleFile::flush() {
  A3D_TRY(file_->append(unwritten_));
  if (unwritten_.size() > 4 * kBufferBytes) unwritten_ = std::string();  // of a large tuple
  unwritten_.clear();
  return {};
}

Result<TuplePtr> TupleFile::Scan::next() {
  if (next_ == end_) return TuplePtr();
  A3D_ASSIGN(const std::string_view head, bytes(kLengthBytes));
  const std::uint64_t length = ByteReader(head, "tuple").u64();
  A3D_ASSIGN(const std::string_view body, bytes(length));
  ByteReader reader(body, "tuple");
  auto tuple = std::make_shared<Tuple>();
  tuple->id = static_cast<TupleId>(reader.u64());
  tuple->attributes.reserve(file_->types_.size());
  for (const algebra3d::Type* type : file_->types_) {
    A3D_ASSIGN(Value value, read_value(*type, reader));
    tuple->attributes.push_back(std::move(value));
  }
  return TuplePtr(std::move(tuple));
}

Result<TuplePtr> TupleFile::Scan::at(std::uint64_t position) {
  constexpr std::size_t kFarBytes = 2048;
  const std::uint64_t begin = next_ - position_;  // of the buffer
  if (position >= begin && position < begin + buffer_.size()) {
    position_ = position - begin;
  } else {
    read_ahead_ = position == next_ ? kBufferBytes : kFarBytes;
    buffer_.clear();
    position_ = 0;
  }
  next_ = position;
  return next();
}

/// The next `count` bytes of the file; they live until the next call.
Result<std::string_view> TupleFile::Scan::bytes(std::uint64_t count) {
  if (buffer_.size() - position_ < count) A3D_TRY(refill(count));
  const std::string_view result = std::string_view(buffer_).substr(position_, count);
  position_ += count;
  next_ += count;
  return result;
}

Status TupleFile::Scan::refill(std::uint64_t count) {
  const std::uint64_t wanted = std::min(end_ - next_, std::max<std::uint64_t>(count, read_ahead_));
  if (next_ + wanted > file_->file_->size()) A3D_TRY(file_->flush());
  if (buffer_.capacity() > 4 * wanted) buffer_ = std::string();  // of a large tuple
  buffer_.resize(wanted);
  position_ = 0;
  return file_->file_->read(next_, buffer_);
}

Result<Value> TupleFile::Scan::read_value(const algebra3d::Type& type, ByteReader& reader) const {
  switch (static_cast<Form>(reader.u8())) {
    case Form::undefined:
      return Value(type);
    case Form::integer:
      return Value::of(static_cast<std::int64_t>(reader.u64()));
    case Form::real:
      return Value::of(reader.f64());
    case Form::boolean:
      return Value::of(reader.u8() == 1);
    case Form::encoded:
      return type.decode(reader.text(), true);
    case Form::deferred:
      break;
  }
  const auto& source = file_->sources_[reader.varint()];
  return source->value(reader.text());
}

std::shared_ptr<TupleFile::Scan> TupleFile::scan(std::uint64_t begin, std::uint64_t end) {
  return std::make_shared<Scan>(shared_from_this(), begin, end);
}

}  // namespace queries
