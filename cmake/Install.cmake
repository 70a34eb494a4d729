# The CMake package for programs that have worlds of their own (docs/reference/embedding.md).
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Understudy)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/understudy)
set(UNDERSTUDY_PACKAGE_DATA ${CMAKE_INSTALL_DATADIR}/understudy)

set(libraries ${UNDERSTUDY_EMBEDDED})
list(TRANSFORM libraries PREPEND understudy_)
install(TARGETS ${libraries} EXPORT UnderstudyTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/understudy COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${headers})
install(EXPORT UnderstudyTargets NAMESPACE Understudy:: DESTINATION ${package} COMPONENT development)
foreach(room ${UNDERSTUDY_EMBEDDED})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/src/${room})
    install(DIRECTORY src/${room} DESTINATION ${headers} COMPONENT development FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
install(FILES src/wire/robot_port.h src/wire/robot_topics.h src/wire/topic_list.inc DESTINATION ${headers}/wire COMPONENT development)
install(FILES src/services/call_refusal.h src/services/service_port.h DESTINATION ${headers}/services COMPONENT development)

configure_package_config_file(cmake/UnderstudyConfig.cmake.in ${PROJECT_BINARY_DIR}/UnderstudyConfig.cmake
                              INSTALL_DESTINATION ${package} PATH_VARS UNDERSTUDY_PACKAGE_DATA)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/UnderstudyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/UnderstudyConfig.cmake ${PROJECT_BINARY_DIR}/UnderstudyConfigVersion.cmake
              cmake/DebianPackage.cmake cmake/EmbeddedPackages.cmake cmake/Mujoco.cmake
        DESTINATION ${package} COMPONENT development)
