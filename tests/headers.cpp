// Nothing: what is compiled with it are the headers that tests/CMakeLists.txt names.
