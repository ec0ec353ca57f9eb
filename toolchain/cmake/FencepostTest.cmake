# Tests' own code, a third of what sanitizers make a build cost, goes without those checks that the address sanitizer's
# traps or the boards make as well.
add_library(fencepost_test_flags INTERFACE)
target_link_libraries(fencepost_test_flags INTERFACE fencepost_flags GTest::gtest GTest::gtest_main)
if(FENCEPOST_SANITIZE MATCHES "undefined")
  target_compile_options(fencepost_test_flags INTERFACE
    -fno-sanitize=null,alignment,object-size,vptr,return,unreachable,nonnull-attribute,returns-nonnull-attribute)
endif()

# fencepost_test(<name> SOURCES a.cpp ... LIBRARIES x ...): one GoogleTest program, its cases known to CTest.
function(fencepost_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} fencepost_test_flags)
  # Recordings by others live beside the checkout and are never part of it; tests that need them skip without.
  target_compile_definitions(${name} PRIVATE
    FENCEPOST_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    FENCEPOST_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  # Cases are numbered, not named by their values, which may be whole documents.
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
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
