# Run by CPack before it packs: makes of what `cmake --install` installs what Debian's policy asks of a package.
set(root ${CPACK_TEMPORARY_DIRECTORY})
set(packaging ${CPACK_UNDERSTUDY_SOURCE_DIR}/packaging)
set(doc ${root}/usr/share/doc/understudy)

# place(FILE AS): a copy that all may read.
function(place file as)
  get_filename_component(folder ${as} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(COPY_FILE ${file} ${as})
  file(CHMOD ${as} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()

function(compress)
  execute_process(COMMAND gzip -9n ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Debian's zsh reads what packages bring from a folder of its own.
file(MAKE_DIRECTORY ${root}/usr/share/zsh/vendor-completions)
file(RENAME ${root}/usr/share/zsh/site-functions/_understudy ${root}/usr/share/zsh/vendor-completions/_understudy)
file(REMOVE_RECURSE ${root}/usr/share/zsh/site-functions)

place(${packaging}/systemd/system.service ${root}/lib/systemd/system/understudy@.service)
place(${packaging}/systemd/user.service ${root}/usr/lib/systemd/user/understudy@.service)
place(${packaging}/system/default ${root}/etc/default/understudy)
foreach(example limits.conf sysctl.conf gamepads.rules)
  place(${packaging}/system/${example} ${doc}/examples/system/${example})
endforeach()
foreach(example ci container course two_joint_arm)
  file(CREATE_LINK ../../../understudy/examples/${example} ${doc}/examples/${example} SYMBOLIC)
endforeach()

# The licence, in the form of a field of several lines.
file(READ ${CPACK_UNDERSTUDY_SOURCE_DIR}/LICENSE license)
string(REGEX REPLACE "^.*authors\n\n" "" license "${license}")
string(REGEX REPLACE "\n+$" "" license "${license}")
string(REPLACE "\n" "\n " license " ${license}")
string(REPLACE "\n \n" "\n .\n" license "${license}")
configure_file(${packaging}/debian/copyright.in ${doc}/copyright @ONLY)

execute_process(COMMAND date --utc --rfc-email --date ${CPACK_UNDERSTUDY_RELEASED}
                OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
configure_file(${packaging}/debian/changelog.in ${doc}/changelog.Debian @ONLY)
compress(${doc}/changelog.Debian)
file(GLOB pages ${root}/usr/share/man/man1/*.1)
compress(${pages})
