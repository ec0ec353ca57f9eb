add_library(fencepost_test_flags INTERFACE)
target_link_libraries(fencepost_test_flags INTERFACE fencepost_flags GTest::gtest GTest::gtest_main)

# The folder and the name of every test program, for tests/mutation/run.py.
set(FENCEPOST_TEST_PROGRAMS "${PROJECT_BINARY_DIR}/test_programs.txt")
file(WRITE "${FENCEPOST_TEST_PROGRAMS}" "")

# fencepost_test(<name> SOURCES a.cpp ... LIBRARIES x ... [EACH] [STAGED] [COST n]): one GoogleTest program.
# CTest knows its suites; with EACH its cases, as where one may skip, which CTest says of whole tests only. STAGED: on the
# clock of tests/stage, as what would wait in real time. What takes long has a COST: the dearest begin first.
function(fencepost_test name)
  cmake_parse_arguments(ARG "EACH;STAGED" "COST" "SOURCES;LIBRARIES" ${ARGN})
  # Of the three that toolchain/test has for each core: two that compute fill it and a half.
  set(properties TIMEOUT 300 PROCESSORS 2)
  if(ARG_COST)
    list(APPEND properties COST ${ARG_COST})
  endif()
  add_executable(${name} ${ARG_SOURCES})
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  file(APPEND "${FENCEPOST_TEST_PROGRAMS}" "${folder}/${name}\n")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} fencepost_test_flags)
  if(ARG_STAGED)
    set_target_properties(${name} PROPERTIES CROSSCOMPILING_EMULATOR "$<TARGET_FILE:stage>")
    add_dependencies(${name} stage)
  endif()
  if(TARGET fencepost_test_headers AND NOT fencepost_robot_flags IN_LIST ARG_LIBRARIES)
    target_precompile_headers(${name} REUSE_FROM fencepost_test_headers)
  endif()
  # Recordings by others live beside the checkout and are never part of it; tests that need them skip without.
  target_compile_definitions(${name} PRIVATE
    FENCEPOST_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    FENCEPOST_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  if(FENCEPOST_SANITIZE AND NOT ARG_COST)
    target_compile_options(${name} PRIVATE -O0)  # built a fifth sooner, and run once
  endif()
  foreach(source IN LISTS ARG_SOURCES)
    file(STRINGS "${source}" skips REGEX "GTEST_SKIP")
    if(skips)
      set(ARG_EACH TRUE)
    endif()
  endforeach()
  if(ARG_EACH)
    # Cases are numbered, not named by their values, which may be whole documents.
    gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
    return()
  endif()
  set(tests "${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake")
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS "${tests}" VERBATIM
    COMMAND ${CMAKE_COMMAND} -D "PROGRAM=$<TARGET_FILE:${name}>" -D "TESTS=${tests}" -D "PROPERTIES=${properties}"
      -D "STAGE=$<$<BOOL:${ARG_STAGED}>:$<TARGET_FILE:stage>>"
      -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/FencepostSuites.cmake")
  # Where it was not built: nothing to run, and CTest says so.
  set(include "${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake")
  file(WRITE "${include}" "if(EXISTS \"${tests}\")\n  include(\"${tests}\")\nelse()\n  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include}")
endfunction()

# fencepost_fuzzer(<name> SOURCE a.cpp LIBRARIES x ... [SEAL seal_x]): a program for endless fuzzing by hand, with
# -DFENCEPOST_FUZZ=ON and clang: <name> [corpus]. The same source belongs to an ordinary test, so that it cannot rot.
# SEAL: what puts the checksums right after each mutation, of tests/drivers/seal/seal.hpp.
function(fencepost_fuzzer name)
  if(NOT FENCEPOST_FUZZ OR NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    return()
  endif()
  cmake_parse_arguments(ARG "" "SOURCE;SEAL" "LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCE})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} fencepost_flags)
  if(ARG_SEAL)
    target_sources(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests/drivers/seal/mutator.cpp")
    target_compile_definitions(${name} PRIVATE FENCEPOST_SEAL=${ARG_SEAL})
    target_link_libraries(${name} PRIVATE fencepost_seal)
  endif()
  target_compile_options(${name} PRIVATE -fsanitize=fuzzer)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
endfunction()
