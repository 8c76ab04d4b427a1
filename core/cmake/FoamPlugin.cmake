# foam_add_plugin(NAME SOURCES file... [LIBRARIES target...] [DIRECTORY folder])
#
# A plugin: a shared module NAME.so, hidden symbols but for its one entry point, beside the program's other plugins.
# DIRECTORY: built there instead, and not installed (the plugins of tests).

function(foam_add_plugin NAME)
  cmake_parse_arguments(ARG "" "DIRECTORY" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${NAME} MODULE ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE foam::core ${ARG_LIBRARIES})
  if(TARGET foam_compiler)
    target_link_libraries(${NAME} PRIVATE foam_compiler)
  endif()
  set_target_properties(${NAME} PROPERTIES
    PREFIX ""
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib/foam/plugins")
  if(ARG_DIRECTORY)
    set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${ARG_DIRECTORY}")
  else()
    install(TARGETS ${NAME} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/foam/plugins")
  endif()
endfunction()
