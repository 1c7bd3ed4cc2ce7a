// The shell as a person has it: on a pseudo-terminal. Waits for texts and never for times; the limit is for a shell
// that hangs.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "queries/shell/program.h"

namespace queries {
namespace {

constexpr std::chrono::seconds kLimit{180};
const std::string kCtrlC = "\x03";
const std::string kCtrlD = "\x04";
const std::string kCtrlR = "\x12";
const std::string kUp = "\x1b[A";
const std::string kPrompt = "algebra3d> ";
const std::string kContinuation = "      ...> ";

/// A shell that runs in a process of its own on a terminal of 24 rows and 100 columns, with `folder` as its home.
class Shell {
 public:
  Shell(const std::filesystem::path& folder, std::vector<std::string> arguments, const std::string& pager = {},
        rlim_t stack_bytes = 0) {
    arguments.insert(arguments.begin(), "algebra3d");
    winsize size{24, 100, 0, 0};
    process_ = forkpty(&terminal_, nullptr, nullptr, &size);
    if (process_ != 0) return;
    // Terminals say that they speak UTF-8; a key that comes before the prompt reads is then erased as a character.
    termios modes{};
    tcgetattr(STDIN_FILENO, &modes);
    modes.c_iflag |= IUTF8;
    tcsetattr(STDIN_FILENO, TCSANOW, &modes);
    setenv("HOME", folder.c_str(), 1);
    setenv("TERM", "xterm", 1);
    setenv("PAGER", pager.empty() ? ("cat > '" + (folder / "paged").string() + "'").c_str() : pager.c_str(), 1);
    unsetenv("XDG_STATE_HOME");
    const rlimit stack{stack_bytes, stack_bytes};
    if (stack_bytes > 0) setrlimit(RLIMIT_STACK, &stack);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    const int status =
        chdir(folder.c_str()) == 0 ? run_program(static_cast<int>(pointers.size()), pointers.data()) : 99;
    _exit(status);
  }
  ~Shell() {
    close(terminal_);
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  void send(const std::string& keys) const {
    ASSERT_EQ(write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// Reads until `text` comes, and steps over it; gives what stood before it.
  std::string wait_for(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + kLimit;
    while (true) {
      if (const std::size_t found = unread_.find(text); found != std::string::npos) {
        std::string before = unread_.substr(0, found);
        unread_.erase(0, found + text.size());
        return before;
      }
      pollfd ready{terminal_, POLLIN, 0};
      char bytes[4096];
      if (std::chrono::steady_clock::now() > end || poll(&ready, 1, 1000) < 0) break;
      if (ready.revents == 0) continue;
      const ssize_t count = read(terminal_, bytes, sizeof bytes);
      if (count <= 0) break;
      unread_.append(bytes, static_cast<std::size_t>(count));
    }
    ADD_FAILURE() << "expected '" << text << "', found: " << unread_;
    // What comes after would wait in vain, each time up to the limit.
    if (process_ > 0) kill(process_, SIGKILL);
    return {};
  }
  /// Types a line at the prompt.
  void type(const std::string& keys) {
    wait_for(kPrompt);
    send(keys);
  }
  void terminate() const { kill(process_, SIGTERM); }
  // What the shell still writes is read meanwhile, since its end waits until its output has gone.
  int exit_status() {
    int status = 0;
    char bytes[4096];
    const auto end = std::chrono::steady_clock::now() + kLimit;
    for (pollfd ready{terminal_, POLLIN, 0}; poll(&ready, 1, 1000) >= 0;) {
      if (std::chrono::steady_clock::now() > end) {
        ADD_FAILURE() << "the shell did not end; unread: " << unread_;
        kill(process_, SIGKILL);
        break;
      }
      if (ready.revents == 0) continue;
      const ssize_t count = read(terminal_, bytes, sizeof bytes);
      if (count <= 0) break;
      unread_.append(bytes, static_cast<std::size_t>(count));
    }
    EXPECT_EQ(waitpid(process_, &status, 0), process_);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  int terminal_ = -1;
  pid_t process_ = 0;
  std::string unread_;
};

class Terminal : public testing::Test {
 protected:
  Terminal() {
    std::string name = testing::TempDir() + "terminal-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~Terminal() override { std::filesystem::remove_all(folder_); }

  std::string content(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
};

TEST_F(Terminal, banner_tells_the_next_step_and_quit_leaves) {
  Shell shell(folder_, {});
  shell.wait_for("No database is open: try `create database parts; open database parts;`");
  shell.type("query 41000 + 273;\n");
  shell.wait_for("\n41273\r\n");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, help_also_explains_the_commands_of_the_command_line) {
  for (const std::string command : {"import", "test", "check", "repair", "convert"}) {
    Shell shell(folder_, {"help", command});
    shell.wait_for("Usage: ");
    EXPECT_EQ(shell.exit_status(), 0);
  }
  {
    Shell shell(folder_, {});
    shell.type("set \"paging\" = FALSE;\nhelp import\n");
    shell.wait_for("--relation");
    shell.type("exit\n");
    EXPECT_EQ(shell.exit_status(), 0);
  }
  Shell shell(folder_, {"help", "no_such_thing"});
  shell.wait_for("error: there is no operator or command 'no_such_thing'");
  EXPECT_EQ(shell.exit_status(), 2);
}

TEST_F(Terminal, banner_counts_the_objects_of_the_database) {
  {
    Shell shell(folder_, {"--db", "parts.db"});
    shell.wait_for("The database parts.db is empty: try `let Cube = ");
    shell.type("let A = 1; let B = 2;\n");
    shell.type("quit\n");
    EXPECT_EQ(shell.exit_status(), 0);
  }
  Shell shell(folder_, {"--db", "parts.db"});
  shell.wait_for("The database parts.db has 2 objects: `list objects;` shows them.");
  shell.type("list objects;\n");
  shell.wait_for("A    | int\r\nB    | int\r\n");
  shell.type("quit\n");
}

TEST_F(Terminal, history_is_kept_between_sessions_with_a_command_of_several_lines_as_one_entry) {
  {
    Shell shell(folder_, {});
    shell.type("query 41000 +\n");
    shell.wait_for(kContinuation);
    shell.send("273;\n");
    shell.wait_for("\n41273\r\n");
    shell.type("query 52000 + 11;\n");
    shell.wait_for("\n52011\r\n");
    shell.type("quit\n");
    EXPECT_EQ(shell.exit_status(), 0);
  }
  EXPECT_EQ(content(".local/state/algebra3d/history"), "query 41000 +\\n273;\nquery 52000 + 11;\nquit\n");
  Shell shell(folder_, {});
  shell.type(kUp + kUp + "\n");
  shell.wait_for("\n52011\r\n");
  shell.type(kUp + kUp + kUp + kUp + "\n");
  shell.wait_for("\n41273\r\n");
  shell.type(kCtrlR + "11;");
  shell.wait_for("52000");
  shell.send("\n\n");
  shell.wait_for("\n52011\r\n");
  shell.type("quit\n");
}

TEST_F(Terminal, tab_completes_commands_operators_objects_attributes_and_files) {
  std::ofstream(folder_ / "answers.q") << "query 60000 + 61;\n";
  Shell shell(folder_, {"--db", "parts.db"});
  shell.type("let Bolts = intstream(1, 3) transformstream extend[Weight: 20000 + .Elem] consume;\n");
  // The operators bring their brackets.
  shell.type("que\tBol\tfe\t filt\t.Wei\t > 0] extr\tWei\t];\n");
  shell.wait_for("\n20001\r\n");
  shell.type("@ans\t\n");
  shell.wait_for("\n60061\r\n");
  shell.type("help changen\t\n");
  shell.wait_for("Give an object another name");
  shell.type("list o\t");
  shell.wait_for("objects");
  shell.wait_for("operators");
  shell.wait_for("list o");
  shell.send(kCtrlC);
  shell.wait_for("^C\r\n");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, ctrl_c_drops_what_is_being_typed_and_not_the_shell) {
  Shell shell(folder_, {});
  shell.type("query 1 +");
  shell.wait_for("query 1 +");
  shell.send(kCtrlC);
  shell.wait_for("^C\r\n");
  shell.type("query (\n");
  shell.wait_for(kContinuation);
  shell.send(kCtrlC);
  shell.wait_for("^C\r\n");
  shell.type("query 41000 + 273;\n");
  shell.wait_for("\n41273\r\n");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, ctrl_c_ends_a_long_statement_and_not_the_shell) {
  Shell shell(folder_, {});
  shell.type("query intstream(1, 2000000000) count;\n");
  shell.wait_for("query intstream(1, 2000000000) count: running for ");
  shell.send(kCtrlC);
  shell.wait_for("\r\n");  // behind ^C
  EXPECT_TRUE(shell.wait_for("error: interrupted").starts_with("input:1:"));
  shell.type("query 41000 + 273;\n");
  shell.wait_for("\n41273\r\n");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, ctrl_d_on_an_empty_line_leaves) {
  Shell shell(folder_, {});
  shell.type(kCtrlD);
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, sigterm_ends_the_prompt) {
  Shell shell(folder_, {});
  shell.type("query 41000 + 273;\n");
  shell.wait_for("\n41273\r\n");
  shell.wait_for(kPrompt);
  shell.terminate();
  EXPECT_EQ(shell.exit_status(), 130);
}

TEST_F(Terminal, a_long_result_goes_through_the_pager_unless_paging_is_off) {
  Shell shell(folder_, {});
  const std::string query = "query intstream(100, 130) transformstream consume;\n";
  shell.type(query);
  const std::string shown = shell.wait_for(kPrompt);
  EXPECT_EQ(shown.find("(31 tuples)"), std::string::npos) << shown;
  EXPECT_NE(content("paged").find("(31 tuples)"), std::string::npos);
  shell.send("set \"paging\" = FALSE;\n");
  shell.type(query);
  shell.wait_for("(31 tuples)");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, a_pager_that_there_is_not_loses_no_result) {
  Shell shell(folder_, {}, "no_such_pager -x");
  shell.type("query intstream(100, 30000) transformstream consume;\n");
  shell.wait_for("no_such_pager: not found");
  shell.wait_for("Elem");
  shell.wait_for("(29901 tuples)");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, deep_calls_need_no_large_stack_of_the_user) {
  Shell shell(folder_, {}, {}, 1U << 20U);
  shell.type("create database d; open database d; let f = fun(x: int) x; update f := fun(x: int) f(x); query f(1);\n");
  shell.wait_for("error: functions call each other more than 2000 levels deep");
  shell.type("quit\n");
  EXPECT_EQ(shell.exit_status(), 0);
}

TEST_F(Terminal, timing_is_told_on_request) {
  Shell shell(folder_, {});
  shell.type("set \"timing\" = TRUE;\n");
  shell.wait_for(" ms\r\n");
  shell.type("query 41000 + 273;\n");
  shell.wait_for("\n41273\r\n");
  shell.wait_for(" ms\r\n");
  shell.type("set \"timing\" = 3;\n");
  shell.wait_for("set \"timing\": expected TRUE or FALSE, got 3");
  shell.type("quit\n");
}

TEST_F(Terminal, letters_beyond_ascii_are_edited_as_characters) {
  Shell shell(folder_, {});
  shell.type("query \"Tür\x7f\x7fo\";\n");
  shell.wait_for("\"To\"");
  shell.type("query \"größe\" + \"42\";\n");
  shell.wait_for("\"größe42\"");
  shell.type("quit\n");
}

}  // namespace
}  // namespace queries
