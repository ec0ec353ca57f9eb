# A unity build compiles the sources of a target together, in half the time. These stay apart: their sources give one
# name to different things. A new target for which that is so says it by errors about redefinitions, and belongs here.
set(apart
  alert_study console_test loop_test board_gba_test cli_test emulate_scene_test emulate_test fencepost_devices fencepost_emulate_models fencepost_exe
  fencepost_hal_linux fencepost_live fencepost_recon fencepost_result fencepost_scene fencepost_soak guest_run_test hal_fake_test
  hal_linux_test identity_test live_test nxt_test nxtcam_test odometry_test paper_test pixy2_test real_input_test
  recon_sheaf_test recon_test recorder_test replay_test stack_objects wire_test)
foreach(target IN LISTS apart)
  if(TARGET ${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
endforeach()
