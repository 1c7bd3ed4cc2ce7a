# add_layer(NAME FOLDER folder [USES layer...] [LIBRARIES lib...])
#
# A library of all sources in `folder`. Its headers are reached through an include folder that holds nothing but a link
# to `folder`; so a source compiles only if each of its includes lies in its own layer or in one that it uses.
# A folder without sources gives a layer of headers; a folder that is not there gives none.
function(add_layer name)
  cmake_parse_arguments(layer "" "FOLDER" "USES;LIBRARIES" ${ARGN})
  set(view ${CMAKE_BINARY_DIR}/include/${name})
  cmake_path(GET layer_FOLDER PARENT_PATH parent)
  file(MAKE_DIRECTORY ${view}/${parent})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${layer_FOLDER} ${view}/${layer_FOLDER} SYMBOLIC)

  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${layer_FOLDER}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${layer_FOLDER}/*.h)
  if(sources)
    add_library(${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${name} ${scope} ${view})
  target_link_libraries(${name} ${scope} ${layer_USES} ${layer_LIBRARIES})
  add_header_check(${name} ${layer_FOLDER} "${headers}")
endfunction()

# Target NAME_headers compiles every header of the layer alone.
function(add_header_check name folder headers)
  set(units)
  foreach(header ${headers})
    cmake_path(GET header FILENAME file)
    set(unit ${CMAKE_BINARY_DIR}/headers/${folder}/${file}.cpp)
    if(NOT EXISTS ${unit})
      file(WRITE ${unit} "#include \"${folder}/${file}\"\n")
    endif()
    list(APPEND units ${unit})
  endforeach()
  if(units)
    add_library(${name}_headers OBJECT EXCLUDE_FROM_ALL ${units})
    target_link_libraries(${name}_headers PRIVATE ${name})
    set_property(GLOBAL APPEND PROPERTY ALGEBRA3D_HEADER_CHECKS ${name}_headers)
  endif()
endfunction()

# Target `headers`: every header compiles alone. Call after the last layer.
function(add_header_target)
  get_property(checks GLOBAL PROPERTY ALGEBRA3D_HEADER_CHECKS)
  add_custom_target(headers DEPENDS ${checks})
endfunction()
