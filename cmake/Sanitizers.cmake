# UNDERSTUDY_SANITIZE holds what -fsanitize= takes; everything we compile and link gets it.
if(UNDERSTUDY_SANITIZE)
  add_compile_options(-fsanitize=${UNDERSTUDY_SANITIZE} -fno-omit-frame-pointer)
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
