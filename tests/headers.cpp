// Empty: it compiles the headers that tests/CMakeLists.txt names.
