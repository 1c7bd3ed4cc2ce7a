#include "queries/shell/detail/line_editor.h"

#include <histedit.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cwchar>

#include "queries/shell/detail/command_history.h"
#include "queries/shell/detail/interruption.h"
#include "queries/shell/detail/screen.h"

namespace queries {
namespace {

constexpr std::size_t kMostShown = 200;

volatile std::sig_atomic_t is_continued = 0;

extern "C" void on_continue(int) {
  is_continued = 1;
}

// The candidates side by side, as `ls` shows files. Of paths the last part is enough.
std::string columns(const std::vector<Candidate>& candidates, std::size_t screen_columns) {
  std::vector<std::string> names;
  std::size_t width = 0;
  for (std::size_t i = 0; i < std::min(candidates.size(), kMostShown); ++i) {
    const std::string& text = candidates[i].text;
    const std::size_t slash = text.rfind('/', text.size() < 2 ? 0 : text.size() - 2);
    names.push_back(printable(slash == std::string::npos ? text : text.substr(slash + 1)));
    width = std::max(width, display_width(names.back()) + 2);
  }
  const std::size_t per_row = std::max<std::size_t>(1, screen_columns / std::max<std::size_t>(width, 1));
  const std::size_t row_count = (names.size() + per_row - 1) / per_row;
  std::string text;
  for (std::size_t row = 0; row < row_count; ++row) {
    for (std::size_t i = row; i < names.size(); i += row_count)
      text += names[i] + (i + row_count < names.size() ? std::string(width - display_width(names[i]), ' ') : "");
    text += "\n";
  }
  if (candidates.size() > kMostShown) text += "... and " + std::to_string(candidates.size() - kMostShown) + " more\n";
  return text;
}

// Waits for a byte. The signals that end an input are let through in the wait alone, so that none comes unnoticed
// between looking at the flag and waiting.
enum class Waited : std::uint8_t { ready, interrupted, continued };

Waited wait_for_input() {
  sigset_t caught;
  sigset_t before;
  sigemptyset(&caught);
  for (const int signal : {SIGINT, SIGTERM, SIGCONT}) sigaddset(&caught, signal);
  pthread_sigmask(SIG_BLOCK, &caught, &before);
  Waited result = Waited::ready;
  while (true) {
    if (Interruption::flag().load()) {
      result = Waited::interrupted;
      break;
    }
    if (is_continued != 0) {
      is_continued = 0;
      result = Waited::continued;
      break;
    }
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (ppoll(&input, 1, nullptr, &before) >= 0 || errno != EINTR) break;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return result;
}

}  // namespace

struct LineEditor::Callbacks {
  static LineEditor& self(EditLine* editor) {
    void* data = nullptr;
    el_get(editor, EL_CLIENTDATA, &data);
    return *static_cast<LineEditor*>(data);
  }

  static char* prompt(EditLine* editor) { return self(editor).prompt_.data(); }

  static unsigned char complete(EditLine* editor, int) { return self(editor).complete_word(); }

  // One character from the terminal: 1, or 0 at the end.
  static int read_character(EditLine* editor, wchar_t* character) {
    std::mbstate_t state{};
    while (true) {
      const Waited waited = wait_for_input();
      if (waited == Waited::interrupted) return 0;
      if (waited == Waited::continued) {
        // Another program has had the terminal since the job was stopped.
        el_set(editor, EL_PREP_TERM, 0);
        el_set(editor, EL_PREP_TERM, 1);
        el_set(editor, EL_REFRESH);
        continue;
      }
      char byte = 0;
      const ssize_t count = ::read(STDIN_FILENO, &byte, 1);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return 0;
      std::size_t length = std::mbrtowc(character, &byte, 1, &state);
      if (length == static_cast<std::size_t>(-1)) {
        // The byte does not go on with a character that was begun; it may begin another one.
        state = {};
        length = std::mbrtowc(character, &byte, 1, &state);
        if (length == static_cast<std::size_t>(-1)) state = {};
      }
      if (length <= 1) return 1;
    }
  }
};

void LineEditor::Closing::operator()(editline* editor) const {
  el_end(editor);
}

void LineEditor::Closing::operator()(struct history* entries) const {
  history_end(entries);
}

LineEditor::LineEditor(Completer completer) : completer_(std::move(completer)) {
  // libedit reads and prints characters of the locale; ours are those of UTF-8.
  std::setlocale(LC_CTYPE, "");                             // NOLINT(concurrency-mt-unsafe)
  if (MB_CUR_MAX < 4) std::setlocale(LC_CTYPE, "C.UTF-8");  // NOLINT(concurrency-mt-unsafe)
  struct sigaction action = {};
  action.sa_handler = on_continue;
  sigaction(SIGCONT, &action, nullptr);

  history_.reset(history_init());
  HistEvent event{};
  ::history(history_.get(), &event, H_SETSIZE, static_cast<int>(CommandHistory::kMostEntries));
  ::history(history_.get(), &event, H_SETUNIQUE, 1);

  editor_.reset(el_init("algebra3d", stdin, stdout, stderr));
  EditLine* editor = editor_.get();
  el_set(editor, EL_CLIENTDATA, this);
  el_set(editor, EL_PROMPT, &Callbacks::prompt);
  el_set(editor, EL_EDITOR, "emacs");
  el_set(editor, EL_SIGNAL, 0);
  el_set(editor, EL_HIST, ::history, history_.get());
  el_wset(editor, EL_GETCFN, &Callbacks::read_character);
  // Of narrow names libedit makes copies that it never frees.
  el_wset(editor, EL_ADDFN, L"complete-word", L"Complete the word before the cursor", &Callbacks::complete);
  el_set(editor, EL_BIND, "^I", "complete-word", nullptr);
  // Keys that people are used to elsewhere and libedit leaves unbound.
  el_set(editor, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  el_set(editor, EL_BIND, "^S", "em-inc-search-next", nullptr);
  el_set(editor, EL_BIND, "\\e[1~", "ed-move-to-beg", nullptr);
  el_set(editor, EL_BIND, "\\e[4~", "ed-move-to-end", nullptr);
  el_set(editor, EL_BIND, "\\e[3~", "ed-delete-next-char", nullptr);
  el_set(editor, EL_BIND, "\\e[H", "ed-move-to-beg", nullptr);
  el_set(editor, EL_BIND, "\\e[F", "ed-move-to-end", nullptr);
  el_set(editor, EL_BIND, "\\e[1;5C", "em-next-word", nullptr);
  el_set(editor, EL_BIND, "\\e[1;5D", "ed-prev-word", nullptr);
  el_source(editor, nullptr);
}

LineEditor::~LineEditor() = default;

LineEditor::Event LineEditor::read(const std::string& prompt, std::string& line) {
  prompt_ = prompt;
  el_resize(editor_.get());
  // libedit itself does this after the prompt, and a key such as Ctrl-R that comes in between is lost.
  el_set(editor_.get(), EL_PREP_TERM, 1);
  int count = 0;
  const char* typed = el_gets(editor_.get(), &count);
  if (Interruption::flag().load()) return Event::interrupted;
  if (typed == nullptr || count <= 0) return Event::end;
  line.assign(typed, static_cast<std::size_t>(count));
  if (line.ends_with('\n')) line.pop_back();
  return Event::line;
}

void LineEditor::remember(const std::string& command) {
  HistEvent event{};
  ::history(history_.get(), &event, H_ENTER, command.c_str());
}

unsigned char LineEditor::complete_word() {
  const LineInfo* info = el_line(editor_.get());
  const std::string_view line(info->buffer, static_cast<std::size_t>(info->lastchar - info->buffer));
  const auto cursor = static_cast<std::size_t>(info->cursor - info->buffer);
  const Completion completion = completer_(line, cursor);
  const auto& candidates = completion.candidates;
  if (candidates.empty()) return CC_REFRESH_BEEP;
  std::string word = common_beginning(candidates);
  if (candidates.size() == 1) word += candidates.front().suffix;
  const std::string missing = word.substr(std::min(cursor - completion.begin, word.size()));
  if (!missing.empty()) return el_insertstr(editor_.get(), missing.c_str()) == 0 ? CC_REFRESH : CC_REFRESH_BEEP;
  if (candidates.size() == 1) return CC_NORM;
  const std::string shown = "\n" + columns(candidates, screen_size().columns);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
  return CC_REDISPLAY;
}

}  // namespace queries
