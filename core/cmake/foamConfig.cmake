# find_package(foam): the library foam::core, the program foam::program, foam_add_plugin() and foam_test_plugin().
if(NOT TARGET foam::core) # in foam's own tree they are there already
  include("${CMAKE_CURRENT_LIST_DIR}/foamTargets.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/FoamPlugin.cmake")
endif()
