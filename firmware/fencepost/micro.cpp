#include "firmware/fencepost/core.hpp"

namespace fencepost {

template class Core<Micro>;

}  // namespace fencepost
