# cmake -DPROGRAM=... -DTESTS=FILE.cmake "-DPROPERTIES=NAME;VALUE;..." [-DSTAGE=PROGRAM] -P: writes a CTest test for each
# suite of a GoogleTest program, which STAGE starts.
# To start a program with sanitizers for each of 3,600 cases costs more than most cases do.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests TIMEOUT 60 OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "_" listed "${listed}")  # in values of parameters, which CMake's lists would take apart
string(REPLACE "\n" ";" lines "${listed}")
string(REPLACE ";" " " properties "${PROPERTIES}")
set(script "")
set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.( *#.*)?$")
    set(suite "${CMAKE_MATCH_1}")
  elseif(line MATCHES "^  " AND NOT suite STREQUAL "" AND NOT "${suite}${line}" MATCHES "^(.*/)?DISABLED_|^[^ ]*  DISABLED_")
    string(APPEND script "add_test(${suite} ${STAGE} \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n"
      "set_tests_properties(${suite} PROPERTIES ${properties})\n")
    set(suite "")  # once
  endif()
endforeach()
file(WRITE "${TESTS}" "${script}")
