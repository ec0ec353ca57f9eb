// The command line as a whole.
#pragma once

namespace fencepost::host::cli {

/// Parses, runs the command, and answers the exit code. Every failure has been said on standard error.
int run_program(int argc, const char* const* argv);

}  // namespace fencepost::host::cli
