# A unity build compiles the sources of a target together, in half the time. These sources stay apart, since they give a
# name that another source of their target gives, too. A new one for which that is so says it by errors about
# redefinitions, and belongs here.
set(fencepost_unity_apart
  board_gba_test link_port.cpp
  cli_test emulate_test.cpp
  cli_test segment_test.cpp
  cli_test usage_test.cpp
  emulate_scene_test scene/wheel_drivers_test.cpp
  emulate_test models/nxtcam5_test.cpp
  emulate_test models/nxtcam_test.cpp
  emulate_test models/pixy2_test.cpp
  fencepost_hal_linux can.cpp
  fencepost_hal_linux i2c_adapter.cpp
  fencepost_hal_linux spi.cpp
  fencepost_hal_linux tcp.cpp
  fencepost_hal_linux usb_device.cpp
  fencepost_hazards ../alerts/approach.cpp
  fencepost_hazards ../common/random_footprint.cpp
  fencepost_hazards families/movers.cpp
  fencepost_hazards families/removal.cpp
  fencepost_scene write.cpp
  guest_run_test run_nxt_test.cpp
  hal_fake_test fake/scripted_packets_test.cpp
  hal_linux_test linux/tty_test.cpp
  live_test run_log_test.cpp
  live_test write_behind_test.cpp
  loop_test pipeline_test.cpp
  nxt_test conversation_test.cpp
  nxt_test sensor_port_test.cpp
  nxt_test tacho_odometry_test.cpp
  nxtcam_test serial_camera_test.cpp
  nxtcam_test serial_test.cpp
  nxtcam_test v5_camera_test.cpp
  odometry_test tick_counter_test.cpp
  paper_test plan_test.cpp
  pixy2_test chirp_test.cpp
  pixy2_test protocol_test.cpp
  real_input_test rings_test.cpp
  recon_sheaf_test models/sheaf_test.cpp
  recon_test models/cylinder_paper_test.cpp
  recon_test track/pieces_test.cpp
  recorder_test tally_test.cpp
  replay_test replay_test.cpp
  simulate_test world_test.cpp
  wire_test i2c_stream_test.cpp)
list(LENGTH fencepost_unity_apart words)
math(EXPR last "${words} - 1")
foreach(i RANGE 0 ${last} 2)
  math(EXPR j "${i} + 1")
  list(GET fencepost_unity_apart ${i} target)
  list(GET fencepost_unity_apart ${j} source)
  if(TARGET ${target})
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    if(NOT source IN_LIST sources)
      message(FATAL_ERROR "toolchain/cmake/FencepostUnity.cmake names ${source}, which is no source of ${target}")
    endif()
    set_source_files_properties(${folder}/${source} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endforeach()
foreach(target IN ITEMS alert_study)
  if(TARGET ${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
endforeach()
