#pragma once

#include <sstream>
#include <string>

#include "queries/exchange/csv_presenter.h"
#include "queries/exchange/json_presenter.h"
#include "unit/session/example_session.h"

namespace queries {

/// What statements print as CSV or JSON; after an error what came before it, and `error: MESSAGE`.
class ExchangeSession {
 public:
  explicit ExchangeSession(ExchangeOptions options = {}) : values_(std::move(options)) {
    EXPECT_EQ(run_silently("create database d"), "");
    EXPECT_EQ(run_silently("open database d"), "");
  }

  /// A command whose result is of no interest.
  std::string run_silently(const std::string& command) {
    std::ostringstream ignored;
    CsvPresenter presenter(ignored, values_);
    return run(command, presenter, ignored).substr(ignored.str().size());
  }
  std::string csv(const std::string& command) {
    std::ostringstream out;
    CsvPresenter presenter(out, values_);
    return run(command, presenter, out);
  }
  std::string json(const std::string& command, JsonPresenter::Layout layout = JsonPresenter::Layout::document) {
    std::ostringstream out;
    JsonPresenter presenter(out, values_, layout);
    return run(command, presenter, out);
  }
  std::string lines(const std::string& command) { return json(command, JsonPresenter::Layout::lines); }
  std::string notes() const {
    std::string text;
    for (const std::string& line : diagnostics_.summary()) text += line + "\n";
    return text;
  }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  std::string run(const std::string& command, Presenter& presenter, std::ostringstream& out) {
    diagnostics_.clear();
    Context context{diagnostics_, nullptr, folder_.path()};
    const Status status = session_.execute(command, {"test", 1, 1}, presenter, context);
    return out.str() + (status ? "" : "error: " + status.error().text());
  }

  TestFolder folder_;
  Session session_{test_registry(), {.folder = folder_.path()}};
  ExchangeValues values_;
  algebra3d::Diagnostics diagnostics_;
};

/// A cube of one unit, of 12 triangles.
constexpr const char* kUnitCube = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";

}  // namespace queries
