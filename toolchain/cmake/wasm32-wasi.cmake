# WebAssembly for the page of host/web: Debian's clang 14 with its libraries for wasm32 (toolchain/setup test).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-14)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-14)
set(CMAKE_RANLIB llvm-ranlib-14)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# Headers of libraries without code (nlohmann) may come from the host, programs and libraries may not be guessed.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
# Where it was built is in no file: the same sources make the same bytes in any folder.
set(CMAKE_CXX_FLAGS_INIT
  "-O2 -ffile-prefix-map=${CMAKE_SOURCE_DIR}=. -ffile-prefix-map=${CMAKE_BINARY_DIR}=build -DNDEBUG -fno-exceptions -fno-rtti -ffunction-sections -fdata-sections")
