#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace algebra3d {

/// The diagnostics of one statement: the reasons of undefined values, and remarks.
///
/// Equal texts are counted, not repeated. Kept are the first places of each text (`kPlacesKept`), the first of the
/// texts that differ only in their numbers (`kAlikeKept`), and the first different texts (`kTextsKept`); the rest is
/// only counted. So memory stays bounded. Texts are in the order of their first report. Concurrent calls are safe.
class Diagnostics {
 public:
  static constexpr std::size_t kPlacesKept = 3;
  static constexpr std::size_t kAlikeKept = 3;
  static constexpr std::size_t kTextsKept = 200;

  struct Entry {
    std::string text;                 ///< the message, without the place
    std::vector<std::string> places;  ///< at most kPlacesKept; empty if no place was given
    std::uint64_t count = 0;
    std::uint64_t alike = 0;  ///< number of reports that differed only in numbers and were not kept
  };

  /// The subject of a report.
  enum class About : std::uint8_t {
    remark,      ///< a remark that concerns no value
    undefined,   ///< the reason of an undefined value
    unreadable,  ///< the same: a file or its content could not be read
    unwritten,   ///< the reason why a file was not written; the value is FALSE
  };

  /// Counts one occurrence of `text` at `place` (file, attribute, coordinate; may be empty).
  void report(std::string text, std::string place = {}, About about = About::remark);
  /// Reports the reason of an undefined value.
  void report_undefined(std::string reason, std::string place = {}) {
    report(std::move(reason), std::move(place), About::undefined);
  }
  /// Increments the counter of `pattern`; the summary has one line per counter. In `pattern` the first `{}` is the
  /// number and the second the `s` of a plural: "{} undefined value{} counted as empty".
  void tally(std::string_view pattern);
  /// Keeps `text` unconditionally: for output that the user asked for.
  void show(std::string text);

  /// The entries so far, in order of first report.
  std::vector<Entry> entries() const;
  /// Number of reports beyond the first kTextsKept different texts.
  std::uint64_t dropped_count() const;
  /// Number of reports of one kind, including those that were not kept.
  std::uint64_t count(About about) const;
  /// The last reason of an undefined value; empty if there is none.
  std::string last_reason() const;
  bool empty() const;
  void clear();

  /// One line per entry, for people: text, places, "and N more"; then one per tally.
  std::vector<std::string> summary() const;

 private:
  struct Kind {
    std::size_t kept = 0;
    std::size_t last = 0;  // the last kept entry
  };
  Entry* entry_of(std::string&& text, Kind* kind);

  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> position_of_;
  std::unordered_map<std::string, Kind> kinds_;  // by the text without its numbers
  std::uint64_t dropped_count_ = 0;
  std::string last_reason_;
  std::map<std::string, std::uint64_t, std::less<>> tallies_;  // by pattern
  std::array<std::uint64_t, 4> counts_ = {};                   // by About
};

}  // namespace algebra3d
