# What other programs link: the target algebra3d::geometry, in this build and in an installation.
#
# One archive of all layers up to `geometry`; the headers of that layer and those of `base` that they include are the
# only ones that are installed. GMP, MPFR, zstd and xxhash are linked, but named in no installed header.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(geometry_layers base stl rtree exact halfedge planar validity arrangement repair types registry operators geometry)
add_library(algebra3d_geometry STATIC)
add_library(algebra3d::geometry ALIAS algebra3d_geometry)
foreach(layer ${geometry_layers})
  target_sources(algebra3d_geometry PRIVATE $<TARGET_OBJECTS:${layer}>)
endforeach()
# No source is this target's own.
set_target_properties(algebra3d_geometry PROPERTIES EXPORT_NAME geometry LINKER_LANGUAGE CXX UNITY_BUILD OFF)
target_compile_features(algebra3d_geometry PUBLIC cxx_std_20)
# Inline functions of the headers compute as the library does.
target_compile_options(algebra3d_geometry INTERFACE ${ALGEBRA3D_ARITHMETIC_FLAGS})
target_include_directories(algebra3d_geometry PUBLIC $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/include/base>
                           $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/include/geometry> $<INSTALL_INTERFACE:include>)
target_link_libraries(algebra3d_geometry PUBLIC fmt::fmt mpfr gmp zstd xxhash)

install(TARGETS algebra3d_geometry EXPORT algebra3d-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(header base/error.h base/vec3.h base/box3.h base/monitor.h geometry/solid.h geometry/surface.h
        geometry/mesh_files.h geometry/box_index.h)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES algebra3d/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/algebra3d/${folder})
endforeach()
install(EXPORT algebra3d-targets NAMESPACE algebra3d:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/algebra3d)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/algebra3d-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/algebra3d-config.cmake ${CMAKE_BINARY_DIR}/algebra3d-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/algebra3d)
