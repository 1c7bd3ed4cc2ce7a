#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "queries/shell/detail/completion.h"

struct editline;
struct history;

namespace queries {

/// Reads lines from the terminal with editing, history and completion (libedit; keys as ~/.editrc says, by default
/// those of Emacs). One per process. A line is UTF-8 whatever the locale. Used by one thread.
class LineEditor {
 public:
  /// A function that completes a line at the cursor.
  using Completer = std::function<Completion(std::string_view line, std::size_t cursor)>;
  enum class Event : std::uint8_t {
    line,
    interrupted,  ///< by a signal that `Interruption` has caught; the typed text is discarded
    end,          ///< Ctrl-D on an empty line, or the terminal was closed
  };

  explicit LineEditor(Completer completer);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// Reads one line without its end. A recalled entry of the history may have several lines.
  Event read(const std::string& prompt, std::string& line);
  /// Adds a command to the history of the editor.
  void remember(const std::string& command);

 private:
  struct Callbacks;  // the functions that libedit calls

  /// The function of Tab: inserts the common prefix of the candidates, or shows them.
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
