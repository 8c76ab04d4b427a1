# The two functions of a plugin's CMakeLists.txt. The same file builds the plugin in foam's own tree and out of it, against an
# installed foam or a built clone:
#
#     cmake_minimum_required(VERSION 3.25)
#     project(spherize_mine LANGUAGES CXX)
#     find_package(foam REQUIRED)
#     foam_add_plugin(spherize_mine SOURCES plugin.cpp)
#     foam_test_plugin(spherize_mine)

include(GNUInstallDirs)

# Measured against others, a plugin is to be an optimised one unless its author says otherwise.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo" FORCE)
endif()

# foam_add_plugin(NAME SOURCES file... [LIBRARIES target...] [COMPONENT component] [DIRECTORY folder])
#
# A plugin: a shared module NAME.so, hidden symbols but for its one entry point. Out of tree it is made in the build folder,
# in tree beside the program's other plugins. Installed to lib/foam/plugins as part of COMPONENT (runtime; gpl: what is under
# the GPL). DIRECTORY: built there instead, and not installed.
function(foam_add_plugin NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "COMPONENT;DIRECTORY" "SOURCES;LIBRARIES")
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SOURCES)
    message(FATAL_ERROR "foam_add_plugin(NAME SOURCES file... [LIBRARIES target...] [COMPONENT component] [DIRECTORY folder]): "
      "got ${NAME} ${ARGN}")
  endif()
  add_library(${NAME} MODULE ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE foam::core ${ARG_LIBRARIES})
  if(TARGET foam_compiler) # in tree
    target_link_libraries(${NAME} PRIVATE foam_compiler)
  else()
    target_compile_options(${NAME} PRIVATE -ffp-contract=off) # the same bits with and without fused multiply-add
  endif()
  set_target_properties(${NAME} PROPERTIES
    PREFIX ""
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "\$ORIGIN/../..") # libfoam-core lies two folders up
  if(ARG_DIRECTORY)
    set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${ARG_DIRECTORY}")
    return()
  endif()
  if(FOAM_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${FOAM_PLUGIN_OUTPUT_DIRECTORY}")
  endif()
  if(NOT ARG_COMPONENT)
    set(ARG_COMPONENT runtime)
  endif()
  install(TARGETS ${NAME} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/foam/plugins" COMPONENT ${ARG_COMPONENT})
endfunction()
