#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "queries/shell/completion.h"

struct editline;
struct history;

namespace queries {

/// Reads lines from the terminal with editing, history and completion (libedit; keys as ~/.editrc says, by default
/// those of Emacs). One per process, since the terminal is one. A line is UTF-8 whatever the locale. Used by one
/// thread.
class LineEditor {
 public:
  /// How a line can go on at the cursor.
  using Completer = std::function<Completion(std::string_view line, std::size_t cursor)>;
  enum class Event : std::uint8_t {
    line,
    interrupted,  ///< by a signal that `Interruption` has caught; what was typed is gone
    end,          ///< Ctrl-D on an empty line, or the terminal is gone
  };

  explicit LineEditor(Completer completer);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// One line without its end. A recalled entry of the history may have several.
  Event read(const std::string& prompt, std::string& line);
  /// Takes a command as the newest entry of the history that the keys go through.
  void remember(const std::string& command);

 private:
  struct Callbacks;  // of libedit, which knows functions only

  /// What Tab does: go on as far as there is one way, else show the ways.
  unsigned char complete_word();

  struct Closing {
    void operator()(editline* editor) const;
    void operator()(struct history* entries) const;
  };
  Completer completer_;
  std::string prompt_;
  std::unique_ptr<struct history, Closing> history_;
  std::unique_ptr<editline, Closing> editor_;
};

}  // namespace queries
