#include "tests/boards/configured.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

std::string configured_image(const std::string& board, const std::string& ending,
                             const host::ConfigureRequest& request) {
  std::ifstream file(image_of(board) + ending, std::ios::binary);
  const auto image = host::read_image(std::string(std::istreambuf_iterator<char>(file), {}));
  if (!image.ok()) throw std::runtime_error(board + ending + ": " + image.error());
  const auto configured = host::configure(*image, request);
  if (!configured.ok()) throw std::runtime_error(board + ": " + configured.error());
  const std::string path = image_of(board, "configured-for-a-test");
  const std::string out = configured->cartridge ? ".sav" : ending;
  std::ofstream(path + out, std::ios::binary) << host::write_image(configured->memory, *host::image_format(out));
  return path;
}

}  // namespace fencepost::test
