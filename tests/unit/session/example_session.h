#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/operators/descriptions/all.h"
#include "base/propagate.h"
#include "queries/session/session.h"
#include "queries/streams/all.h"

namespace queries {

/// A folder of its own for one test, removed afterwards.
class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "algebra3d-unit-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline const algebra3d::Registry& test_registry() {
  static algebra3d::Registry& registry = *[] {
    auto* made = new algebra3d::Registry(algebra3d::make_registry());
    register_stream_operators(*made);
    return made;
  }();
  return registry;
}

/// Runs commands and gives what they print: the value list, `error: MESSAGE`, or nothing.
class TestSession : public Presenter {
 public:
  explicit TestSession(const std::filesystem::path& folder, const algebra3d::Registry& registry = test_registry(),
                       std::vector<std::filesystem::path> failure_folders = {})
      : session_(registry, {.folder = folder, .failure_folders = std::move(failure_folders)}), folder_(folder) {}

  std::string run(const std::string& command) {
    answer_.clear();
    has_written_ = false;
    diagnostics_.clear();
    Context context{diagnostics_, nullptr, folder_};
    const Status status = session_.execute(command, {"test", 1, 1}, *this, context);
    return status ? answer_ : "error: " + status.error().text();
  }
  std::string notes() const {
    std::string text;
    for (const std::string& line : diagnostics_.summary()) text += line + "\n";
    return text;
  }
  Session& session() { return session_; }
  /// Whether the statement has changed the database, as it was when its result was shown.
  bool has_written() const { return has_written_; }

  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    A3D_ASSIGN(const NestedList list, value_list(type, value, context));
    answer_ = list.print();
    has_written_ = session_.store() != nullptr && session_.store()->has_written();
    return {};
  }
  Status present_inquiry(const NestedList& result) override {
    answer_ = result.print();
    return {};
  }

 private:
  Session session_;
  std::filesystem::path folder_;
  algebra3d::Diagnostics diagnostics_;
  std::string answer_;
  bool has_written_ = false;
};

}  // namespace queries
