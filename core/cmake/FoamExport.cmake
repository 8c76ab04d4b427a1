# find_package(foam), from the build folder and from an installation.
set(FOAM_SDK_INSTALLED "${CMAKE_INSTALL_LIBDIR}/cmake/foam")
export(EXPORT foamTargets NAMESPACE foam:: FILE "${foam_DIR}/foamTargets.cmake")
install(EXPORT foamTargets NAMESPACE foam:: DESTINATION "${FOAM_SDK_INSTALLED}" COMPONENT sdk)
install(FILES "${foam_DIR}/foamConfig.cmake" "${foam_DIR}/foamConfigVersion.cmake" DESTINATION "${FOAM_SDK_INSTALLED}" COMPONENT sdk)
if(TARGET foam_sdk)
  install(FILES "${foam_DIR}/FoamPlugin.cmake" DESTINATION "${FOAM_SDK_INSTALLED}" COMPONENT sdk)
endif()
