#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace queries {

/// A candidate for completion: the whole word, and the text to add after it if it is the only candidate.
struct Candidate {
  std::string text;
  std::string suffix = {};
  friend bool operator==(const Candidate&, const Candidate&) = default;
};

/// The names for completion.
struct CompletionNames {
  std::vector<Candidate> operators;
  std::vector<std::string> objects;
  std::vector<std::string> types;
  std::vector<std::string> attributes;
  std::vector<std::string> databases;
  /// The files whose path begins with a text; folders end with `/`.
  std::function<std::vector<std::string>(const std::string&)> files = [](const std::string&) {
    return std::vector<std::string>();
  };
};

/// The candidates for the bytes from `begin` to the cursor, with which they begin; sorted, without duplicates.
struct Completion {
  std::size_t begin = 0;
  std::vector<Candidate> candidates;
};

/// Completes the text of a command at `cursor`. The first word is a command; the table of commands says what may follow
/// it. In an expression: operators, objects, types and attributes; after a dot attributes; between single quotes files;
/// between double quotes nothing.
Completion complete(std::string_view text, std::size_t cursor, const CompletionNames& names);
/// The longest common prefix of the candidates.
std::string common_beginning(const std::vector<Candidate>& candidates);

}  // namespace queries
