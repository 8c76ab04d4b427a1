# find_package(foam [COMPONENTS library...]): the libraries foam::base, foam::geometry, foam::xml, foam::robot,
# foam::collision, foam::search, foam::sdk, foam::yaml, foam::recipe, foam::report, foam::runtime, foam::judge, foam::view and foam::batch, foam::c (foam.h, for projects in C), the program foam::program, foam_add_plugin() and foam_test_plugin().
# A library brings those that it uses.
if(NOT TARGET foam::base) # in foam's own tree they are there already
  include("${CMAKE_CURRENT_LIST_DIR}/foamTargets.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/FoamPlugin.cmake")
endif()
foreach(COMPONENT IN LISTS foam_FIND_COMPONENTS)
  if(TARGET foam::${COMPONENT})
    set(foam_${COMPONENT}_FOUND TRUE)
  elseif(foam_FIND_REQUIRED_${COMPONENT})
    set(foam_FOUND FALSE)
    set(foam_NOT_FOUND_MESSAGE "foam has no library ${COMPONENT}")
  endif()
endforeach()
