#include "tests/boards/gba/handheld.hpp"

// The library's headers are C, and need their flags first.
// clang-format off
#include <mgba/flags.h>
#include <mgba/core/core.h>
#include <mgba/core/log.h>
#include <mgba/core/timing.h>
#include <mgba/internal/arm/arm.h>
#include <mgba/internal/gba/gba.h>
#include <mgba-util/vfs.h>
// clang-format on
#include <png.h>

#include <algorithm>
#include <cstdarg>
#include <cstring>
#include <stdexcept>

namespace fencepost::test {
namespace {

constexpr double kHz = 16'777'216;
constexpr double kMoment = 0.0005;
constexpr std::size_t kPainted = 0x7F00;  // of the memory on the chip; behind it are the BIOS's own words

void say_nothing(mLogger* /*logger*/, int /*category*/, mLogLevel /*level*/, const char* /*format*/, va_list /*args*/) {
}

void quieten() {
  static mLogger logger{};
  logger.log = say_nothing;
  mLogSetDefaultLogger(&logger);
}

std::span<std::uint8_t> memory_of(mCore* core, std::size_t region) {
  std::size_t size = 0;
  auto* bytes = static_cast<std::uint8_t*>(core->getMemoryBlock(core, region, &size));
  return {bytes, size};
}

bool is_link_port(std::uint32_t address) { return address == LinkPort::kControl || address == LinkPort::kData; }

// The core's own functions for memory, which are replaced. One machine at a time has a link port.
struct Hooked {
  decltype(ARMMemory::load16) load = nullptr;
  decltype(ARMMemory::store16) store = nullptr;
  Handheld* machine = nullptr;
};
Hooked hooked;

}  // namespace

void MailboxLine::connect(board::Mailbox& mailbox) {
  mailbox_ = &mailbox;
  *mailbox_ = {};
  mailbox_->desk[0] = board::Mailbox::kDesk;
  mailbox_->desk[1] = ~board::Mailbox::kDesk;
}

std::size_t MailboxLine::put(std::string_view bytes) {
  const std::size_t room = board::Mailbox::kToBoard - (mailbox_->desk_sent - mailbox_->board_received);
  const std::size_t count = std::min(room, bytes.size());
  for (std::size_t i = 0; i < count; ++i) {
    mailbox_->to_board[(mailbox_->desk_sent + i) % board::Mailbox::kToBoard] = static_cast<std::uint8_t>(bytes[i]);
  }
  mailbox_->desk_sent += static_cast<std::uint32_t>(count);
  return count;
}

std::string MailboxLine::get(std::size_t most) {
  std::string bytes(std::min<std::size_t>(most, mailbox_->board_sent - mailbox_->desk_received), '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(mailbox_->to_desk[mailbox_->desk_received++ % board::Mailbox::kToDesk]);
  return bytes;
}

Handheld::Handheld(const std::string& image, std::vector<std::uint8_t>* save, Console console)
    : save_(save), kind_(console) {
  quieten();
  core_ = mCoreFind(image.c_str());
  if (core_ == nullptr || !core_->init(core_)) throw std::runtime_error("no image for a Game Boy Advance: " + image);
  mCoreInitConfig(core_, nullptr);
  mCoreConfigSetValue(&core_->config, "idleOptimization", "ignore");
  core_->setVideoBuffer(core_, picture_.data(), kWidth);
  VFile* file = VFileOpen(image.c_str(), O_RDONLY);
  if (file == nullptr || !core_->loadROM(core_, file)) throw std::runtime_error("cannot load " + image);
  core_->reset(core_);
  if (save_ != nullptr && !save_->empty()) core_->savedataRestore(core_, save_->data(), save_->size(), false);
  std::ranges::fill(fast_memory().first(kPainted), kPaint);
  if (kind_ == Console::kLinkPort) {
    connect_link_port();
  } else {
    mailbox_.connect(*reinterpret_cast<board::Mailbox*>(memory_of(core_, REGION_WORKING_RAM).data()));
  }
}

Handheld::~Handheld() {
  if (save_ != nullptr) {
    void* bytes = nullptr;
    const std::size_t size = core_->savedataClone(core_, &bytes);
    const auto* begin = static_cast<const std::uint8_t*>(bytes);
    save_->assign(begin, begin + size);
    std::free(bytes);
  }
  mCoreConfigDeinit(&core_->config);
  core_->deinit(core_);
}

std::uint64_t Handheld::cycles() const { return mTimingGlobalTime(core_->timing); }
double Handheld::seconds() const { return static_cast<double>(cycles()) / kHz; }

void Handheld::pump() {
  run_until(seconds() + kMoment);
  if (kind_ == Console::kLinkPort) link_port_.advance(cycles());
  line(0).pump(seconds());
}

void Handheld::run_until(double until) {
  while (seconds() < until) {
    if (watch_) {
      step();
    } else {
      core_->runLoop(core_);
    }
  }
}

void Handheld::hold(unsigned keys) { core_->setKeys(core_, keys); }

Handheld::Pixel Handheld::pixel(std::size_t x, std::size_t y) const {
  const std::uint32_t bgr = picture_[y * kWidth + x];
  return {static_cast<std::uint8_t>(bgr & 0xFFU), static_cast<std::uint8_t>((bgr >> 8) & 0xFFU),
          static_cast<std::uint8_t>((bgr >> 16) & 0xFFU)};
}

void Handheld::save_picture(const std::string& path) const {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = kWidth;
  png.height = kHeight;
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
    const Pixel p = pixel(i % kWidth, i / kWidth);
    bytes.insert(bytes.end(), {p.red, p.green, p.blue});
  }
  if (png_image_write_to_file(&png, path.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    throw std::runtime_error("cannot write " + path);
  }
}

std::span<std::uint8_t> Handheld::fast_memory() { return memory_of(core_, REGION_WORKING_IRAM); }

Line& Handheld::line(std::size_t /*n*/) {
  if (kind_ == Console::kMailbox) return mailbox_;
  return link_port_;
}

void Handheld::step() {
  core_->step(core_);
  const auto* cpu = static_cast<const ARMCore*>(core_->cpu);
  const std::uint32_t width = cpu->executionMode == MODE_THUMB ? 2 : 4;
  watch_(static_cast<std::uint32_t>(cpu->gprs[ARM_PC]) - width, static_cast<std::uint32_t>(cpu->gprs[ARM_LR]) & ~1U);
}

// The core's accesses to the link port's registers go to our model of it, all others where they went before.
void Handheld::connect_link_port() {
  hooked = {static_cast<ARMCore*>(core_->cpu)->memory.load16, static_cast<ARMCore*>(core_->cpu)->memory.store16, this};
  static_cast<ARMCore*>(core_->cpu)->memory.load16 = [](ARMCore* cpu, std::uint32_t address, int* cycles) {
    const std::uint32_t plain = hooked.load(cpu, address, cycles);
    return is_link_port(address) ? hooked.machine->link_port().read(address, hooked.machine->cycles()) : plain;
  };
  static_cast<ARMCore*>(core_->cpu)->memory.store16 = [](ARMCore* cpu, std::uint32_t address, std::int16_t value,
                                                         int* cycles) {
    if (!is_link_port(address)) return hooked.store(cpu, address, value, cycles);
    hooked.machine->link_port().write(address, static_cast<std::uint16_t>(value), hooked.machine->cycles());
  };
  // Work memory is random when a real one is switched on: nobody must be taken for a desk in there.
  std::uint32_t random = 1;
  for (std::uint8_t& byte : memory_of(core_, REGION_WORKING_RAM)) {
    random = random * 1'664'525U + 1'013'904'223U;
    byte = static_cast<std::uint8_t>(random >> 24U);
  }
}

}  // namespace fencepost::test
