#include "firmware/fencepost/handle.hpp"

namespace fencepost {

template class Core<Micro>;

}  // namespace fencepost

const fencepost_capacity* fencepost_micro() { return &fencepost::library::kCapacity<fencepost::Micro>; }
