# The cameras of images, from the headers of firmware/image/cameras. The first struct of each is a camera, of the two-wire
# bus where its name ends in I2c. Two headers are made of them in the build tree for targets that link
# fencepost_image_cameras: cameras/all.hpp and cameras/two_wire.hpp.
file(GLOB headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/firmware/image/cameras/*.hpp")
# The Pixy2 first: images begin with it, and a turn of the loop asks in this order.
list(SORT headers)
set(first ${headers})
list(FILTER first INCLUDE REGEX "/pixy2")
list(REMOVE_ITEM headers ${first})
set(FENCEPOST_IMAGE_CAMERAS "")
set(all "")
set(two_wire "")
set(all_includes "")
set(two_wire_includes "")
foreach(header ${first} ${headers})
  file(STRINGS "${PROJECT_SOURCE_DIR}/${header}" camera REGEX "^struct [A-Za-z0-9]+ : ")
  if(NOT camera OR header MATCHES "/console.hpp$")
    continue()
  endif()
  string(REGEX REPLACE "^struct ([A-Za-z0-9]+) : .*" "\\1" camera "${camera}")
  list(APPEND FENCEPOST_IMAGE_CAMERAS ${camera})
  string(APPEND all ", ${camera}")
  string(APPEND all_includes "#include \"${header}\"\n")
  if(camera MATCHES "I2c$")
    string(APPEND two_wire ", ${camera}")
    string(APPEND two_wire_includes "#include \"${header}\"\n")
  endif()
endforeach()
set(FENCEPOST_IMAGE_CAMERAS ${FENCEPOST_IMAGE_CAMERAS} PARENT_SCOPE)
foreach(list all two_wire)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/cameras/${list}.hpp" @ONLY CONTENT
"// Made by FencepostCameras.cmake.
#pragma once

#include \"firmware/image/camera_choice.hpp\"
#include \"firmware/image/cameras/console.hpp\"
@${list}_includes@
namespace fencepost::image {

/// In the order in which a turn of the loop asks which it is.
using Camera = CameraChoice<ConsoleCamera@${list}@>;

}  // namespace fencepost::image
")
endforeach()
add_library(fencepost_image_cameras INTERFACE)
target_include_directories(fencepost_image_cameras INTERFACE "${PROJECT_BINARY_DIR}/generated")
