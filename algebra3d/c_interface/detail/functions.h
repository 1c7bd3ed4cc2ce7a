#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/c.h"
#include "algebra3d/operators/registry/registry.h"

namespace algebra3d::c_interface {

/// The registry of all sessions. The first call makes it.
const Registry& operators();

/// The description of a function for C code, and the overload that it calls.
struct Function {
  a3d_function description = {};  ///< first, so that C code's pointer is one to this
  ResolvedCall call;
  std::vector<a3d_parameter> parameters;
  std::vector<a3d_column> columns;
};

/// A message with the names that operators have in hosts: at its beginning, before a colon, and wherever they have a
/// capital letter, so are not words of English.
std::string in_host_names(std::string_view message);

/// Sorted by name.
std::span<const Function> functions();
const Function& function_of(const a3d_function* description);

}  // namespace algebra3d::c_interface
