# foam_unity(TARGET): with FOAM_UNITY the sources of the target are compiled together. Names in unnamed namespaces must then be
# unique in it. -Wshadow is off then: it would warn of names in other sources.
function(foam_unity TARGET)
  if(FOAM_UNITY)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
  endif()
endfunction()

# foam_room(NAME library...): a library of core, whose folder is NAME, and those that it uses.
macro(foam_room NAME)
  list(APPEND FOAM_ROOMS ${NAME})
  set(FOAM_USES_${NAME} ${ARGN})
endmacro()

# foam_choose_rooms(library...): leaves in FOAM_ROOMS these libraries and all that they use; without arguments: all.
macro(foam_choose_rooms)
  set(WANTED ${ARGN})
  if(WANTED)
    foreach(NAME IN LISTS WANTED)
      if(NOT NAME IN_LIST FOAM_ROOMS)
        list(JOIN FOAM_ROOMS ", " KNOWN)
        message(FATAL_ERROR "FOAM_LIBRARIES: foam has no library ${NAME}; remedy: some of ${KNOWN}")
      endif()
    endforeach()
    list(REVERSE FOAM_ROOMS)
    foreach(NAME IN LISTS FOAM_ROOMS) # each before those that it uses
      if(NAME IN_LIST WANTED)
        list(APPEND WANTED ${FOAM_USES_${NAME}})
      else()
        list(REMOVE_ITEM FOAM_ROOMS ${NAME})
      endif()
    endforeach()
    list(REVERSE FOAM_ROOMS)
  endif()
endmacro()

# foam_package(NAME argument...): find_package(NAME argument... REQUIRED), of which foamConfig.cmake tells who links foam
# statically; BUILD_ONLY: headers that only foam's own sources include.
macro(foam_package NAME)
  cmake_parse_arguments(FOAM_PACKAGE "BUILD_ONLY" "" "" ${ARGN})
  find_package(${NAME} ${FOAM_PACKAGE_UNPARSED_ARGUMENTS} REQUIRED)
  if(NOT FOAM_PACKAGE_BUILD_ONLY)
    set_property(GLOBAL APPEND PROPERTY FOAM_PACKAGES_${FOAM_ROOM} ${NAME})
  endif()
endmacro()

# foam_pkg_config(PREFIX module): the same of what pkg-config finds, as PkgConfig::PREFIX.
macro(foam_pkg_config PREFIX MODULE)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(${PREFIX} REQUIRED IMPORTED_TARGET GLOBAL ${MODULE})
  set_property(GLOBAL APPEND PROPERTY FOAM_PACKAGES_${FOAM_ROOM} ${PREFIX}=${MODULE})
endmacro()

# foam_linked(TARGET): how a library of core is linked, named and installed.
function(foam_linked TARGET)
  target_compile_options(${TARGET} PRIVATE ${FOAM_COMPILE_OPTIONS})
  target_link_options(${TARGET} PRIVATE ${FOAM_LINK_OPTIONS})
  if(FOAM_SANITIZE)
    # The fingerprint says so: what links it must be built alike.
    target_compile_options(${TARGET} INTERFACE -fsanitize=${FOAM_SANITIZE})
    target_link_options(${TARGET} INTERFACE -fsanitize=${FOAM_SANITIZE})
  endif()
  string(REPLACE "foam_" "" NAME ${TARGET})
  set_target_properties(${TARGET} PROPERTIES
    OUTPUT_NAME foam-${NAME} EXPORT_NAME ${NAME} VERSION ${PROJECT_VERSION} SOVERSION ${FOAM_SOVERSION}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON INSTALL_RPATH "\$ORIGIN")
  install(TARGETS ${TARGET} EXPORT foamTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT sdk
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT sdk)
endfunction()

# foam_library(NAME [LIBRARIES target...] [HEADERS target...] [SOURCES file...])
#
# A library of core: the target foam::NAME, of the files in src/, for whom include/foam/NAME/ is. It exports what these headers
# declare, and nothing else; those in internal/ are for foam's own libraries and programs and are not installed. HEADERS: targets
# of packages of headers alone, which nobody needs who links the library. foam_NAME_internals is an archive of the same object
# files, for the tests of what is not exported.
function(foam_library NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "LIBRARIES;HEADERS;SOURCES")
  set(TARGET foam_${NAME})
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS src/*.cpp)
  add_library(${TARGET} ${FOAM_LIBRARY_TYPE} ${SOURCES} ${ARG_SOURCES})
  add_library(foam::${NAME} ALIAS ${TARGET})
  target_include_directories(${TARGET}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE src)
  target_compile_features(${TARGET} PUBLIC cxx_std_20)
  list(TRANSFORM FOAM_USES_${NAME} PREPEND foam:: OUTPUT_VARIABLE USED)
  target_link_libraries(${TARGET} PUBLIC ${USED} PRIVATE fmt::fmt Threads::Threads ${ARG_LIBRARIES})
  foreach(HEADERS IN LISTS ARG_HEADERS)
    target_include_directories(${TARGET} SYSTEM PRIVATE $<TARGET_PROPERTY:${HEADERS},INTERFACE_INCLUDE_DIRECTORIES>)
    target_compile_definitions(${TARGET} PRIVATE $<TARGET_PROPERTY:${HEADERS},INTERFACE_COMPILE_DEFINITIONS>)
  endforeach()
  foam_linked(${TARGET})
  set_target_properties(${TARGET} PROPERTIES DEFINE_SYMBOL "") # else no two libraries could share precompiled headers
  if(NAME STREQUAL "base")
    target_precompile_headers(${TARGET} PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map>
      <memory> <optional> <set> <span> <string> <string_view> <variant> <vector> <fmt/format.h>)
  else()
    target_precompile_headers(${TARGET} REUSE_FROM foam_base)
  endif()
  install(DIRECTORY include/foam DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT sdk PATTERN internal EXCLUDE)

  add_library(${TARGET}_internals STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${TARGET}>)
  target_include_directories(${TARGET}_internals INTERFACE "${PROJECT_SOURCE_DIR}/core" "${CMAKE_CURRENT_SOURCE_DIR}/src")
  target_link_libraries(${TARGET}_internals INTERFACE foam::${NAME} fmt::fmt ${ARG_LIBRARIES} ${ARG_HEADERS})
endfunction()

# foam_embed(OUTPUT HEADER NAMESPACE file...): a source with the files as text; see EmbedText.cmake.
function(foam_embed OUTPUT HEADER NAMESPACE)
  add_custom_command(OUTPUT "${OUTPUT}"
    COMMAND ${CMAKE_COMMAND} "-DFILES=${ARGN}" "-DHEADER=${HEADER}" "-DNAMESPACE=${NAMESPACE}"
      "-DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/${OUTPUT}" -P "${PROJECT_SOURCE_DIR}/core/cmake/EmbedText.cmake"
    DEPENDS ${ARGN} "${PROJECT_SOURCE_DIR}/core/cmake/EmbedText.cmake" VERBATIM)
  set_source_files_properties("${CMAKE_CURRENT_BINARY_DIR}/${OUTPUT}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
