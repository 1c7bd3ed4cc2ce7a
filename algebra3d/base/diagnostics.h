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

/// Diagnostics of one statement: the reasons why values became undefined, and remarks that change no value.
///
/// Equal texts are counted, not repeated: per text the first places are kept (`kPlacesKept`), of texts that differ only
/// in their numbers the first `kAlikeKept`, of all others the first `kTextsKept`; the rest is only counted. So memory
/// stays bounded however long a statement runs. All members may be called by several threads at once; the order of
/// texts is that of their first report.
class Diagnostics {
 public:
  static constexpr std::size_t kPlacesKept = 3;
  static constexpr std::size_t kAlikeKept = 3;
  static constexpr std::size_t kTextsKept = 200;

  struct Entry {
    std::string text;                 ///< what happened, without the place
    std::vector<std::string> places;  ///< where: at most kPlacesKept, empty if no place was given
    std::uint64_t count = 0;
    std::uint64_t alike = 0;  ///< reports that differed from this one only in numbers, and were not kept
  };

  /// The subject of a report.
  enum class About : std::uint8_t {
    remark,      ///< something to know; no value is other than it was asked for
    undefined,   ///< why a value is undefined
    unreadable,  ///< the same: what stands in a file, or the file itself, gives no value
    unwritten,   ///< why a file was not written; the value is FALSE
  };

  /// Counts one occurrence of `text` at `place` (file, attribute, coordinate; may be empty).
  void report(std::string text, std::string place = {}, About about = About::remark);
  /// `report` of why a value is undefined.
  void report_undefined(std::string reason, std::string place = {}) {
    report(std::move(reason), std::move(place), About::undefined);
  }
  /// Counts one more of what a statement met; the summary has one line with the number. In `pattern` the first `{}`
  /// stands for the number and the second for the `s` of a plural: "{} undefined value{} counted as empty".
  void tally(std::string_view pattern);
  /// Keeps `text` as it is, whatever numbers others have: for what the user asked to see.
  void show(std::string text);

  /// The entries so far, in order of first report.
  std::vector<Entry> entries() const;
  /// Occurrences of texts beyond the first kTextsKept different ones.
  std::uint64_t dropped_count() const;
  /// Reports of one kind, with those whose text was not kept.
  std::uint64_t count(About about) const;
  bool empty() const;
  void clear();

  /// One line per entry, as people read it: text, places, "and N more"; then one per tally.
  std::vector<std::string> summary() const;

 private:
  struct Kind {
    std::size_t kept = 0;
    std::size_t last = 0;  // the entry that was kept last
  };
  Entry* entry_of(std::string&& text, Kind* kind);

  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, std::size_t> position_of_;
  std::unordered_map<std::string, Kind> kinds_;  // by the text without its numbers
  std::uint64_t dropped_count_ = 0;
  std::map<std::string, std::uint64_t, std::less<>> tallies_;  // by pattern
  std::array<std::uint64_t, 4> counts_ = {};                   // by what a report is about
};

}  // namespace algebra3d
