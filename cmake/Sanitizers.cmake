# UNDERSTUDY_SANITIZE holds what -fsanitize= takes; everything we compile and link gets it.
if(UNDERSTUDY_SANITIZE)
  add_compile_options(-fsanitize=${UNDERSTUDY_SANITIZE} -fno-omit-frame-pointer)
  # GCC cannot tell any more what is initialised once the sanitizers have had their say.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${UNDERSTUDY_SANITIZE})
endif()

# Lets a library of ours parse the headers that nearly every file includes once. Only where sanitizers are on, in builds
# that are made to run the tests once: the others find an include that a file forgot.
function(understudy_precompile target)
  if(UNDERSTUDY_SANITIZE)
    target_precompile_headers(${target} PRIVATE <algorithm> <filesystem> <functional> <map> <memory> <string> <vector>
                              <nlohmann/json.hpp>)
  endif()
endfunction()
