#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace queries {

/// A way to go on with a word: the whole word, and what follows it once it is the only way.
struct Candidate {
  std::string text;
  std::string suffix = {};
  friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// The names that may be completed.
struct CompletionNames {
  std::vector<Candidate> operators;
  std::vector<std::string> objects;
  std::vector<std::string> types;
  std::vector<std::string> attributes;
  std::vector<std::string> databases;
  /// The files whose path begins like this, folders with a `/` at their end.
  std::function<std::vector<std::string>(const std::string&)> files = [](const std::string&) {
    return std::vector<std::string>();
  };
};

/// The bytes from `begin` to the cursor may become any of the candidates, which begin with them; sorted, each once.
struct Completion {
  std::size_t begin = 0;
  std::vector<Candidate> candidates;
};

/// How the text of a command can go on at `cursor`. The first word is a command, and what may follow it says the table
/// of commands. In an expression: operators, objects, types and attributes, after a dot attributes; between single
/// quotes files; between double quotes nothing.
Completion complete(std::string_view text, std::size_t cursor, const CompletionNames& names);
/// What all candidates begin with.
std::string common_beginning(const std::vector<Candidate>& candidates);

}  // namespace queries
