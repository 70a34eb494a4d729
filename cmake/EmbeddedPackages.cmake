# The packages that worlds need, for Understudy itself and for programs that are built with its CMake package.
include(${CMAKE_CURRENT_LIST_DIR}/DebianPackage.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/Mujoco.cmake)
understudy_package(tinyxml2 HEADER tinyxml2.h LIBRARIES tinyxml2 DEBIAN libtinyxml2-dev)
understudy_package(eigen HEADER Eigen/Core SUFFIX eigen3 DEBIAN libeigen3-dev)
understudy_package(yaml HEADER yaml-cpp/yaml.h LIBRARIES yaml-cpp DEBIAN libyaml-cpp-dev)
understudy_package(png HEADER png.h LIBRARIES png DEBIAN libpng-dev)
understudy_package(json HEADER nlohmann/json.hpp DEBIAN nlohmann-json3-dev)
understudy_package(boost_random HEADER boost/random.hpp DEBIAN libboost-dev)
