# The functions of a plugin's CMakeLists.txt. The same file builds the plugin in foam's own tree and out of it, against an
# installed foam or a built clone:
#
#     cmake_minimum_required(VERSION 3.25)
#     project(spherize_mine LANGUAGES CXX)
#     find_package(foam REQUIRED)
#     foam_add_plugin(spherize_mine SOURCES plugin.cpp)
#     foam_test_plugin(spherize_mine)

include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)
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
  target_link_libraries(${NAME} PRIVATE foam::sdk foam::search ${ARG_LIBRARIES})
  check_linker_flag(CXX -Wl,--build-id=sha1 FOAM_HAS_BUILD_ID)
  if(FOAM_HAS_BUILD_ID)
    target_link_options(${NAME} PRIVATE -Wl,--build-id=sha1) # part of the keys of the cache
  endif()
  if(TARGET foam_compiler) # in tree
    target_link_libraries(${NAME} PRIVATE foam_compiler)
    set_target_properties(${NAME} PROPERTIES UNITY_BUILD ${FOAM_UNITY} UNITY_BUILD_BATCH_SIZE 20)
  else()
    check_cxx_compiler_flag(-ffp-contract=off FOAM_HAS_ffp_contract_off)
    if(FOAM_HAS_ffp_contract_off)
      target_compile_options(${NAME} PRIVATE -ffp-contract=off) # the same bits with and without fused multiply-add
    endif()
  endif()
  set_target_properties(${NAME} PROPERTIES
    PREFIX ""
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "\$ORIGIN/../..") # foam's libraries lie two folders up
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

# foam_add_late_library(PLUGIN NAME SOURCES file... [LIBRARIES target...])
#
# A part of a plugin with libraries that would slow down every start of foam: PLUGIN/libNAME.so in the plugin's folder, which
# the plugin opens on first use by open_late_library() of foam/sdk/late_library.hpp.
function(foam_add_late_library PLUGIN NAME)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES;LIBRARIES")
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SOURCES OR NOT TARGET ${PLUGIN})
    message(FATAL_ERROR "foam_add_late_library(PLUGIN NAME SOURCES file... [LIBRARIES target...]) of a plugin PLUGIN: "
      "got ${PLUGIN} ${NAME} ${ARGN}")
  endif()
  get_target_property(FOLDER ${PLUGIN} LIBRARY_OUTPUT_DIRECTORY)
  if(NOT FOLDER)
    set(FOLDER "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  add_library(${NAME} MODULE ${ARG_SOURCES})
  target_include_directories(${NAME} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
  target_link_libraries(${NAME} PRIVATE foam::sdk ${ARG_LIBRARIES})
  if(TARGET foam_compiler) # in tree
    target_link_libraries(${NAME} PRIVATE foam_compiler)
  endif()
  set_target_properties(${NAME} PROPERTIES
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "\$ORIGIN/../../.."
    LIBRARY_OUTPUT_DIRECTORY "${FOLDER}/${PLUGIN}")
  install(TARGETS ${NAME} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/foam/plugins/${PLUGIN}" COMPONENT runtime)
  add_dependencies(${PLUGIN} ${NAME})
endfunction()

# foam_test_plugin(NAME [SAMPLES file...] [SET stage.parameter=value...] [SOURCES file...] [RECIPES file...])
#
# Tests for ctest: NAME.contract holds the plugin's stages to what their kinds promise (`foam test-plugin`); SAMPLES are files
# that a loader is to read, SET are parameters for a stage that does nothing with its defaults. NAME.test is a program of the author's own made of SOURCES, in which FOAM_TEST_PLUGIN is the path of
# the plugin; it fails by its exit code. NAME.STEM runs RECIPES/STEM.yaml with the plugin.
macro(foam_test_plugin)
  if(NOT DEFINED FOAM_TESTS OR FOAM_TESTS)
    enable_testing() # a macro, for this works on the caller's folder
    foam_add_plugin_tests(${ARGN})
  endif()
endmacro()

function(foam_add_plugin_tests NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SAMPLES;SET;SOURCES;RECIPES")
  if(ARG_UNPARSED_ARGUMENTS OR NOT TARGET ${NAME})
    message(FATAL_ERROR "foam_test_plugin(NAME [SAMPLES file...] [SET stage.parameter=value...] [SOURCES file...] "
      "[RECIPES file...]) of a plugin NAME: got ${NAME} ${ARGN}")
  endif()
  set(OPTIONS)
  foreach(SAMPLE IN LISTS ARG_SAMPLES)
    cmake_path(ABSOLUTE_PATH SAMPLE)
    list(APPEND OPTIONS --sample "${SAMPLE}")
  endforeach()
  foreach(PARAMETER IN LISTS ARG_SET)
    list(APPEND OPTIONS --set "${PARAMETER}")
  endforeach()
  add_test(NAME ${NAME}.contract COMMAND foam::program test-plugin $<TARGET_FILE:${NAME}> ${OPTIONS})
  set(TESTS ${NAME}.contract)
  if(ARG_SOURCES)
    add_executable(${NAME}_test ${ARG_SOURCES})
    target_link_libraries(${NAME}_test PRIVATE foam::runtime)
    target_compile_definitions(${NAME}_test PRIVATE FOAM_TEST_PLUGIN="$<TARGET_FILE:${NAME}>")
    add_dependencies(${NAME}_test ${NAME})
    add_test(NAME ${NAME}.test COMMAND ${NAME}_test)
    list(APPEND TESTS ${NAME}.test)
  endif()
  foreach(RECIPE IN LISTS ARG_RECIPES)
    cmake_path(ABSOLUTE_PATH RECIPE)
    cmake_path(GET RECIPE STEM STEM)
    add_test(NAME ${NAME}.${STEM}
      COMMAND foam::program run "${RECIPE}" --plugin $<TARGET_FILE:${NAME}> --fresh --run-dir "${CMAKE_CURRENT_BINARY_DIR}/runs/${STEM}")
    list(APPEND TESTS ${NAME}.${STEM})
  endforeach()
  set_tests_properties(${TESTS} PROPERTIES TIMEOUT 900)
endfunction()
