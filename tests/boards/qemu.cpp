#include "tests/boards/qemu.hpp"

#include "tests/boards/counting.hpp"

namespace fencepost::test {

std::vector<std::string> qemu_command(const QemuBoard& board, const std::string& control) {
  const std::string shift = std::to_string(board.shift);
  std::vector<std::string> words = {"env", "LD_PRELOAD=" FENCEPOST_VIRTUAL_TIME, "qemu-system-arm"};
  words.insert(words.end(),
               {"-M", board.machine, "-kernel", board.started.empty() ? board.image : board.started, "-nographic"});
  words.insert(words.end(), {"-icount", "shift=" + shift + ",sleep=off"});
  words.insert(words.end(), {"-plugin", FENCEPOST_VIRTUAL_TIME ",control=" + control + ",shift=" + shift +
                                            ",tick=" + address_of(board.image, board.tick)});
  words.insert(words.end(), board.more.begin(), board.more.end());
  return words;
}

std::function<std::unique_ptr<Machine>(const BoardUnderTest&)> emulated_qemu(std::size_t control) {
  return [control](const BoardUnderTest& board) { return std::make_unique<EmulatedQemu>(board, control); };
}

}  // namespace fencepost::test
