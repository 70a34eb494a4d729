# UNDERSTUDY_SANITIZE holds what -fsanitize= takes; everything we compile and link gets it.
if(UNDERSTUDY_SANITIZE)
  add_compile_options(-fsanitize=${UNDERSTUDY_SANITIZE} -fno-omit-frame-pointer)
  # GCC cannot tell any more what is initialised once the sanitizers have had their say.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${UNDERSTUDY_SANITIZE})
endif()
