#include "firmware/fencepost/core.hpp"

namespace fencepost {

template class Core<Full>;

}  // namespace fencepost
