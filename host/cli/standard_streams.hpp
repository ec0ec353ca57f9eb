// Standard input, output and error, which the caller may have closed.
#pragma once

namespace fencepost::host::cli {

/// Call first of all. A closed standard stream's number would be given to the next file or device that is opened, and
/// messages would be written into it. Reading or writing the stand-in fails as it would on the closed one.
void hold_standard_streams();

}  // namespace fencepost::host::cli
