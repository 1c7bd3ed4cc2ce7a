#include "queries/session/detail/saved_text.h"

#include <utility>

#include "base/propagate.h"
#include "queries/session/detail/saved_list.h"
#include "queries/session/variables.h"

namespace queries {

algebra3d::Result<SavedText> SavedText::open(const std::filesystem::path& file, std::string name,
                                             const std::atomic<bool>* cancel) {
  A3D_ASSIGN(algebra3d::FileContent content, algebra3d::FileContent::read(file, cancel));
  return SavedText(std::move(content), std::move(name), std::filesystem::absolute(file).parent_path());
}

SavedText::SavedText(algebra3d::FileContent file, std::string name, std::filesystem::path folder)
    : file_(std::move(file)), name_(std::move(name)), folder_(std::move(folder)) {
  if (file_.bytes().starts_with(kSavedHere)) return;
  variables_ = variables_in(file_.bytes());
  if (!variables_.empty()) copy_ = with_variables(file_.bytes());
}

}  // namespace queries
