# The Debian packages algebra3d (the program), libalgebra3d-dev (the libraries) and, where the headers of that server are
# installed, postgresql-15-algebra3d (the extension):
#
#   cmake --build build/release && cpack --config build/release/CPackConfig.cmake -B FOLDER
#
# Manual page and completion are made by the program from its own description.
include(GNUInstallDirs)

set(ALGEBRA3D_CONTACT "algebra3d maintainers <maintainers@algebra3d.example>" CACHE STRING
    "who answers for the packages, as Debian writes it")
set(CPACK_PACKAGE_CONTACT ${ALGEBRA3D_CONTACT})

# made_by_program(FILE argument...): the file is what the program prints, in the folder help_files of the build.
set(help_folder ${PROJECT_BINARY_DIR}/help_files)
function(made_by_program file)
  add_custom_command(OUTPUT ${help_folder}/${file} DEPENDS algebra3d VERBATIM
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${help_folder}
                     COMMAND sh -c "\"$0\" \"$@\" >'${help_folder}/${file}'" $<TARGET_FILE:algebra3d> ${ARGN})
endfunction()
made_by_program(algebra3d.1 help --man)
made_by_program(algebra3d help --completion bash)
made_by_program(_algebra3d help --completion zsh)

# Debian wants changelogs and manual pages compressed.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(packaging/changelog.in ${help_folder}/changelog @ONLY)
add_custom_command(OUTPUT ${help_folder}/algebra3d.1.gz DEPENDS ${help_folder}/algebra3d.1 VERBATIM
                   COMMAND gzip -9nkf ${help_folder}/algebra3d.1)
add_custom_command(OUTPUT ${help_folder}/changelog.gz DEPENDS ${help_folder}/changelog VERBATIM
                   COMMAND gzip -9nkf ${help_folder}/changelog)
add_custom_target(algebra3d_help_files ALL
                  DEPENDS ${help_folder}/algebra3d.1.gz ${help_folder}/changelog.gz ${help_folder}/algebra3d
                          ${help_folder}/_algebra3d)

install(FILES ${help_folder}/algebra3d.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${help_folder}/algebra3d DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT program)
install(FILES ${help_folder}/_algebra3d DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/algebra3d COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/algebra3d/docs COMPONENT program
        FILES_MATCHING PATTERN "*.md" PATTERN decisions EXCLUDE PATTERN pictures EXCLUDE)
install(DIRECTORY queries/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/algebra3d/examples COMPONENT program)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libalgebra3d-dev/examples COMPONENT development)
install(FILES packaging/copyright ${help_folder}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/algebra3d
        COMPONENT program)
install(FILES packaging/copyright ${help_folder}/changelog.gz
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libalgebra3d-dev COMPONENT development)

# The Debian packages of what a program is linked with, as "libfmt-dev (>= 8.1)".
get_property(libraries GLOBAL PROPERTY ALGEBRA3D_PUBLIC_LIBRARIES)
set(packages)
foreach(library ${libraries})
  get_property(dependencies GLOBAL PROPERTY ALGEBRA3D_DEPENDENCIES_OF_${library})
  binary_dependencies(dependencies ${dependencies})
  foreach(dependency ${dependencies})
    algebra3d_dependency_property(package ${dependency} DEBIAN)
    algebra3d_dependency_property(version ${dependency} VERSION)
    list(APPEND packages "${package} (>= ${version})")
  endforeach()
endforeach()
list(REMOVE_DUPLICATES packages)
list(JOIN packages ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME algebra3d)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# For push and pull, which load it.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS libpq5)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "solids and surfaces as values in a database, with exact geometry
 Stores solids in relations, indexes and joins them in space, unites, intersects
 and subtracts them exactly, measures them, and imports STL, OBJ and OFF files,
 which it repairs where they are broken. The types, operators and the query
 language are those of the 3D algebra of SECONDO; a database is one SQLite file.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libalgebra3d-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "exact solids and a database of them, for C++ programs
 The libraries of algebra3d: solids and surfaces as values, with exact set
 operations, motions and measures, mesh files with repair, and an R-tree
 (algebra3d::geometry); half-edge meshes (algebra3d::mesh); databases of
 solids with a query language (algebra3d::database). For CMake and
 pkg-config; C++20, static.")

# The server finds an extension in its own folders, which are named after its version.
get_property(postgres_version GLOBAL PROPERTY ALGEBRA3D_POSTGRES_VERSION)
if(postgres_version)
  list(APPEND CPACK_COMPONENTS_ALL package_for_postgres)
  install(FILES packaging/copyright ${help_folder}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/postgresql-${postgres_version}-algebra3d
          COMPONENT package_for_postgres EXCLUDE_FROM_ALL)
  install(FILES docs/postgresql.md docs/postgresql_functions.md docs/operators.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/postgresql-${postgres_version}-algebra3d
          COMPONENT package_for_postgres EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_PACKAGE_FOR_POSTGRES_PACKAGE_NAME postgresql-${postgres_version}-algebra3d)
  set(CPACK_DEBIAN_PACKAGE_FOR_POSTGRES_PACKAGE_SECTION database)
  set(CPACK_DEBIAN_PACKAGE_FOR_POSTGRES_PACKAGE_DEPENDS postgresql-${postgres_version})
  set(CPACK_DEBIAN_PACKAGE_FOR_POSTGRES_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_PACKAGE_FOR_POSTGRES_DESCRIPTION "exact solids as values in PostgreSQL ${postgres_version}
 An extension with types for solids, surfaces, meshes, points and boxes in
 space, and functions over them: exact set operations, measures, distances,
 spatial relations, subdivision and simplification of meshes. Statements can
 be cancelled at any moment. In a database: CREATE EXTENSION algebra3d.")
endif()
include(CPack)
