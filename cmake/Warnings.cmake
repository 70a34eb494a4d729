# Warnings for our own code; generated and third-party code stays out of it.
add_library(understudy_warnings INTERFACE)
target_compile_options(understudy_warnings INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror)
