# Boards with an ARM core: Debian's arm-none-eabi compiler and newlib. The board's preset names the core's flags.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# Those that see what a compiler with -flto leaves in its objects.
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # a program would need the linker script
# Programs and libraries of the host may not be guessed.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
# -mcpu and the like; a change of them needs a build folder of its own.
set(FENCEPOST_CORE "" CACHE STRING "Flags of the board's core")
set(FENCEPOST_OPTIMISE "-O2" CACHE STRING "How to optimise: -Os where flash is short")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FENCEPOST_CORE FENCEPOST_OPTIMISE)
# The call graph is for tests/boards/image_check.py; ccache would not restore it, so the presets do without.
# NDEBUG: the assertions of libraries would bring printf along; ours are FENCEPOST_CHECK and stay. Without errno a square
# root is one instruction, where there is one.
# Where it was built is in no file: the same sources make the same bytes in any folder (toolchain/long images).
set(CMAKE_CXX_FLAGS_INIT
  "${FENCEPOST_CORE} ${FENCEPOST_OPTIMISE} -g -ffile-prefix-map=${CMAKE_SOURCE_DIR}=. -ffile-prefix-map=${CMAKE_BINARY_DIR}=build -DNDEBUG -fno-math-errno -ffunction-sections -fdata-sections -fno-use-cxa-atexit -fno-unwind-tables -fno-asynchronous-unwind-tables -fcallgraph-info=su,da")
