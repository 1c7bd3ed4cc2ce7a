# Compiles the files of the viewer and the description of the HTTP API into the layer `server`, so that the program needs
# neither them nor Node.js. Without Node.js, or in builds of the tests with sanitizers, there is no viewer, and the server
# says so on its page.
set(ALGEBRA3D_VIEWER_DEFAULT ON)
if(ALGEBRA3D_SANITIZE OR ALGEBRA3D_FUZZERS)
  set(ALGEBRA3D_VIEWER_DEFAULT OFF)
endif()
option(ALGEBRA3D_VIEWER "build the viewer into the program (needs Node.js and npm)" ${ALGEBRA3D_VIEWER_DEFAULT})

find_program(ALGEBRA3D_NPM npm)
mark_as_advanced(ALGEBRA3D_NPM)
set(viewer_folder ${PROJECT_BINARY_DIR}/viewer)
set(viewer_stamp)
if(ALGEBRA3D_VIEWER AND NOT ALGEBRA3D_NPM)
  message(STATUS "Node.js and npm were not found: the program is built without the viewer")
elseif(ALGEBRA3D_VIEWER)
  file(GLOB_RECURSE viewer_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/viewer/src/* ${PROJECT_SOURCE_DIR}/viewer/public/*)
  file(GLOB viewer_settings CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/viewer/*.json ${PROJECT_SOURCE_DIR}/viewer/*.ts
       ${PROJECT_SOURCE_DIR}/viewer/index.html)
  set(viewer_stamp ${viewer_folder}.stamp)
  add_custom_command(OUTPUT ${viewer_stamp} COMMAND ${PROJECT_SOURCE_DIR}/scripts/build-viewer ${viewer_folder}
                     COMMAND ${CMAKE_COMMAND} -E touch ${viewer_stamp}
                     DEPENDS ${viewer_sources} ${viewer_settings} ${PROJECT_SOURCE_DIR}/scripts/build-viewer
                     COMMENT "Building the viewer" VERBATIM)
else()
  file(REMOVE_RECURSE ${viewer_folder})
endif()

set(pages ${PROJECT_BINARY_DIR}/pages_data.cpp)
set(openapi ${PROJECT_SOURCE_DIR}/queries/server/openapi.json)
add_custom_command(OUTPUT ${pages}
                   COMMAND ${CMAKE_COMMAND} -D FOLDER=${viewer_folder} -D OPENAPI=${openapi} -D OUTPUT=${pages}
                           -P ${PROJECT_SOURCE_DIR}/cmake/EmbedFiles.cmake
                   DEPENDS ${viewer_stamp} ${openapi} ${PROJECT_SOURCE_DIR}/cmake/EmbedFiles.cmake VERBATIM)
target_sources(algebra3d_server PRIVATE ${pages})
set_source_files_properties(${pages} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
