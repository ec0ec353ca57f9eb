# Compiler flags, in three interface targets: everything, the robot's code (hal, drivers, firmware), the desk's.

# A second build of the same sources is nearly free where ccache is installed, in another clone too; nothing needs it.
find_program(FENCEPOST_CCACHE ccache)
if(FENCEPOST_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${FENCEPOST_CCACHE}")
endif()
set(CMAKE_CXX_EXTENSIONS OFF)

add_library(fencepost_flags INTERFACE)
target_compile_features(fencepost_flags INTERFACE cxx_std_20)
target_include_directories(fencepost_flags INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_options(fencepost_flags INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Wundef
  -Wimplicit-fallthrough
  # The digest must not depend on the compiler's taste for fused multiply-adds.
  -ffp-contract=off)
# Windows's C library counts bytes in unsigned int; the same sources are checked everywhere else.
if(WIN32)
  target_compile_options(fencepost_flags INTERFACE -Wno-conversion -Wno-sign-conversion)
  target_compile_definitions(fencepost_flags INTERFACE _FILE_OFFSET_BITS=64 _POSIX_THREAD_SAFE_FUNCTIONS=200112L NOMINMAX)
  target_include_directories(fencepost_flags SYSTEM BEFORE INTERFACE "${PROJECT_SOURCE_DIR}/hal/windows/posix")
endif()
# GCC 12 warns about std::string's operator+ itself when optimising (GCC bug 105651, mended in 13).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(fencepost_flags INTERFACE -Wno-restrict)
endif()
# GCC collects its garbage early, over and over: later, it takes a twelfth less time and a quarter more memory.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(fencepost_flags INTERFACE --param=ggc-min-heapsize=1000000)
endif()
# Eigen's vector reductions add in another order; one definition for every translation unit that sees Eigen.
target_compile_definitions(fencepost_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_NO_MALLOC EIGEN_MPL2_ONLY)
# Folders with FENCEPOST_FEWER_CHECKS (host, tests) lack those checks that the address sanitizer's traps or the boards
# make as well. They are a quarter of what both sanitizers make a build cost.
define_property(TARGET PROPERTY FENCEPOST_FEWER_CHECKS INHERITED)
if(FENCEPOST_SANITIZE)
  target_compile_options(fencepost_flags INTERFACE -fsanitize=${FENCEPOST_SANITIZE} -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(fencepost_flags INTERFACE -fsanitize=${FENCEPOST_SANITIZE})
  if(FENCEPOST_SANITIZE MATCHES "undefined")
    set(fewer null alignment object-size vptr return unreachable nonnull-attribute returns-nonnull-attribute)
    list(JOIN fewer "," fewer)
    target_compile_options(fencepost_flags INTERFACE
      $<$<BOOL:$<TARGET_PROPERTY:FENCEPOST_FEWER_CHECKS>>:-fno-sanitize=${fewer}>)
  endif()
endif()
# A build of tests without them traps most of what the undefined-behaviour sanitizer reports, and accesses outside a
# container of the standard library. There is no message, but it costs little. Not in folders that turn FENCEPOST_TRAPS
# off.
define_property(TARGET PROPERTY FENCEPOST_TRAPS INHERITED)
if(FENCEPOST_QUICK AND NOT FENCEPOST_SANITIZE)
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" PROPERTY FENCEPOST_TRAPS ON)
  set(trap $<BOOL:$<TARGET_PROPERTY:FENCEPOST_TRAPS>>)
  target_compile_definitions(fencepost_flags INTERFACE $<${trap}:_GLIBCXX_ASSERTIONS>)
  target_compile_options(fencepost_flags INTERFACE
    "$<${trap}:-fsanitize=bounds,bool,enum,integer-divide-by-zero,shift,signed-integer-overflow>"
    $<${trap}:-fsanitize-undefined-trap-on-error>)
endif()

add_library(fencepost_robot_flags INTERFACE)
target_link_libraries(fencepost_robot_flags INTERFACE fencepost_flags)
# Compiler options of the boards; the desk builds the same code the same way.
target_compile_options(fencepost_robot_flags INTERFACE -fno-exceptions -fno-rtti -fno-threadsafe-statics)
