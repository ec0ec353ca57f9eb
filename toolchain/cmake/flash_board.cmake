# cmake -DTOOL=... -DHINT=... -DCOMMAND=a;b;c -P flash_board.cmake: puts an image onto a board, or says what is missing.
find_program(tool ${TOOL})
if(NOT tool)
  message(FATAL_ERROR "${TOOL} is not installed (Debian: apt-get install ${TOOL}). ${HINT}")
endif()
execute_process(COMMAND ${COMMAND} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The image was not written: ${TOOL} found no board, or could not talk to it. ${HINT}")
endif()
