#include "firmware/recon/models/hybrid/cyclic_band_steps.hpp"

namespace fencepost::recon {

template struct CyclicBandOf<float>;

}  // namespace fencepost::recon
