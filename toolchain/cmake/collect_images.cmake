# cmake -DSOURCE=... -DBUILD=... -DPRESETS=a;b -DOUT=... -P collect_images.cmake: builds the image of each preset and puts all
# of them into OUT, with their SHA-256 sums.
file(MAKE_DIRECTORY "${OUT}")
set(sums "")
foreach(preset ${PRESETS})
  execute_process(COMMAND ${CMAKE_COMMAND} --preset ${preset} -S ${SOURCE} -B ${BUILD}/${preset} WORKING_DIRECTORY ${SOURCE}
    COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD}/${preset} COMMAND_ERROR_IS_FATAL ANY)
  foreach(kind elf bin hex uf2 gba)
    if(EXISTS "${BUILD}/${preset}/fencepost.${kind}")
      set(name fencepost-${preset}.${kind})
      configure_file("${BUILD}/${preset}/fencepost.${kind}" "${OUT}/${name}" COPYONLY)
      file(SHA256 "${OUT}/${name}" sum)
      string(APPEND sums "${sum}  ${name}\n")
    endif()
  endforeach()
endforeach()
file(WRITE "${OUT}/SHA256SUMS" "${sums}")
message(STATUS "${OUT}: images and SHA256SUMS")
