#pragma once

#include "queries/store/detail/database.h"

namespace queries {

/// Begins a statement if none is running, and ends it with the scope.
class ReadScope {
 public:
  explicit ReadScope(Database& database) : database_(database), is_own_(!database.is_in_statement()) {
    if (is_own_) status_ = database_.begin(false);
  }
  ~ReadScope() {
    if (is_own_) database_.rollback();
  }
  ReadScope(const ReadScope&) = delete;
  ReadScope& operator=(const ReadScope&) = delete;
  const Status& status() const { return status_; }

 private:
  Database& database_;
  bool is_own_;
  Status status_;
};

}  // namespace queries
