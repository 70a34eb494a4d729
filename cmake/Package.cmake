# The Debian package: `tools/package`, docs/install.md.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME understudy)
set(CPACK_PACKAGE_CONTACT "The Understudy authors <understudy@packages.invalid>" CACHE STRING
    "Maintainer of the Debian package")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# Without the component `development`.
set(CPACK_INSTALL_CMAKE_PROJECTS ${PROJECT_BINARY_DIR} understudy Unspecified / ${PROJECT_BINARY_DIR} understudy data /)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 0understudy1)  # less than 1, with which Debian would begin
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulated Unitree robot that speaks the robot's own DDS")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Understudy plays a Unitree robot: it simulates a
quadruped, on feet or wheels, or a humanoid in MuJoCo and speaks the robot's
topics and services, so that a program written with Unitree SDK 2 (C++, Python
or ROS 2) runs against it unchanged.
.
It also puts robot and program into a private network for tests, plays and
judges scenarios, records and replays, and shows the robot in a window, in a
browser and in films.")
# Libraries by dpkg-shlibdeps; then what is loaded or run only where it is wanted.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl1, ffmpeg")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "xdg-utils")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "")
foreach(script conffiles prerm postrm)
  list(APPEND CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/${script})
endforeach()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# What only the package has.
set(CPACK_UNDERSTUDY_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_UNDERSTUDY_RELEASED ${UNDERSTUDY_RELEASED})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/stage.cmake)
include(CPack)
