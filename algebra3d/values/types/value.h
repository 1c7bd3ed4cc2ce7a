#pragma once

#include <cassert>
#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/base/error.h"
#include "algebra3d/values/types/nested_list.h"
#include "base/context.h"
#include "base/reference_count.h"

namespace algebra3d {

class FaceBlocks;  // face_blocks.h
class TypeExpr;
class Value;

/// The header of a spatial or large value: what is known without the rest.
struct GeometryHeader {
  Box3 box;                ///< smallest box of doubles around the exact geometry; empty for an empty value
  std::uint32_t size = 0;  ///< number of points or triangles (the operator `size`), or of tuples
};

/// A database type: notation, storage and order of its values. One immutable object per type and process. Values passed
/// to the members must be defined, loaded and of this type.
class Type {
 public:
  enum class Kind : std::uint8_t { data, spatial2d, spatial3d, numeric };
  /// The storage in a relation: a column of a native kind, or the bytes of the codec.
  enum class Storage : std::uint8_t { integer, real, text, bytes };

  /// The meaning of the numbers in a value list, which determines how the list changes with the frame of coordinates.
  enum class Coordinates : std::uint8_t {
    none,       ///< numbers that do not depend on the frame, or none
    point,      ///< `(x y z)`
    direction,  ///< `(x y z)`, independent of the origin
    points,     ///< a list of points; their order depends on the frame
    triangles,  ///< a list of triples of points; their order and first corners depend on the frame
    mesh,       ///< `((points) (faces))`, faces as numbers of points
    plane,      ///< `(d nx ny nz)` or `(point normal)`
    box,        ///< bounds along the axes: `(x_min x_max y_min y_max z_min z_max)`
  };

  virtual ~Type() = default;
  Type(const Type&) = delete;
  Type& operator=(const Type&) = delete;

  virtual std::string_view name() const = 0;
  /// The type as a term of the language: its name, or a name with arguments.
  virtual TypeExpr term() const;
  virtual std::string_view doc() const = 0;       ///< one sentence
  virtual std::string_view notation() const = 0;  ///< the value list, as in "(x y z)"
  virtual std::string_view example() const = 0;   ///< the value list of a defined value
  virtual std::vector<Kind> kinds() const = 0;
  static std::string_view kind_name(Kind kind);  ///< the name in the language
  virtual Storage storage() const = 0;
  /// True for values in the plane or in space: they have a box.
  bool is_spatial() const;
  /// True for types with large values: a relation stores them outside the row, which has their header.
  virtual bool is_large() const { return false; }
  /// True for types whose values have a header: those that are spatial or large.
  bool has_header() const { return is_large() || is_spatial(); }
  /// The noun for GeometryHeader::size, in the singular ("triangle"), if tables show values as a summary (count and
  /// box); empty if they show the value list.
  virtual std::string_view summary_unit() const { return {}; }
  virtual Coordinates coordinates() const { return Coordinates::none; }

  /// Reads a value list; the caller handles `undefined`. Malformed lists: error invalid_value. Well-formed but invalid:
  /// undefined, with the reason reported to `context`.
  virtual Result<Value> from_nested(const NestedList& list, Context& context) const = 0;
  virtual NestedList to_nested(const Value& value) const = 0;

  /// The canonical order: equality, order and hash agree with each other.
  virtual std::strong_ordering compare(const Value& a, const Value& b) const = 0;
  virtual std::size_t hash(const Value& value) const = 0;
  /// A prefix of the value for comparisons: if a < b then order_prefix(a) <= order_prefix(b). 0 is always allowed.
  virtual std::uint64_t order_prefix(const Value& /*value*/) const { return 0; }
  /// True if all values with this prefix are equal. 0 is the prefix of undefined.
  virtual bool is_whole_in_prefix(std::uint64_t /*prefix*/) const { return false; }

  /// Estimated heap memory of the value, which other values may share.
  virtual std::size_t heap_bytes(const Value& value) const = 0;

  /// Box and count; only for types with headers.
  virtual GeometryHeader header(const Value& value) const = 0;

  /// Appends the body of the binary form, to which codec.h adds header and checksum; see docs/file_format.md.
  virtual void encode(const Value& value, std::string& bytes) const = 0;
  /// Decodes a body. `trusted`: the bytes come from our own store with a correct checksum, so validity is not proved
  /// again. Safe for any bytes. Errors: database_corrupt.
  virtual Result<Value> decode(std::string_view bytes, bool trusted) const = 0;

 protected:
  Type() = default;
};

/// A source from which deferred values can be restored while their statement runs.
class DeferredSource {
 public:
  virtual ~DeferredSource() = default;
  virtual bool is_same_as(const DeferredSource& other) const = 0;
  /// The deferred value whose `append_reference` wrote these bytes.
  virtual Value value(std::string_view reference) const = 0;
};

/// A deferred value: its header is known, the rest is loaded when first needed. Thread-safe. Owned by the values that
/// refer to it.
class DeferredValue {
 public:
  virtual ~DeferredValue() = default;
  virtual GeometryHeader header() const = 0;
  /// Loads the value, or returns it from a cache.
  virtual Result<Value> load() const = 0;
  /// The faces of a surface or solid in blocks that are read by need; null where loading the value is cheaper, or it
  /// has none. Errors: those of loading.
  virtual Result<std::shared_ptr<const FaceBlocks>> face_blocks() const { return std::shared_ptr<const FaceBlocks>(); }
  /// The source from which the value can be restored without loading it: `source()->value(reference)` is this value.
  virtual std::shared_ptr<const DeferredSource> source() const = 0;
  virtual void append_reference(std::string& bytes) const = 0;
};

/// Maps a C++ class T to its database type; specialised next to each class with `static const Type& type()`.
template <typename T>
struct TypeOf;

/// The shared content of values: an object and its reference count.
struct SharedObject {
  SharedObject() = default;
  virtual ~SharedObject() = default;
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  mutable ReferenceCount<std::uint64_t> owners{1};
};
template <typename T>
struct SharedObjectOf final : SharedObject {
  explicit SharedObjectOf(T object) : content(std::move(object)) {}

  const T content;
};

/// A value of a database type: defined, undefined, or deferred. Immutable, cheap to copy: three words; bool, int and
/// real are stored in place, all others are shared. A moved-from value is undefined.
class Value {
 public:
  /// The undefined value of a type.
  explicit Value(const Type& type) noexcept : type_(&type) {}
  Value(const Type& type, std::shared_ptr<const DeferredValue> deferred) : type_(&type), form_(Form::deferred) {
    content_.shared = new SharedObjectOf<std::shared_ptr<const DeferredValue>>(std::move(deferred));
  }
  Value(const Value& other) noexcept : type_(other.type_), form_(other.form_), content_(other.content_) {
    if (is_shared()) content_.shared->owners.add();
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

  /// A defined value from a C++ object; a C++ `int` becomes an int of the language.
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
  /// A defined value of `type`, one of several types with the same class.
  template <typename T>
  static Value of(const Type& type, T content) {
    Value value(type);
    value.take(std::move(content));
    return value;
  }

  const Type& type() const { return *type_; }
  bool is_defined() const { return form_ != Form::undefined; }
  bool is_deferred() const { return form_ == Form::deferred; }
  /// The deferred content, or null.
  std::shared_ptr<const DeferredValue> deferred() const;

  /// The C++ object of a defined, loaded value of exactly this type (asserted).
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

  /// The loaded value. Errors: those of the store.
  Result<Value> loaded() const;
  /// Box and count of a defined value of a type with headers; does not load geometry.
  GeometryHeader header() const;

  /// The value list, or `undefined`. Requires a loaded value.
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
    if (content_.shared->owners.remove()) delete content_.shared;
  }
  const std::shared_ptr<const DeferredValue>& deferred_content() const {
    return static_cast<const SharedObjectOf<std::shared_ptr<const DeferredValue>>*>(content_.shared)->content;
  }

  const Type* type_;
  Form form_ = Form::undefined;
  Content content_;
};

/// Compares two loaded values of one type, or strings and texts; undefined comes first and equals undefined.
std::strong_ordering compare(const Value& a, const Value& b);
std::size_t hash(const Value& value);
/// Type::order_prefix of a loaded value; 0 if it is undefined.
inline std::uint64_t order_prefix(const Value& value) {
  return value.is_defined() ? value.type().order_prefix(value) : 0;
}
/// Estimated heap memory of the value; for a deferred value without the content to be loaded.
std::size_t heap_bytes(const Value& value);
/// Reads a value list of `type`, `undefined` included.
Result<Value> value_from_nested(const Type& type, const NestedList& list, Context& context);

}  // namespace algebra3d
