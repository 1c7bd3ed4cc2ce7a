#pragma once

#include <map>
#include <mutex>
#include <utility>

#include "algebra3d/operators/registry/operator.h"

namespace algebra3d::detail {

/// The overloads that operators have made for types that are not registered; they keep their addresses. Thread-safe.
class MadeOverloads {
 public:
  const Overload& find(const Operator& op, const Type& type) {
    const std::lock_guard lock(mutex_);
    const auto [place, is_new] = overloads_.try_emplace({&op, &type});
    if (is_new) place->second = op.overload_for(type);
    return place->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<const Operator*, const Type*>, Overload> overloads_;
};

}  // namespace algebra3d::detail
