# understudy_idl_library(NAME FILES file.idl... [LINK other...])
#
# One static library per IDL family, compiled by the idlc that Cyclone DDS brings. A file may
# include those beside it: its directory is on the include path. LINK names the libraries made here
# whose files it includes, so that a change there compiles it anew, which idlc_generate() does not.
# Programs write #include "idl/<file>.h". Neither headers nor C are our code: the headers are system
# headers, and the C is compiled without warnings.
find_program(UNDERSTUDY_IDLC idlc REQUIRED NO_CMAKE_FIND_ROOT_PATH)

function(understudy_idl_library name)
  cmake_parse_arguments(ARG "" "" "FILES;LINK" ${ARGN})
  set(root ${PROJECT_BINARY_DIR}/generated)
  file(MAKE_DIRECTORY ${root}/idl)

  set(files "")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(path ${file} ABSOLUTE)
    list(APPEND files ${path})
  endforeach()
  set(known_files ${files})
  foreach(library IN LISTS ARG_LINK)
    get_target_property(linked ${library} UNDERSTUDY_IDL_FILES)
    list(APPEND known_files ${linked})
  endforeach()
  list(REMOVE_DUPLICATES known_files)

  set(sources "")
  foreach(path IN LISTS files)
    get_filename_component(stem ${path} NAME_WE)
    get_filename_component(folder ${path} DIRECTORY)
    set(outputs ${root}/idl/${stem}.c ${root}/idl/${stem}.h)
    add_custom_command(
      OUTPUT ${outputs}
      COMMAND ${UNDERSTUDY_IDLC} -I ${folder} -o idl ${path}
      WORKING_DIRECTORY ${root}
      DEPENDS ${known_files} ${UNDERSTUDY_IDLC}
      COMMENT "Compiling ${stem}.idl"
      VERBATIM)
    list(APPEND sources ${outputs})
  endforeach()

  add_library(${name} STATIC ${sources})
  target_include_directories(${name} SYSTEM PUBLIC ${root})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} cyclonedds)
  target_compile_options(${name} PRIVATE -w)
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF UNDERSTUDY_IDL_FILES "${known_files}")
endfunction()
