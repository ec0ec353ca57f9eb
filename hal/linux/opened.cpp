#include "hal/linux/opened.hpp"

#include <system_error>

namespace fencepost::linux {

Problem failure(std::string_view what, std::string_view where, int error, std::string_view remedy) {
  std::string sentence = "cannot ";
  sentence.append(what).append(" ").append(where).append(": ");
  sentence.append(std::generic_category().message(error)).append("; ").append(remedy);
  return {std::move(sentence)};
}

}  // namespace fencepost::linux
