# What `cmake --install` puts where, and the packages that `cpack -G DEB` makes of it. Components: runtime (program, core,
# plugins, recipes), sdk (headers, find_package(foam), templates of plugins), gpl (plugins under the GPL), bench (the program of `foam bench`, without collision engines).
# The build folder serves as an SDK too: CMAKE_PREFIX_PATH=<build folder>.

set(FOAM_SDK_INSTALLED "${CMAKE_INSTALL_LIBDIR}/cmake/foam")

export(EXPORT foamTargets NAMESPACE foam:: FILE "${foam_DIR}/foamTargets.cmake")
install(EXPORT foamTargets NAMESPACE foam:: DESTINATION "${FOAM_SDK_INSTALLED}" COMPONENT sdk)
install(FILES "${foam_DIR}/foamConfig.cmake" "${foam_DIR}/foamConfigVersion.cmake" "${foam_DIR}/FoamPlugin.cmake"
  DESTINATION "${FOAM_SDK_INSTALLED}" COMPONENT sdk)
install(DIRECTORY configs schemas DESTINATION "${CMAKE_INSTALL_DATADIR}/foam" COMPONENT runtime
  PATTERN "*.py" EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY apps/foam/templates DESTINATION "${CMAKE_INSTALL_DATADIR}/foam" COMPONENT sdk)
# The build folder has the same at the same place.
foreach(FOLDER IN ITEMS configs apps/foam/templates)
  cmake_path(GET FOLDER FILENAME NAME)
  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/share/foam")
  file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${FOLDER}" "${CMAKE_BINARY_DIR}/share/foam/${NAME}" SYMBOLIC)
endforeach()
install(FILES README.md LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)

set(CPACK_PACKAGE_VENDOR "The foam authors")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR} <foam@localhost>")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime sdk gpl bench)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Turns robots and objects into spheres, with a proof that the geometry is inside")
set(CPACK_COMPONENT_SDK_DESCRIPTION "Headers and CMake files for plugins of foam")
set(CPACK_COMPONENT_GPL_DESCRIPTION "Plugins of foam that use CGAL's GPL packages: spherize.medial, repair.wrap")
set(CPACK_COMPONENT_BENCH_DESCRIPTION "Experiments of foam: foam bench")
set(CPACK_COMPONENT_SDK_DEPENDS runtime)
set(CPACK_COMPONENT_BENCH_DEPENDS runtime)
set(CPACK_COMPONENT_GPL_DEPENDS runtime)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/lib")
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME foam)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS foam-plugins-gpl)
set(CPACK_DEBIAN_SDK_PACKAGE_NAME foam-dev)
set(CPACK_DEBIAN_SDK_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_SDK_PACKAGE_RECOMMENDS "cmake, g++")
set(CPACK_DEBIAN_GPL_PACKAGE_NAME foam-plugins-gpl)
set(CPACK_DEBIAN_BENCH_PACKAGE_NAME foam-bench)
include(CPack)
