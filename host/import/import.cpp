#include "host/import/import.hpp"

namespace fencepost::host {

std::string ImportError::message() const { return where + ": " + what + "; " + remedy; }

}  // namespace fencepost::host
