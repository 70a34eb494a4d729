# MuJoCo: Debian's 2.2.2, or the folder that a mujoco wheel from PyPI unpacks to, for MuJoCo 3 (docs/dev/mujoco3.md).
set(UNDERSTUDY_MUJOCO_DIR "" CACHE PATH "Folder with include/mujoco and libmujoco.so.*; empty takes the system's MuJoCo")
if(NOT UNDERSTUDY_MUJOCO_DIR)
  understudy_package(mujoco HEADER mujoco/mujoco.h LIBRARIES mujoco DEBIAN libmujoco-dev)
  return()
endif()

# The renderer's functions differ from version to version of MuJoCo 3; what looks at a robot is written for Debian's.
set(UNDERSTUDY_VIEWER OFF)

file(GLOB UNDERSTUDY_MUJOCO_LIBRARY ${UNDERSTUDY_MUJOCO_DIR}/libmujoco.so*)
list(LENGTH UNDERSTUDY_MUJOCO_LIBRARY count)
if(NOT count EQUAL 1 OR NOT EXISTS ${UNDERSTUDY_MUJOCO_DIR}/include/mujoco/mujoco.h)
  message(FATAL_ERROR "UNDERSTUDY_MUJOCO_DIR=${UNDERSTUDY_MUJOCO_DIR}: expected include/mujoco/mujoco.h and one libmujoco.so* there")
endif()
understudy_imported(mujoco ${UNDERSTUDY_MUJOCO_DIR}/include)
target_link_libraries(Understudy::mujoco INTERFACE ${UNDERSTUDY_MUJOCO_LIBRARY})
