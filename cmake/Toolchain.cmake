# Compiler options of this folder and those below it, and the proof that they keep floating-point arithmetic true. A
# project that this one is a part of gets none of them; what links the library gets ALGEBRA3D_ARITHMETIC_FLAGS.

# -frounding-math: interval code switches the rounding mode. -ffp-contract=off: no fused operation where the source has
# two roundings. The predicates' error bounds hold only under both.
set(ALGEBRA3D_ARITHMETIC_FLAGS -ffp-contract=off -frounding-math -fno-fast-math)
set(warnings)
if(PROJECT_IS_TOP_LEVEL)
  set(warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
endif()
if(ALGEBRA3D_WERROR)
  list(APPEND warnings -Werror)
endif()
add_compile_options(${warnings} -fno-math-errno ${ALGEBRA3D_ARITHMETIC_FLAGS})

# The archives can be linked into a plugin or an extension module too; calls within one of them stay direct and inlined.
add_compile_options(-fPIC -fno-semantic-interposition)

# g++ 12 sees overlapping copies in string concatenations (its bug 105651) and uninitialised members in variants where
# there are none; the sanitizers and clang-tidy look for the real ones.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict -Wno-maybe-uninitialized)
endif()

# What a source keeps to itself looks like part of a header there.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

if(ALGEBRA3D_SANITIZE STREQUAL thread)
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
elseif(ALGEBRA3D_SANITIZE)
  # Left out are the checks that double the compile time and find nothing that AddressSanitizer does not stop as well.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,vptr,alignment,object-size
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

find_program(ALGEBRA3D_CCACHE ccache)
mark_as_advanced(ALGEBRA3D_CCACHE)
if(ALGEBRA3D_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # The sloppiness lets ccache remember what was compiled with precompiled headers; the other two let it know a source
  # again in another checkout.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_NOHASHDIR=1 ${ALGEBRA3D_CCACHE})
endif()

# Configure-time proof: a program built with these very flags shows that products are rounded before they are added and
# that the rounding mode is respected.
string(JOIN " " arithmetic_flags ${ALGEBRA3D_ARITHMETIC_FLAGS})
if(NOT DEFINED ALGEBRA3D_ARITHMETIC_IS_TRUE)
  try_run(arithmetic_result arithmetic_compiled ${PROJECT_BINARY_DIR}/arithmetic_check
          ${PROJECT_SOURCE_DIR}/cmake/arithmetic_check.cpp
          CMAKE_FLAGS "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} -O3 ${arithmetic_flags}"
          RUN_OUTPUT_VARIABLE arithmetic_output COMPILE_OUTPUT_VARIABLE arithmetic_compile_output)
  if(NOT arithmetic_compiled OR NOT arithmetic_result EQUAL 0)
    message(FATAL_ERROR "floating-point arithmetic is not exact enough with these flags: "
                        "${arithmetic_output}${arithmetic_compile_output}")
  endif()
  set(ALGEBRA3D_ARITHMETIC_IS_TRUE TRUE CACHE INTERNAL "proved by cmake/arithmetic_check.cpp")
endif()
