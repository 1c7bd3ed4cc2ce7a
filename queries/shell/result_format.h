#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <string>

#include "queries/shell/exchange_values.h"

namespace queries {

/// How the program shows results, as its options say.
struct ResultFormat {
  std::string name = "auto";  ///< auto, list, table, json, jsonl, csv
  std::string geometry;       ///< summary, list, file; empty: what the folder says
  ExchangeOptions exchange;
  bool omits_header = false;
};

/// Adds --format and the options that go with it.
void add_format_options(CLI::App& app, ResultFormat& format);
/// Throws CLI::ValidationError for options that do not go together.
void check_format_options(const ResultFormat& format);

/// Presents results in one format. Owns the presenter and what it needs; the registry and the stream outlive it.
class FormattedResults {
 public:
  FormattedResults(const ResultFormat& format, const algebra3d::Registry& registry, std::ostream& out);
  Presenter& presenter() { return *presenter_; }

 private:
  ExchangeValues values_;
  std::unique_ptr<Presenter> presenter_;
};

}  // namespace queries
