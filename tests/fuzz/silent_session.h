#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "base/propagate.h"
#include "queries/session/session.h"

namespace queries::fuzz {

/// A session that gives what a command prints as a text: the result list, or "error: MESSAGE".
class SilentSession final : public Presenter {
 public:
  /// `cancel` may be null.
  SilentSession(const algebra3d::Registry& registry, const std::filesystem::path& folder,
                const std::atomic<bool>* cancel)
      : session_(registry, {folder, false}), folder_(folder), cancel_(cancel) {}

  std::string run(const std::string& command) { return run(command, cancel_); }
  /// Runs a command, also when the time is over.
  std::string run_to_the_end(const std::string& command) { return run(command, nullptr); }
  Store* store() { return session_.store(); }

  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    A3D_ASSIGN(const NestedList list, result_list(type, value, context));
    answer_ = list.print();
    return {};
  }
  Status present_inquiry(const NestedList& result) override {
    answer_ = result.print();
    return {};
  }

 private:
  std::string run(const std::string& command, const std::atomic<bool>* cancel) {
    answer_.clear();
    algebra3d::Diagnostics diagnostics;
    Context context{diagnostics, cancel, folder_};
    const Status status = session_.execute(command, {"fuzz", 1, 1}, *this, context);
    return status ? answer_ : "error: " + status.error().text();
  }

  Session session_;
  std::filesystem::path folder_;
  const std::atomic<bool>* cancel_;
  std::string answer_;
};

}  // namespace queries::fuzz
