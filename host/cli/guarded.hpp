// The last catch of the program: whatever a command throws, it ends with a message and an exit code.
#pragma once

#include <functional>

namespace fencepost::host::cli {

/// The command's exit code, or that of its exception. A Failure has its own code. Other exceptions give 3 (unreadable
/// input), or 4 where the system refused a thread or a descriptor.
int guarded(const std::function<int()>& command);

}  // namespace fencepost::host::cli
