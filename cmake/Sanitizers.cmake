# UNDERSTUDY_SANITIZE holds what -fsanitize= takes; everything we compile and link gets it, but for the checks in
# UNDERSTUDY_NOT_SANITIZED. Of the preset `asan` these four take a third of the compiler's time: a null pointer ends a
# program anyway, nothing is told of sizes unoptimised, and the preset `fuzz` has them all.
if(UNDERSTUDY_SANITIZE)
  add_compile_options(-fsanitize=${UNDERSTUDY_SANITIZE} -fno-omit-frame-pointer)
  if(UNDERSTUDY_NOT_SANITIZED)
    add_compile_options(-fno-sanitize=${UNDERSTUDY_NOT_SANITIZED})
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # GCC cannot tell any more what is initialised once the sanitizers have had their say.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
  add_link_options(-fsanitize=${UNDERSTUDY_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    # Tests that count allocations have an operator new; Clang's runtime has one that does not give way.
    add_link_options(-Wl,--allow-multiple-definition)
  endif()
endif()
