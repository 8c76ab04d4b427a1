# What `cmake --install` puts where, and the packages that `cpack -G DEB` makes of it. Components: runtime (program, core,
# plugins, recipes), sdk (headers, find_package(foam), templates of plugins), gpl (plugins under the GPL), python (the package foam, and with it `foam bench` without
# collision engines).
# The build folder serves as an SDK too: CMAKE_PREFIX_PATH=<build folder>.

install(DIRECTORY configs schemas DESTINATION "${CMAKE_INSTALL_DATADIR}/foam" COMPONENT runtime
  PATTERN "*.py" EXCLUDE PATTERN __pycache__ EXCLUDE)
install(DIRECTORY apps/foam/templates DESTINATION "${CMAKE_INSTALL_DATADIR}/foam" COMPONENT sdk)
# The build folder has the same at the same place.
foreach(FOLDER IN ITEMS configs apps/foam/templates)
  cmake_path(GET FOLDER FILENAME NAME)
  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/share/foam")
  file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${FOLDER}" "${CMAKE_BINARY_DIR}/share/foam/${NAME}" SYMBOLIC)
endforeach()
install(FILES README.md CHANGELOG.md LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
if(EXISTS "${CMAKE_SOURCE_DIR}/docs") # a source distribution of Python has none
  install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime PATTERN html EXCLUDE)
endif()
# Debian reads the licence of each package in a folder of its name.
set(FOAM_COPYRIGHT_FOLDER "${CMAKE_INSTALL_DATADIR}/doc")
install(FILES core/cmake/debian/copyright DESTINATION "${FOAM_COPYRIGHT_FOLDER}/foam" COMPONENT runtime)
install(FILES core/cmake/debian/copyright DESTINATION "${FOAM_COPYRIGHT_FOLDER}/foam-dev" COMPONENT sdk)
if(FOAM_GPL)
  install(FILES core/cmake/debian/copyright_gpl RENAME copyright DESTINATION "${FOAM_COPYRIGHT_FOLDER}/foam-plugins-gpl" COMPONENT gpl)
endif()
if(TARGET foam_python)
  install(FILES core/cmake/debian/copyright DESTINATION "${FOAM_COPYRIGHT_FOLDER}/python3-foam" COMPONENT python)
endif()

set(CPACK_PACKAGE_VENDOR "The foam authors")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR} <foam@localhost>")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime sdk gpl)
if(TARGET foam_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "foam in Python: import foam; experiments: foam bench")
  set(CPACK_COMPONENT_PYTHON_DEPENDS runtime)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-foam)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  math(EXPR FOAM_NEXT_PYTHON "${FOAM_PYTHON_MINOR} + 1") # a module is for one version of Python
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${FOAM_PYTHON_MINOR}), python3 (<< 3.${FOAM_NEXT_PYTHON}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib, python3-yaml") # foam bench
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_SOURCE_DIR}/python/debian/postinst;${CMAKE_SOURCE_DIR}/python/debian/prerm")
endif()
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Turns robots and objects into spheres, with a proof that the geometry is inside")
set(CPACK_COMPONENT_SDK_DESCRIPTION "Headers and CMake files for plugins of foam")
set(CPACK_COMPONENT_GPL_DESCRIPTION "Plugins of foam that use CGAL's GPL packages: spherize.medial, repair.wrap")
set(CPACK_COMPONENT_SDK_DEPENDS runtime)
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
include(CPack)
