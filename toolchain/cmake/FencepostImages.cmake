# Libraries that read, filter and draw images on the desk: PNG, and two modules of OpenCV.
find_package(PNG REQUIRED)

# Not find_package: Debian has OpenCV's CMake files only in the package of all its modules, which brings half a desktop.
# Its own reader and writer of images would pull in 120 libraries more, and 0.2 s at each start of the program.
find_path(FENCEPOST_OPENCV_INCLUDE opencv2/imgproc.hpp PATH_SUFFIXES opencv4 REQUIRED)
find_library(FENCEPOST_OPENCV_CORE opencv_core REQUIRED)
find_library(FENCEPOST_OPENCV_IMGPROC opencv_imgproc REQUIRED)
add_library(fencepost_opencv INTERFACE)
target_include_directories(fencepost_opencv SYSTEM INTERFACE "${FENCEPOST_OPENCV_INCLUDE}")
target_link_libraries(fencepost_opencv INTERFACE "${FENCEPOST_OPENCV_IMGPROC}" "${FENCEPOST_OPENCV_CORE}")
