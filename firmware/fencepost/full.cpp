#include "firmware/fencepost/handle.hpp"

namespace fencepost {

template class Core<Full>;

}  // namespace fencepost

const fencepost_capacity* fencepost_full() { return &fencepost::library::kCapacity<fencepost::Full>; }
