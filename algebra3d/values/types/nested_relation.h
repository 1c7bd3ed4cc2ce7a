#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/type_expr.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {

/// The content of a nested relation: a relation that is the value of an attribute. Tuples of loaded values in their
/// order, duplicates included. Immutable; copies share the tuples.
class NestedRelation {
 public:
  /// `values`: loaded, tuple by tuple, `width` of them in each (a whole number of tuples; width > 0).
  NestedRelation(std::size_t width, std::vector<Value> values);

  std::size_t size() const { return content_->size; }
  std::size_t width() const { return content_->width; }
  /// The values of a tuple.
  std::span<const Value> tuple(std::size_t index) const {
    return std::span(content_->values).subspan(index * width(), width());
  }
  /// The indices of the tuples in ascending order. Thread-safe. Cost: the first call sorts.
  const std::vector<std::size_t>& ascending() const;
  /// Estimated heap memory.
  std::size_t heap_bytes() const { return content_->heap_bytes; }

 private:
  struct Content {
    std::size_t width = 0;
    std::size_t size = 0;
    std::size_t heap_bytes = 0;
    std::vector<Value> values;
    std::once_flag is_sorted;
    std::vector<std::size_t> ascending;
  };
  std::shared_ptr<Content> content_;
};

/// A type of nested relations, `arel(tuple([Name: string, ...]))` in the language. Relations are equal if they have the
/// same tuples as often, in whatever order. One with fewer tuples comes before one with more; among equally many, the
/// smallest tuple that one of them has more often decides.
class NestedRelationType final : public DescribedType {
 public:
  struct Attribute {
    std::string name;
    const Type* type = nullptr;
  };

  /// Relations within relations are nested at most that deep; a relation of plain values has depth 1.
  static constexpr std::size_t kMaxDepth = 16;
  static constexpr std::size_t kMaxTuples = 0xFFFF'FFFF;

  /// The type of nested relations of these tuples: one object per process for each tuple type, never destroyed. Errors:
  /// type_error for an attribute that is not a value, or no attribute at all; limit_exceeded beyond kMaxDepth.
  static Result<const NestedRelationType*> of(const TypeExpr& tuple);

  TypeExpr term() const override { return term_; }
  const TypeExpr& tuple() const { return term_.element(); }
  const std::vector<Attribute>& attributes() const { return attributes_; }
  std::size_t depth() const { return depth_; }

  /// A nested relation of this type from loaded values of its attributes, tuple by tuple. Errors: limit_exceeded beyond
  /// kMaxTuples.
  Result<Value> value_of(std::vector<Value> values) const;

  Result<Value> from_nested(const NestedList& list, Context& context) const override;
  NestedList to_nested(const Value& value) const override;
  std::strong_ordering compare(const Value& a, const Value& b) const override;
  std::size_t hash(const Value& value) const override;
  std::size_t heap_bytes(const Value& value) const override;
  /// The number of tuples as size; no box.
  GeometryHeader header(const Value& value) const override;
  void encode(const Value& value, std::string& bytes) const override;
  Result<Value> decode(std::string_view bytes, bool trusted) const override;

 private:
  NestedRelationType(TypeExpr term, std::vector<Attribute> attributes, std::size_t depth);
  Error at(std::size_t value_index, Error error) const;

  TypeExpr term_;
  std::vector<Attribute> attributes_;
  std::size_t depth_;
};

/// The type of nested relations that `type` is, or null.
const NestedRelationType* as_nested_relation(const Type& type);

/// The object of a type of values: one of `all_types()`, or of nested relations. Null for every other term.
const Type* value_type(const TypeExpr& term);

}  // namespace algebra3d
