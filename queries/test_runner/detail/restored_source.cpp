#include "queries/test_runner/detail/restored_source.h"

#include <fstream>

#include "queries/language/scanner.h"
#include "queries/language/token.h"
#include "queries/test_runner/detail/text_of_file.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
namespace fs = std::filesystem;

std::string reading(const RestoredSource& source, const fs::path& file) {
  return fmt::format("{} <text>{}</text--->", source.command, file.string());
}

bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_normal().lexically_relative(folder.lexically_normal());
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::optional<RestoredSource> restored_source(std::string_view command) {
  Scanner scanner(command);
  if (!scanner.take().is("restore")) return std::nullopt;
  if (scanner.peek().is("database")) scanner.take();
  scanner.take();
  const Token from = scanner.take();
  if (!from.is("from")) return std::nullopt;
  const Token file = scanner.take();
  if (file.kind != Token::Kind::word && file.kind != Token::Kind::text) return std::nullopt;
  return RestoredSource{std::string(command.substr(0, from.end)), file.text};
}

algebra3d::Result<std::string> with_moved_source(const RestoredSource& source, const Motion& motion,
                                                 const TestFolders& folders) {
  const fs::path file = folders.file / source.file;
  if (is_below(file, folders.scratch)) return reading(source, file);
  const auto content = read_text(file, nullptr);
  const auto saved = content ? NestedList::parse(*content) : algebra3d::Result<NestedList>(NestedList());
  if (!content || !saved) return reading(source, file);
  const fs::path copy = folders.scratch / ("moved-" + file.filename().string());
  std::ofstream written(copy, std::ios::binary);
  written << motion.image_of_constants(*saved).print() << '\n';
  written.close();
  if (!written) return Error{ErrorCode::io_error, "cannot write '{}'", copy.string()};
  return reading(source, copy);
}

}  // namespace queries
