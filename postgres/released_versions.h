#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "versions.h"

/// The versions of the extension in a folder: the one under development, those that are released, and their members.
namespace algebra3d_postgres {

/// Numbers of a version such as 1.10, which is later than 1.9.
inline std::vector<int> numbers_of(const std::string& version) {
  std::vector<int> numbers;
  std::istringstream in(version);
  for (std::string part; std::getline(in, part, '.');) numbers.push_back(std::atoi(part.c_str()));
  return numbers;
}

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The version that algebra3d.control names: the one that is under development, or the last one that was released.
inline std::string version_of_control(const std::filesystem::path& folder) {
  const std::string control = content_of(folder / "algebra3d.control"), mark = "default_version = '";
  const std::size_t at = control.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size();
  return control.substr(begin, control.find('\'', begin) - begin);
}

inline constexpr std::string_view kMembers = ".members", kPrefix = "algebra3d--";

/// In the order of the versions.
inline std::vector<std::string> released_versions(const std::filesystem::path& folder) {
  std::vector<std::string> versions;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(kMembers))
      versions.push_back(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kMembers.size()));
  }
  std::ranges::sort(versions, {}, numbers_of);
  return versions;
}

/// Lines that the list of members of a released version has and `script` has not: errors.
inline std::vector<std::string> missing_members(const std::string& list, const std::string& script) {
  const auto lines_of = [](const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      if (!line.starts_with("script\t")) lines.push_back(line);
    return lines;
  };
  const std::vector<std::string> there = lines_of(members_of("", script));
  const std::set<std::string> known(there.begin(), there.end());
  std::vector<std::string> missing;
  for (const std::string& line : lines_of(list))
    if (!known.contains(line)) missing.push_back(line);
  return missing;
}

}  // namespace algebra3d_postgres
