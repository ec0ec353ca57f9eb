#include "host/cli/program.hpp"

int main(int argc, char** argv) { return fencepost::host::cli::run_program(argc, argv); }
