# cmake --install: the programs with what they read, and, for programs of others, the core and the desk's replay as
# libraries. Three components, program, runtime and development: a package each (FencepostPackage.cmake). Without FENCEPOST_LAB
# the first program alone, which is all that such a build makes.
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Fencepost")

if(FENCEPOST_DESK)
  install(TARGETS fencepost_exe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  foreach(part blocks can recordings doc examples python schema)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/host/share/${part}" DESTINATION ${CMAKE_INSTALL_DATADIR}/fencepost
      COMPONENT program PATTERN __pycache__ EXCLUDE)
  endforeach()
  install(FILES "${PROJECT_SOURCE_DIR}/host/web/dist/fencepost.html" DESTINATION ${CMAKE_INSTALL_DATADIR}/fencepost/page
    COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/fencepost RENAME copyright
    COMPONENT program)
  set(made "${PROJECT_BINARY_DIR}/host/cli/made")
  set(zsh_folder zsh/site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(zsh_folder zsh/vendor-completions)  # where Debian's zsh looks for what packages bring
  endif()
  install(DIRECTORY "${made}/man1" DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES "${made}/fencepost" DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES "${made}/_fencepost" DESTINATION ${CMAKE_INSTALL_DATADIR}/${zsh_folder} COMPONENT program)
  install(FILES "${made}/fencepost.fish" DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
  if(NOT FENCEPOST_LAB)
    return()
  endif()
  # Where `fencepost` looks for it.
  install(TARGETS fencepost_lab_exe RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/fencepost COMPONENT program)
  set(libraries fencepost_core fencepost_shared fencepost_host)
  set(headers host/fencepost/replay.hpp)
else()
  set(libraries fencepost_core fencepost_shared)
  set(headers "")
endif()

install(TARGETS ${libraries} EXPORT FencepostTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
install(EXPORT FencepostTargets NAMESPACE Fencepost:: DESTINATION ${package_folder} COMPONENT development)
# All headers are public, and include no other of this project.
foreach(header firmware/fencepost/fencepost.h firmware/fencepost/fencepost.hpp ${headers})
  install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fencepost COMPONENT development)
endforeach()
set(runtime_package libfencepost${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # by its soname
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libfencepost-dev RENAME copyright
  COMPONENT development)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${runtime_package} RENAME copyright
  COMPONENT runtime)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/FencepostConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/FencepostConfig.cmake" INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/FencepostConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/FencepostConfig.cmake" "${PROJECT_BINARY_DIR}/FencepostConfigVersion.cmake"
  DESTINATION ${package_folder} COMPONENT development)

# Relative to where the file is found, so that an installation may be moved; an absolute folder stays.
if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" AND NOT IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  string(REGEX REPLACE "[^/]+" ".." up "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  set(FENCEPOST_PREFIX "\${pcfiledir}/${up}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/fencepost.pc.in" "${PROJECT_BINARY_DIR}/fencepost.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/fencepost.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endif()

if(FENCEPOST_DESK AND PROJECT_IS_TOP_LEVEL)
  include(FencepostPackage)
endif()
