# The libraries that algebra3d is built from. Used by its own build, and by find_package(algebra3d) in programs that
# link it.
#
# algebra3d_find_dependencies(RESULT name...) finds those libraries and makes their targets. RESULT becomes empty, or the
# text that names what is missing or too old and the Debian packages that have it.

# algebra3d_dependency(NAME VERSION version DEBIAN package [PKG_CONFIG module]
#                      PACKAGE package TARGET target | HEADER file LIBRARY name VERSION_MACROS macro... [ARCHIVES name...])
#
# VERSION is the oldest one that it was compiled with (that of Ubuntu 22.04; fast_float of Debian 12). PACKAGE is found by find_package and brings its TARGET; otherwise the
# target algebra3d::NAME is made of the header, which tells the version, and the library. PKG_CONFIG is left out for
# libraries of headers alone, which no linked program needs. ARCHIVES are static libraries that targets with the property
# ALGEBRA3D_STATIC link in its place, if all of them are there: a program starts sooner with fewer shared libraries.
function(algebra3d_dependency name)
  set(keys VERSION DEBIAN PKG_CONFIG PACKAGE TARGET HEADER LIBRARY)
  cmake_parse_arguments(given "" "${keys}" "VERSION_MACROS;ARCHIVES" ${ARGN})
  if(NOT given_TARGET)
    set(given_TARGET algebra3d::${name})
  endif()
  foreach(key ${keys} VERSION_MACROS ARCHIVES)
    set_property(GLOBAL PROPERTY ALGEBRA3D_DEPENDENCY_${name}_${key} "${given_${key}}")
  endforeach()
endfunction()

algebra3d_dependency(fmt VERSION 8.1 DEBIAN libfmt-dev PKG_CONFIG fmt PACKAGE fmt TARGET fmt::fmt)
algebra3d_dependency(fast_float VERSION 3.9 DEBIAN libfast-float-dev PACKAGE FastFloat TARGET FastFloat::fast_float)
algebra3d_dependency(json VERSION 3.10 DEBIAN nlohmann-json3-dev
                     PACKAGE nlohmann_json TARGET nlohmann_json::nlohmann_json)
algebra3d_dependency(cli11 VERSION 2.1 DEBIAN libcli11-dev PACKAGE CLI11 TARGET CLI11::CLI11)
algebra3d_dependency(gtest VERSION 1.11 DEBIAN libgtest-dev PACKAGE GTest TARGET GTest::gtest_main)
algebra3d_dependency(benchmark VERSION 1.6 DEBIAN libbenchmark-dev PACKAGE benchmark TARGET benchmark::benchmark_main)
# Not by its CMake package, which gives builds with assertions another library.
algebra3d_dependency(tbb VERSION 2021.5 DEBIAN libtbb-dev PKG_CONFIG tbb HEADER oneapi/tbb/version.h LIBRARY tbb
                     VERSION_MACROS TBB_VERSION_MAJOR TBB_VERSION_MINOR)
algebra3d_dependency(gmp VERSION 6.2.1 DEBIAN libgmp-dev PKG_CONFIG gmp HEADER gmp.h LIBRARY gmp
                     VERSION_MACROS __GNU_MP_VERSION __GNU_MP_VERSION_MINOR __GNU_MP_VERSION_PATCHLEVEL ARCHIVES gmp)
algebra3d_dependency(mpfr VERSION 4.1 DEBIAN libmpfr-dev PKG_CONFIG mpfr HEADER mpfr.h LIBRARY mpfr
                     VERSION_MACROS MPFR_VERSION_STRING ARCHIVES mpfr gmp)
algebra3d_dependency(zstd VERSION 1.4.8 DEBIAN libzstd-dev PKG_CONFIG libzstd HEADER zstd.h LIBRARY zstd
                     VERSION_MACROS ZSTD_VERSION_MAJOR ZSTD_VERSION_MINOR ZSTD_VERSION_RELEASE ARCHIVES zstd)
algebra3d_dependency(zlib VERSION 1.2.11 DEBIAN zlib1g-dev PKG_CONFIG zlib HEADER zlib.h LIBRARY z
                     VERSION_MACROS ZLIB_VERSION ARCHIVES z)
algebra3d_dependency(xxhash VERSION 0.8.1 DEBIAN libxxhash-dev PKG_CONFIG libxxhash HEADER xxhash.h LIBRARY xxhash
                     VERSION_MACROS XXH_VERSION_MAJOR XXH_VERSION_MINOR XXH_VERSION_RELEASE ARCHIVES xxhash)
algebra3d_dependency(sqlite3 VERSION 3.37 DEBIAN libsqlite3-dev PKG_CONFIG sqlite3 HEADER sqlite3.h LIBRARY sqlite3
                     VERSION_MACROS SQLITE_VERSION ARCHIVES sqlite3)
algebra3d_dependency(edit VERSION 2.11 DEBIAN libedit-dev PKG_CONFIG libedit HEADER histedit.h LIBRARY edit
                     VERSION_MACROS LIBEDIT_MAJOR LIBEDIT_MINOR ARCHIVES edit tinfo bsd md)
algebra3d_dependency(boost VERSION 1.74 DEBIAN libboost-dev PACKAGE Boost TARGET Boost::headers)

# What algebra3d_dependency said of a library; empty for a name that is none.
function(algebra3d_dependency_property result name key)
  get_property(value GLOBAL PROPERTY ALGEBRA3D_DEPENDENCY_${name}_${key})
  set(${result} "${value}" PARENT_SCOPE)
endfunction()

# The version that a header tells: the values of the macros, joined by dots.
function(algebra3d_version_of_header result file)
  set(numbers)
  foreach(macro ${ARGN})
    file(STRINGS "${file}" line REGEX "^#[ \t]*define[ \t]+${macro}[ \t]+\"?[0-9]" LIMIT_COUNT 1)
    if(line MATCHES "${macro}[ \t]+\"?([0-9.]+)")
      list(APPEND numbers ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN numbers . version)
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

# Finds header and library of one dependency. RESULT: what is wrong, or empty.
function(algebra3d_find_header_and_library result name)
  foreach(key VERSION TARGET HEADER LIBRARY VERSION_MACROS ARCHIVES)
    algebra3d_dependency_property(${key} ${name} ${key})
  endforeach()
  set(${result} "" PARENT_SCOPE)
  if(TARGET ${TARGET})
    return()
  endif()
  find_path(ALGEBRA3D_${name}_FOLDER ${HEADER})
  find_library(ALGEBRA3D_${name}_LIBRARY ${LIBRARY})
  mark_as_advanced(ALGEBRA3D_${name}_FOLDER ALGEBRA3D_${name}_LIBRARY)
  if(NOT ALGEBRA3D_${name}_FOLDER)
    set(${result} "no ${HEADER}" PARENT_SCOPE)
    return()
  elseif(NOT ALGEBRA3D_${name}_LIBRARY)
    set(${result} "${HEADER} without its library" PARENT_SCOPE)
    return()
  endif()
  algebra3d_version_of_header(found "${ALGEBRA3D_${name}_FOLDER}/${HEADER}" ${VERSION_MACROS})
  if(found VERSION_LESS VERSION)
    set(${result} "${HEADER} is of version ${found}" PARENT_SCOPE)
    return()
  endif()
  set(linked "${ALGEBRA3D_${name}_LIBRARY}")
  set(archives)
  foreach(archive ${ARCHIVES})
    find_library(ALGEBRA3D_${archive}_ARCHIVE lib${archive}.a)
    mark_as_advanced(ALGEBRA3D_${archive}_ARCHIVE)
    list(APPEND archives "${ALGEBRA3D_${archive}_ARCHIVE}")
  endforeach()
  if(archives AND NOT archives MATCHES "NOTFOUND")
    set(is_static "$<BOOL:$<TARGET_PROPERTY:ALGEBRA3D_STATIC>>")
    set(linked "$<$<NOT:${is_static}>:${linked}>")
    foreach(archive ${archives})
      list(APPEND linked "$<${is_static}:${archive}>")
    endforeach()
  endif()
  add_library(${TARGET} INTERFACE IMPORTED GLOBAL)
  set_target_properties(${TARGET} PROPERTIES INTERFACE_LINK_LIBRARIES "${linked}"
                        INTERFACE_INCLUDE_DIRECTORIES "${ALGEBRA3D_${name}_FOLDER}")
endfunction()

# The same for one that brings a CMake package.
function(algebra3d_find_config_package result name)
  foreach(key VERSION PACKAGE TARGET)
    algebra3d_dependency_property(${key} ${name} ${key})
  endforeach()
  set(${result} "" PARENT_SCOPE)
  if(TARGET ${TARGET})
    return()
  endif()
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # also for the project that this one is a part of
  find_package(${PACKAGE} ${VERSION} QUIET CONFIG)
  if(${PACKAGE}_FOUND)
    return()
  elseif(${PACKAGE}_CONSIDERED_VERSIONS)
    list(GET ${PACKAGE}_CONSIDERED_VERSIONS 0 found)
    set(${result} "the package ${PACKAGE} is of version ${found}" PARENT_SCOPE)
  else()
    set(${result} "no package ${PACKAGE}" PARENT_SCOPE)
  endif()
endfunction()

function(algebra3d_find_dependencies result)
  set(missing)
  set(packages)
  foreach(name ${ARGN})
    algebra3d_dependency_property(package ${name} PACKAGE)
    if(package)
      algebra3d_find_config_package(wrong ${name})
    else()
      algebra3d_find_header_and_library(wrong ${name})
    endif()
    if(wrong)
      algebra3d_dependency_property(version ${name} VERSION)
      algebra3d_dependency_property(debian ${name} DEBIAN)
      list(APPEND missing "${name} ${version} or newer (${wrong})")
      list(APPEND packages ${debian})
    endif()
  endforeach()
  if(missing)
    list(JOIN missing ", " missing)
    list(JOIN packages " " packages)
    set(${result} "algebra3d needs ${missing}. Debian and Ubuntu: apt install ${packages}" PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()
