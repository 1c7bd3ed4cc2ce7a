#pragma once

#include <utility>

namespace algebra3d {

/// An owning pointer to an object that counts its owners itself (`ReferenceCount`), or null; as large as a plain
/// pointer. Copies share the object. `Object` may be incomplete; in its namespace, or as friends of its class, are
/// declared
///
///     void add_owner(Object& object) noexcept;
///     void remove_owner(Object& object) noexcept;  // the last owner deletes the object
///
/// Thread-safe as std::shared_ptr is: owners of one object may live in different threads. Cost: one count for a copy.
template <typename Object>
class IntrusivePointer {
 public:
  IntrusivePointer() = default;
  explicit IntrusivePointer(Object* object) noexcept : object_(object) {
    if (object_ != nullptr) add_owner(*object_);
  }
  IntrusivePointer(const IntrusivePointer& other) noexcept : IntrusivePointer(other.object_) {}
  IntrusivePointer(IntrusivePointer&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  IntrusivePointer& operator=(const IntrusivePointer& other) noexcept {
    if (this != &other) *this = IntrusivePointer(other);
    return *this;
  }
  IntrusivePointer& operator=(IntrusivePointer&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~IntrusivePointer() {
    if (object_ != nullptr) remove_owner(*object_);
  }

  Object* get() const { return object_; }

 private:
  Object* object_ = nullptr;
};

}  // namespace algebra3d
