#include "firmware/fencepost/handle.hpp"

namespace fencepost {

template class Core<Small>;

}  // namespace fencepost

const fencepost_capacity* fencepost_small() { return &fencepost::library::kCapacity<fencepost::Small>; }
