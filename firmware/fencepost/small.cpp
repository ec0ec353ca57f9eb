#include "firmware/fencepost/core.hpp"

namespace fencepost {

template class Core<Small>;

}  // namespace fencepost
