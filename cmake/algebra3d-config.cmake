# find_package(algebra3d) gives the target algebra3d::geometry. Debian: libfmt-dev libgmp-dev libmpfr-dev libzstd-dev
# libxxhash-dev.
include(CMakeFindDependencyMacro)
find_dependency(fmt)
include(${CMAKE_CURRENT_LIST_DIR}/algebra3d-targets.cmake)
