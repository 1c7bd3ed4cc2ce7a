#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <string>

#include "queries/exchange/exchange_values.h"

namespace queries {

/// The options for the format of results.
struct ResultFormat {
  std::string name = "auto";  ///< auto, list, table, json, jsonl, csv
  std::string geometry;       ///< summary, list, file; empty: file if a folder is given
  ExchangeOptions exchange;
  bool omits_header = false;
};

/// Adds --format and related options.
void add_format_options(CLI::App& app, ResultFormat& format);
/// Throws CLI::ValidationError for options that exclude each other.
void check_format_options(const ResultFormat& format);

/// Presents results in one format. Owns the presenter; the stream outlives it.
class FormattedResults {
 public:
  FormattedResults(const ResultFormat& format, std::ostream& out);
  Presenter& presenter() { return *presenter_; }

 private:
  ExchangeValues values_;
  std::unique_ptr<Presenter> presenter_;
};

}  // namespace queries
