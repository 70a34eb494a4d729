# The packages of Debian that all of Understudy needs.
find_package(Threads REQUIRED)
include(cmake/EmbeddedPackages.cmake)
understudy_package(cyclonedds HEADER dds/dds.h LIBRARIES ddsc DEBIAN cyclonedds-dev)
understudy_package(zlib HEADER zlib.h LIBRARIES z DEBIAN zlib1g-dev)
understudy_package(sqlite HEADER sqlite3.h LIBRARIES sqlite3 DEBIAN libsqlite3-dev)
understudy_package(lz4 HEADER lz4.h LIBRARIES lz4 DEBIAN liblz4-dev)
understudy_package(zstd HEADER zstd.h LIBRARIES zstd DEBIAN libzstd-dev)
understudy_package(log HEADER spdlog/spdlog.h LIBRARIES spdlog fmt DEBIAN "libspdlog-dev libfmt-dev"
                   DEFINE SPDLOG_COMPILED_LIB SPDLOG_SHARED_LIB SPDLOG_FMT_EXTERNAL)
understudy_package(cli11 HEADER CLI/CLI.hpp DEBIAN libcli11-dev)
# Compiled once, by client/boost.cc.
understudy_package(boost HEADER boost/beast.hpp DEBIAN libboost-dev
                   DEFINE BOOST_ASIO_SEPARATE_COMPILATION BOOST_BEAST_SEPARATE_COMPILATION)
if(UNDERSTUDY_SANITIZE MATCHES thread)
  # ThreadSanitizer does not know fences; Asio needs none where only one thread runs its loop.
  target_compile_definitions(Understudy::boost INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK)
endif()
if(UNDERSTUDY_VIEWER)
  understudy_package(glfw HEADER GLFW/glfw3.h LIBRARIES glfw DEBIAN libglfw3-dev)
  understudy_package(jpeg HEADER turbojpeg.h LIBRARIES turbojpeg DEBIAN libturbojpeg0-dev)
  understudy_package(x264 HEADER x264.h LIBRARIES x264 DEBIAN libx264-dev)
  # Its header alone: the library is loaded where it is wanted (viewer/headless_gl.h).
  understudy_package(egl HEADER EGL/egl.h DEBIAN libegl-dev)
endif()
if(UNDERSTUDY_BUILD_TESTS)
  understudy_package(gtest HEADER gmock/gmock.h LIBRARIES gmock gtest gtest_main DEBIAN "libgtest-dev libgmock-dev")
  target_link_libraries(Understudy::gtest INTERFACE Threads::Threads)
endif()
