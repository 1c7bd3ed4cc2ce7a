# What other programs link: the targets algebra3d::geometry, algebra3d::mesh and algebra3d::database, in this build, in an
# installation, and by pkg-config.
#
# A public library is one archive of its layers. Its headers are the only ones that a user sees; libraries that are
# named in none of them are linked all the same.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ALGEBRA3D_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/algebra3d)
configure_file(cmake/version.h.in ${PROJECT_BINARY_DIR}/include/base/algebra3d/version.h)
configure_file(cmake/version.h.in ${PROJECT_BINARY_DIR}/public/algebra3d/version.h)

# add_public_library(NAME [USES library...] FOLDERS folder...)
#
# The library algebra3d::NAME of the layer NAME and those below it, without those of the libraries that it uses. FOLDERS
# of include/algebra3d, or single headers there, are what its users may include.
function(add_public_library name)
  cmake_parse_arguments(library "" "" "USES;FOLDERS" ${ARGN})
  set(target algebra3d_${name}_library)
  set(uses ${library_USES})
  list(TRANSFORM uses REPLACE "(.+)" "algebra3d_\\1_library")
  get_property(layers GLOBAL PROPERTY ALGEBRA3D_LAYERS_OF_${name})
  get_property(dependencies GLOBAL PROPERTY ALGEBRA3D_DEPENDENCIES_OF_${name})
  foreach(used ${library_USES})
    get_property(below GLOBAL PROPERTY ALGEBRA3D_LAYERS_OF_${used})
    list(REMOVE_ITEM layers ${below})
  endforeach()

  add_library(${target} STATIC)
  add_library(algebra3d::${name} ALIAS ${target})
  foreach(layer ${layers})
    get_target_property(kind algebra3d_${layer} TYPE)
    if(kind STREQUAL STATIC_LIBRARY)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:algebra3d_${layer}>)
    endif()
  endforeach()
  # No source is this target's own. The archive of the layer of this name lies elsewhere.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} OUTPUT_NAME algebra3d_${name} LINKER_LANGUAGE CXX
                        UNITY_BUILD OFF ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/public)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Inline functions of the headers compute as the library does.
  target_compile_options(${target} INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:${ALGEBRA3D_ARITHMETIC_FLAGS}>")
  target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/public>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  binary_dependencies(dependencies ${dependencies})
  link_by_name(${target} PUBLIC ${uses} ${dependencies})
  set_property(GLOBAL APPEND PROPERTY ALGEBRA3D_PUBLIC_LIBRARIES ${name})

  # A user sees only these, wherever the library comes from.
  foreach(folder ${library_FOLDERS})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/algebra3d/${folder} ${PROJECT_BINARY_DIR}/public/algebra3d/${folder} SYMBOLIC)
    if(ALGEBRA3D_INSTALL)
      set(kind DIRECTORY)
      if(folder MATCHES "\\.h$")
        set(kind FILES)
      endif()
      install(${kind} include/algebra3d/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/algebra3d COMPONENT development)
    endif()
  endforeach()
  if(ALGEBRA3D_INSTALL)
    install_public_library(${name} ${target} "${library_USES}" "${dependencies}")
  endif()
endfunction()

# Those of the dependencies that a program is linked with.
function(binary_dependencies result)
  set(found)
  foreach(name ${ARGN})
    algebra3d_dependency_property(module ${name} PKG_CONFIG)
    if(module)
      list(APPEND found ${name})
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

function(install_public_library name target uses dependencies)
  install(TARGETS ${target} EXPORT algebra3d-${name}-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT development)
  install(EXPORT algebra3d-${name}-targets NAMESPACE algebra3d:: DESTINATION ${ALGEBRA3D_PACKAGE_FOLDER}
          COMPONENT development)
  set(modules)
  foreach(used ${uses})
    list(APPEND modules "algebra3d-${used} = ${PROJECT_VERSION}")
  endforeach()
  foreach(dependency ${dependencies})
    algebra3d_dependency_property(module ${dependency} PKG_CONFIG)
    algebra3d_dependency_property(version ${dependency} VERSION)
    list(APPEND modules "${module} >= ${version}")
  endforeach()
  write_pkg_config_file(algebra3d-${name} "-lalgebra3d_${name}" "${modules}")
endfunction()

# write_pkg_config_file(NAME "library" "required modules")
function(write_pkg_config_file name libraries modules)
  list(JOIN modules ", " modules)
  list(JOIN ALGEBRA3D_ARITHMETIC_FLAGS " " flags)
  set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH up /${folder} /)  # so that the installed tree may be moved
  configure_file(cmake/algebra3d.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${folder} COMPONENT development)
endfunction()

add_public_library(geometry FOLDERS base geometry)
add_public_library(mesh USES geometry FOLDERS halfedge mesh)
# It has operators over meshes, whose layers are in the archive of algebra3d::mesh.
add_public_library(database USES mesh FOLDERS database)
add_public_library(c USES mesh FOLDERS c.h)

# What find_package(algebra3d) and `pkg-config algebra3d` read.
if(ALGEBRA3D_INSTALL)
  get_property(components GLOBAL PROPERTY ALGEBRA3D_PUBLIC_LIBRARIES)
  set(modules ${components})
  list(TRANSFORM modules REPLACE "(.+)" "algebra3d-\\1 = ${PROJECT_VERSION}")
  write_pkg_config_file(algebra3d "" "${modules}")
  set(component_dependencies "")
  foreach(name ${components})
    get_property(dependencies GLOBAL PROPERTY ALGEBRA3D_DEPENDENCIES_OF_${name})
    binary_dependencies(dependencies ${dependencies})
    string(APPEND component_dependencies "set(algebra3d_dependencies_of_${name} ${dependencies})\n")
  endforeach()
  configure_file(cmake/algebra3d-config.cmake.in ${PROJECT_BINARY_DIR}/algebra3d-config.cmake @ONLY)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/algebra3d-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES cmake/algebra3d-dependencies.cmake ${PROJECT_BINARY_DIR}/algebra3d-config.cmake
          ${PROJECT_BINARY_DIR}/algebra3d-config-version.cmake DESTINATION ${ALGEBRA3D_PACKAGE_FOLDER}
          COMPONENT development)
  install(FILES ${PROJECT_BINARY_DIR}/public/algebra3d/version.h
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/algebra3d COMPONENT development)
endif()
