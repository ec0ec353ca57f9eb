# cpack: Debian packages, fencepost, libfencepost-dev and the shared library that it needs. `toolchain/package deb` configures for them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fencepost)
set(CPACK_PACKAGE_VENDOR "The Fencepost authors")
# Nobody reads mail there: a distribution that takes the package puts its own maintainer here.
set(CPACK_PACKAGE_CONTACT "The Fencepost authors <fencepost@users.noreply.github.com>")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME fencepost)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "obstacle maps and alerts from coloured blobs and wheel odometry")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"A small robot with a blob camera and wheel odometry sees coloured boxes,
nothing else. Fencepost turns them into objects with a place, an outline and
an uncertainty, and warns before the robot hits one.

This is the desk's program: it runs the robot's loop on a Linux machine's
cameras and wheels, records what a robot's board says, replays, draws and
evaluates it, simulates robots and speaks as their devices.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# CPack's own would call ldconfig in scripts, where Debian has a trigger.
set(control "${PROJECT_BINARY_DIR}/debian_runtime")
file(WRITE "${control}/triggers" "activate-noawait ldconfig\n")
file(WRITE "${control}/shlibs"
  "libfencepost ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} ${runtime_package} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${control}/triggers;${control}/shlibs")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION
"The C interface of a library without a heap: odometry and coloured blobs in,
alerts, objects and outlines out. Programs and other languages load it.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${runtime_package} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfencepost-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
  "libfmt-dev, pkg-config, cmake")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"The robot's program as a library without a heap, for programs of one's own in
C and C++: odometry and boxes in, alerts, objects and outlines out. Other
languages load the shared one. Replay at the desk is another, which needs the
packages that this one suggests.")

# The files that Debian's policy asks for in /usr/share/doc. The changelog's day is that of the commit, or of
# SOURCE_DATE_EPOCH.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  execute_process(COMMAND git -C "${PROJECT_SOURCE_DIR}" log -1 --format=%cd --date=format:%s
    OUTPUT_VARIABLE seconds OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    set(seconds "$ENV{SOURCE_DATE_EPOCH}")
  endif()
  execute_process(COMMAND date -u -R -d "@${seconds}" OUTPUT_VARIABLE day OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(folder "${PROJECT_BINARY_DIR}/debian")
  file(WRITE "${folder}/changelog.Debian" "fencepost (${PROJECT_VERSION}-1) unstable; urgency=medium

  * As built by toolchain/package; what is new is in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}
")
  file(COPY_FILE "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${folder}/changelog")
  execute_process(COMMAND ${FENCEPOST_GZIP} -9nf changelog changelog.Debian WORKING_DIRECTORY "${folder}")
  foreach(component program runtime development)
    string(TOUPPER ${component} upper)
    install(FILES "${folder}/changelog.Debian.gz" "${folder}/changelog.gz"
      DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
  endforeach()
endif()
include(CPack)
