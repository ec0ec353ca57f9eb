# cmake -DIMAGE=fencepost -DDRIVE=RPI-RP2 -DPART=rp2040 -P flash_pico.cmake: copies IMAGE.uf2 to the drive that the board
# shows, else asks picotool, else openocd with IMAGE.elf.
foreach(drive /media/$ENV{USER}/${DRIVE} /run/media/$ENV{USER}/${DRIVE} /media/${DRIVE} /mnt/${DRIVE} /Volumes/${DRIVE})
  if(EXISTS "${drive}/INFO_UF2.TXT")  # an empty folder is a drive that is not mounted
    file(COPY "${IMAGE}.uf2" DESTINATION "${drive}")
    execute_process(COMMAND ${CMAKE_COMMAND} -E env sync ERROR_QUIET OUTPUT_QUIET)  # it may be unplugged at once
    message(STATUS "${IMAGE}.uf2 copied to ${drive}; the board starts it at once")
    return()
  endif()
endforeach()
message(STATUS "No drive ${DRIVE} is mounted; trying picotool, then openocd")
find_program(picotool picotool)
if(picotool)
  execute_process(COMMAND ${picotool} load -v -x ${IMAGE}.uf2 RESULT_VARIABLE status)
  if(status EQUAL 0)
    return()
  endif()
endif()
find_program(openocd openocd)
if(NOT openocd)
  message(FATAL_ERROR "Neither could be used: openocd is not installed (Debian: apt-get install openocd).")
endif()
execute_process(COMMAND ${openocd} -f interface/cmsis-dap.cfg -f target/${PART}.cfg -c "adapter speed 5000"
  -c "program ${IMAGE}.elf verify reset exit" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "openocd found no board, or could not talk to it.")
endif()
