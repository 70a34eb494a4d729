# Warnings for our own code; generated and third-party code stays out of it.
add_library(understudy_warnings INTERFACE)
target_compile_options(understudy_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow)
# For us: a compiler that warns of more than ours must not stop somebody who only wants to run Understudy.
option(UNDERSTUDY_WERROR "Treat warnings as errors" OFF)
if(UNDERSTUDY_WERROR)
  target_compile_options(understudy_warnings INTERFACE -Werror)
endif()
# GCC 12 sees an overlap in `"text" + std::to_string(x)` at -O3 that is not there (GCC bug 105651, mended in 13).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(understudy_warnings INTERFACE -Wno-restrict)
endif()
