#pragma once

#include <atomic>
#include <cassert>
#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/context.h"
#include "algebra3d/base/error.h"
#include "algebra3d/types/nested_list.h"

namespace algebra3d {

class Value;

/// What is known of a spatial value without its geometry.
struct GeometryHeader {
  Box3 box;                ///< smallest box of doubles around the exact geometry; empty for an empty value
  std::uint32_t size = 0;  ///< what the operator `size` gives: points or triangles
};

/// A database type: how its values are written, stored, compared. One immutable object per type, for the whole process.
/// Values passed to the members are defined, loaded and of this type.
class Type {
 public:
  enum class Kind : std::uint8_t { data, spatial2d, spatial3d, numeric };
  /// How a relation keeps it: in the columns of a native kind, or as bytes of the codec.
  enum class Storage : std::uint8_t { integer, real, text, bytes };

  virtual ~Type() = default;
  Type(const Type&) = delete;
  Type& operator=(const Type&) = delete;

  virtual std::string_view name() const = 0;
  virtual std::string_view doc() const = 0;       ///< one sentence
  virtual std::string_view notation() const = 0;  ///< the value list, as in "(x y z)"
  virtual std::string_view example() const = 0;   ///< a value list that gives a defined value
  virtual std::vector<Kind> kinds() const = 0;
  static std::string_view kind_name(Kind kind);  ///< as the language writes it
  virtual Storage storage() const = 0;
  /// True for values in the plane or in space: they have a box.
  bool is_spatial() const;

  /// Reads a value list; `undefined` is treated by the caller. Malformed: error invalid_value. Well-formed but no valid
  /// value: undefined, with the reason reported to `context`.
  virtual Result<Value> from_nested(const NestedList& list, Context& context) const = 0;
  virtual NestedList to_nested(const Value& value) const = 0;

  /// The canonical order: equality, order and hash agree with each other.
  virtual std::strong_ordering compare(const Value& a, const Value& b) const = 0;
  virtual std::size_t hash(const Value& value) const = 0;
  /// The beginning of the value in its order: if a < b then order_prefix(a) <= order_prefix(b). 0 says nothing.
  virtual std::uint64_t order_prefix(const Value& /*value*/) const { return 0; }
  /// True if the prefix is the whole value: it is never 0, and equal prefixes mean equal values.
  virtual bool is_whole_in_prefix() const { return false; }

  /// What the value takes on the heap, about; it may share it with others.
  virtual std::size_t heap_bytes(const Value& value) const = 0;

  /// Box and count; only for spatial types.
  virtual GeometryHeader header(const Value& value) const = 0;

  /// Body of the binary form, to which codec.h adds header and checksum; see docs/file_format.md.
  virtual void encode(const Value& value, std::string& bytes) const = 0;
  /// `trusted`: the bytes are our own store's and their checksum was right, so that a proof of validity need not be
  /// repeated. Never crashes on any bytes. Errors: database_corrupt.
  virtual Result<Value> decode(std::string_view bytes, bool trusted) const = 0;

 protected:
  Type() = default;
};

/// What deferred values can be made from again, as long as their statement runs.
class DeferredSource {
 public:
  virtual ~DeferredSource() = default;
  virtual bool is_same_as(const DeferredSource& other) const = 0;
  /// The deferred value whose `append_reference` wrote these bytes.
  virtual Value value(std::string_view reference) const = 0;
};

/// A value that lies elsewhere: its header is at hand, the rest is loaded when first needed.
/// Safe to share between threads. Owned by the values that refer to it.
class DeferredValue {
 public:
  virtual ~DeferredValue() = default;
  virtual GeometryHeader header() const = 0;
  /// The value, read now or taken from a cache.
  virtual Result<Value> load() const = 0;
  /// How to put the value aside without loading it: `source()->value(reference)` is this value again.
  virtual std::shared_ptr<const DeferredSource> source() const = 0;
  virtual void append_reference(std::string& bytes) const = 0;
};

/// The C++ class T of a database type, and the database type of a C++ class: specialised next to each class with
/// `static const Type& type()`.
template <typename T>
struct TypeOf;

/// What values share: an object, and the number of values that refer to it.
struct SharedObject {
  SharedObject() = default;
  virtual ~SharedObject() = default;
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  mutable std::atomic<std::uint64_t> owner_count = 1;
};
template <typename T>
struct SharedObjectOf final : SharedObject {
  explicit SharedObjectOf(T object) : content(std::move(object)) {}

  const T content;
};

/// A value of some database type: defined, undefined, or defined and not yet loaded. Immutable, cheap to copy: three
/// words; bool, int and real lie in it, everything else is shared. A value that was moved from is undefined.
class Value {
 public:
  /// Undefined of a type.
  explicit Value(const Type& type) noexcept : type_(&type) {}
  Value(const Type& type, std::shared_ptr<const DeferredValue> deferred) : type_(&type), form_(Form::deferred) {
    content_.shared = new SharedObjectOf<std::shared_ptr<const DeferredValue>>(std::move(deferred));
  }
  Value(const Value& other) noexcept : type_(other.type_), form_(other.form_), content_(other.content_) {
    if (is_shared()) content_.shared->owner_count.fetch_add(1, std::memory_order_relaxed);
  }
  Value(Value&& other) noexcept
      : type_(other.type_), form_(std::exchange(other.form_, Form::undefined)), content_(other.content_) {}
  Value& operator=(const Value& other) noexcept { return *this = Value(other); }
  Value& operator=(Value&& other) noexcept {
    Value taken(std::move(other));
    std::swap(type_, taken.type_);
    std::swap(form_, taken.form_);
    std::swap(content_, taken.content_);
    return *this;
  }
  ~Value() {
    if (is_shared()) leave();
  }

  /// The value that holds this C++ object; a C++ `int` becomes an int of the language.
  template <typename T>
  static Value of(T content) {
    if constexpr (std::is_same_v<T, int>) {
      return of<std::int64_t>(content);
    } else {
      Value value(TypeOf<T>::type());
      value.take(std::move(content));
      return value;
    }
  }
  template <typename T>
  static Value of(Maybe<T> content) = delete;

  const Type& type() const { return *type_; }
  bool is_defined() const { return form_ != Form::undefined; }
  bool is_deferred() const { return form_ == Form::deferred; }
  /// The deferred content, or null.
  std::shared_ptr<const DeferredValue> deferred() const;

  /// The C++ object of a defined, loaded value of that very type (asserted).
  template <typename T>
  const T& get() const {
    if constexpr (std::is_same_v<T, bool>) {
      return assert(form_ == Form::boolean), content_.boolean;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      return assert(form_ == Form::integer), content_.integer;
    } else if constexpr (std::is_same_v<T, double>) {
      return assert(form_ == Form::real), content_.real;
    } else {
      return assert(form_ == Form::object), static_cast<const SharedObjectOf<T>*>(content_.shared)->content;
    }
  }

  /// This value with its content at hand. Errors: those of the store.
  Result<Value> loaded() const;
  /// Box and count of a defined value of a spatial type; reads no geometry.
  GeometryHeader header() const;

  /// The value list: `undefined`, or what the type prints. Requires a loaded value.
  NestedList to_nested() const;

 private:
  enum class Form : std::uint8_t { undefined, boolean, integer, real, object, deferred };
  union Content {
    std::uint64_t nothing = 0;
    bool boolean;
    std::int64_t integer;
    double real;
    const SharedObject* shared;
  };

  // Of an undefined value.
  template <typename T>
  void take(T content) {
    if constexpr (std::is_same_v<T, bool>) {
      form_ = Form::boolean;
      content_.boolean = content;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      form_ = Form::integer;
      content_.integer = content;
    } else if constexpr (std::is_same_v<T, double>) {
      form_ = Form::real;
      content_.real = content;
    } else {
      content_.shared = new SharedObjectOf<T>(std::move(content));
      form_ = Form::object;
    }
  }

  bool is_shared() const { return form_ >= Form::object; }
  void leave() const noexcept {
    // The analyzer does not follow the atomic count: it takes the last but one owner's content for deleted.
    // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDelete)
    if (content_.shared->owner_count.fetch_sub(1, std::memory_order_acq_rel) == 1) delete content_.shared;
  }
  const std::shared_ptr<const DeferredValue>& deferred_content() const {
    return static_cast<const SharedObjectOf<std::shared_ptr<const DeferredValue>>*>(content_.shared)->content;
  }

  const Type* type_;
  Form form_ = Form::undefined;
  Content content_;
};

/// Order of two loaded values of one type, or of strings and texts; undefined comes first and equals undefined.
std::strong_ordering compare(const Value& a, const Value& b);
std::size_t hash(const Value& value);
/// Of a loaded value: if a < b then order_prefix(a) <= order_prefix(b). 0 if it is undefined.
inline std::uint64_t order_prefix(const Value& value) {
  return value.is_defined() ? value.type().order_prefix(value) : 0;
}
/// What the value takes on the heap, about: that of a deferred one without what it will load.
std::size_t heap_bytes(const Value& value);
/// Reads a value list of `type`, `undefined` included.
Result<Value> value_from_nested(const Type& type, const NestedList& list, Context& context);

}  // namespace algebra3d
