# foam_unity(TARGET): with FOAM_UNITY the sources of the target are compiled together. Names in unnamed namespaces must then be
# unique in it. -Wshadow is off then: it would warn of names in other sources.
function(foam_unity TARGET)
  if(FOAM_UNITY)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
  endif()
endfunction()

# foam_library(NAME USES library... [LIBRARIES target...] [SOURCES file...])
#
# A library of core: the target foam::NAME, of the files in src/, for whom include/foam/NAME/ is. It exports what these headers
# declare, and nothing else; those in internal/ are for foam's own libraries and programs and are not installed. USES: the
# libraries below it, as docs/dev/architecture.md lists them. foam_NAME_internals is an archive of the same object files, for the
# tests of what is not exported.
function(foam_library NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "USES;LIBRARIES;SOURCES")
  set(TARGET foam_${NAME})
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS src/*.cpp)
  add_library(${TARGET} SHARED ${SOURCES} ${ARG_SOURCES})
  add_library(foam::${NAME} ALIAS ${TARGET})
  target_include_directories(${TARGET}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)
  target_compile_features(${TARGET} PUBLIC cxx_std_20)
  list(TRANSFORM ARG_USES PREPEND foam::)
  target_link_libraries(${TARGET} PUBLIC ${ARG_USES} PRIVATE foam_compiler fmt::fmt ${ARG_LIBRARIES})
  target_link_options(${TARGET} PRIVATE -Wl,--build-id=sha1)
  if(NOT FOAM_SANITIZE) # what a sanitizer calls is in the program
    target_link_options(${TARGET} PRIVATE -Wl,--no-undefined)
  else()
    # The fingerprint says so: what links it must be built alike.
    target_compile_options(${TARGET} INTERFACE -fsanitize=${FOAM_SANITIZE})
    target_link_options(${TARGET} INTERFACE -fsanitize=${FOAM_SANITIZE})
  endif()
  set_target_properties(${TARGET} PROPERTIES
    OUTPUT_NAME foam-${NAME} EXPORT_NAME ${NAME} VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON INSTALL_RPATH "\$ORIGIN"
    DEFINE_SYMBOL "") # else no two libraries could share precompiled headers
  if(NAME STREQUAL "base")
    target_precompile_headers(${TARGET} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map>
      <memory> <optional> <set> <span> <string> <string_view> <variant> <vector> <fmt/format.h>)
  else()
    target_precompile_headers(${TARGET} REUSE_FROM foam_base)
  endif()
  install(TARGETS ${TARGET} EXPORT foamTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT sdk)
  install(DIRECTORY include/foam DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT sdk PATTERN internal EXCLUDE)

  add_library(${TARGET}_internals STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${TARGET}>)
  target_include_directories(${TARGET}_internals INTERFACE "${PROJECT_SOURCE_DIR}/core" "${CMAKE_CURRENT_SOURCE_DIR}/src")
  target_link_libraries(${TARGET}_internals INTERFACE foam::${NAME} fmt::fmt ${ARG_LIBRARIES})
endfunction()

# foam_embed(OUTPUT HEADER NAMESPACE file...): a source with the files as text; see EmbedText.cmake.
function(foam_embed OUTPUT HEADER NAMESPACE)
  add_custom_command(OUTPUT "${OUTPUT}"
    COMMAND ${CMAKE_COMMAND} "-DFILES=${ARGN}" "-DHEADER=${HEADER}" "-DNAMESPACE=${NAMESPACE}"
      "-DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/${OUTPUT}" -P "${PROJECT_SOURCE_DIR}/core/cmake/EmbedText.cmake"
    DEPENDS ${ARGN} "${PROJECT_SOURCE_DIR}/core/cmake/EmbedText.cmake" VERBATIM)
  set_source_files_properties("${CMAKE_CURRENT_BINARY_DIR}/${OUTPUT}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
