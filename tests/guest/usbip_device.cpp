#include "tests/guest/usbip_device.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <span>

namespace fencepost::guest {
namespace {

using Lock = std::lock_guard<std::recursive_mutex>;

constexpr std::string_view kPort = "0";
const std::string kController = "/sys/devices/platform/vhci_hcd.0/";

enum Command : std::uint32_t { kSubmit = 1, kUnlink = 2, kSubmitAnswer = 3, kUnlinkAnswer = 4 };
constexpr std::size_t kHeader = 48;

bool write_file(const std::string& path, const std::string& text) {
  const linux::Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  return ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

bool read_whole(int socket, std::span<std::uint8_t> in) {
  return in.empty() || ::recv(socket, in.data(), in.size(), MSG_WAITALL) == static_cast<ssize_t>(in.size());
}

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t index) {  // big-endian
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | bytes[index * 4 + i];
  return value;
}

void put_word(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::uint16_t half(std::span<const std::uint8_t> bytes) {  // little-endian, as USB itself
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}

void put_half(Bytes& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

}  // namespace

void UsbipDevice::plug() {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  socket_ = linux::Descriptor(ends[0]);
  const linux::Descriptor kernel_end(ends[1]);
  constexpr int kDevice = 1 << 16 | 1;
  constexpr int kFullSpeed = 2;
  const std::string line = std::string(kPort) + " " + std::to_string(kernel_end.get()) + " " + std::to_string(kDevice) +
                           " " + std::to_string(kFullSpeed);
  bool attached = false;
  // The port is free only a while after the last device left it.
  for (int i = 0; i < 200 && !attached; ++i) {
    attached = write_file(kController + "attach", line);
    if (!attached) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(attached) << "vhci_hcd did not take the device: errno " << errno;
  server_ = std::thread([this, socket = socket_.get()] { serve(socket); });
}

void UsbipDevice::unplug() {
  if (!server_.joinable()) return;
  EXPECT_TRUE(write_file(kController + "detach", std::string(kPort)));
  ::shutdown(socket_.get(), SHUT_RDWR);
  server_.join();
  const Lock lock(mutex_);
  socket_.close();
  waiting_.clear();
  held_.clear();
  ready_.clear();
  halted_.clear();
  garbled_ = 0;
  holding_ = false;
}

void UsbipDevice::serve(int socket) {
  while (serve_one(socket)) continue;
}

bool UsbipDevice::serve_one(int socket) {
  std::array<std::uint8_t, kHeader> header{};
  if (!read_whole(socket, header)) return false;
  const std::uint32_t command = word(header, 0);
  if (command == kUnlink) unlink(word(header, 1), word(header, 5));
  if (command != kSubmit) return command == kUnlink;
  Urb urb;
  urb.number = word(header, 1);
  urb.in = word(header, 3) != 0;
  urb.endpoint = static_cast<std::uint8_t>(word(header, 4) | (urb.in ? 0x80U : 0U));
  urb.length = word(header, 6);
  const std::span<const std::uint8_t> setup = std::span(header).subspan(40, 8);
  urb.setup = {setup[0], setup[1], half(setup.subspan(2)), half(setup.subspan(4)), half(setup.subspan(6))};
  if (!urb.in) urb.out.resize(urb.length);
  if (!read_whole(socket, urb.out)) return false;
  submit(std::move(urb));
  return true;
}

void UsbipDevice::submit(Urb urb) {
  const Lock lock(mutex_);
  const bool to_model = urb.endpoint == 0 || (urb.endpoint == 0x80 && (urb.setup.type & 0x60U) != 0);
  const bool standard_request = (urb.endpoint & 0x7FU) == 0 && (urb.setup.type & 0x60U) == 0;
  if (holding_ && !standard_request && (to_model || !urb.in)) {
    held_.push_back(std::move(urb));
    return;
  }
  act(urb);
}

void UsbipDevice::act(const Urb& urb) {
  if ((urb.endpoint & 0x7FU) == 0) return control(urb);
  if (halted_.count(urb.endpoint) != 0) return answer(urb, -EPIPE, {});
  if (urb.in) {
    waiting_.push_back(urb);
    return feed();
  }
  answer(urb, 0, {});
  if (model_.on_bulk) model_.on_bulk(urb.out);
}

void UsbipDevice::control(const Urb& urb) {
  const bool standard_request = (urb.setup.type & 0x60U) == 0;
  std::optional<Bytes> data;
  if (standard_request) data = standard(urb.setup);
  if (!standard_request && model_.on_control) data = model_.on_control(urb.setup, urb.out);
  if (!data) return answer(urb, -EPIPE, {});
  if (data->size() > urb.setup.length) data->resize(urb.setup.length);
  answer(urb, 0, urb.in ? *data : Bytes());
}

// USB 2.0, 9.4.
std::optional<Bytes> UsbipDevice::standard(const UsbSetup& setup) {
  enum : std::uint8_t { kGetStatus = 0, kClearFeature = 1, kSetAddress = 5, kGetDescriptor = 6, kSetConfiguration = 9 };
  constexpr std::uint8_t kSetInterface = 11;
  switch (setup.request) {
    case kGetStatus: return Bytes{static_cast<std::uint8_t>(halted_.count(static_cast<std::uint8_t>(setup.index))), 0};
    case kClearFeature: halted_.erase(static_cast<std::uint8_t>(setup.index)); return Bytes();
    case kSetAddress:
    case kSetConfiguration:
    case kSetInterface: return Bytes();
    case kGetDescriptor: break;
    default: return std::nullopt;
  }
  Bytes descriptor = describe(setup.value);
  if (descriptor.empty()) return std::nullopt;
  return descriptor;
}

Bytes UsbipDevice::describe(std::uint16_t which) const {
  enum : std::uint8_t { kDevice = 1, kConfiguration = 2, kString = 3 };
  const std::size_t index = which & 0xFFU;
  Bytes bytes;
  switch (which >> 8) {
    case kDevice:
      bytes = {18, kDevice, 0x00, 0x02, 0, 0, 0, 64};
      put_half(bytes, model_.vendor);
      put_half(bytes, model_.product);
      bytes.insert(bytes.end(), {0x05, 0x02, 1, 2, 3, 1});
      break;
    case kConfiguration:
      bytes.reserve(9 + model_.interface_descriptors.size());  // else GCC 12 warns of its own vector at -O3
      bytes = {9, kConfiguration};
      put_half(bytes, static_cast<std::uint16_t>(9 + model_.interface_descriptors.size()));
      bytes.insert(bytes.end(), {model_.interfaces, 1, 0, 0xC0, 0});
      bytes.insert(bytes.end(), model_.interface_descriptors.begin(), model_.interface_descriptors.end());
      break;
    case kString:
      if (index == 0) return {4, kString, 0x09, 0x04};
      if (index > model_.strings.size()) break;
      bytes = {static_cast<std::uint8_t>(2 + 2 * model_.strings[index - 1].size()), kString};
      for (const char c : model_.strings[index - 1]) put_half(bytes, static_cast<std::uint8_t>(c));
      break;
    default: break;
  }
  return bytes;
}

void UsbipDevice::unlink(std::uint32_t number, std::uint32_t victim) {
  const Lock lock(mutex_);
  const auto is_victim = [victim](const Urb& urb) { return urb.number == victim; };
  const std::size_t removed = std::erase_if(waiting_, is_victim) + std::erase_if(held_, is_victim);
  taken_back_ += static_cast<int>(removed);
  Bytes message;
  for (const std::uint32_t value : {std::uint32_t{kUnlinkAnswer}, number, 0U, 0U, 0U}) put_word(message, value);
  put_word(message, static_cast<std::uint32_t>(removed != 0 ? -ECONNRESET : 0));
  message.resize(kHeader);
  static_cast<void>(::send(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL));
}

void UsbipDevice::answer(const Urb& urb, int status, const Bytes& in) {
  Bytes message;
  for (const std::uint32_t value : {std::uint32_t{kSubmitAnswer}, urb.number, 0U, 0U, 0U}) put_word(message, value);
  put_word(message, static_cast<std::uint32_t>(status));
  const std::size_t moved = urb.in ? in.size() : urb.out.size();
  put_word(message, status == 0 ? static_cast<std::uint32_t>(moved) : 0U);
  message.resize(kHeader);
  if (status == 0) message.insert(message.end(), in.begin(), in.end());
  static_cast<void>(::send(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL));
}

// Pairs what the host waits for with what there is, in order.
void UsbipDevice::feed() {
  for (auto urb = waiting_.begin(); urb != waiting_.end();) {
    std::deque<Bytes>& ready = ready_[urb->endpoint];
    if (garbled_ == 0 && ready.empty()) {
      ++urb;
      continue;
    }
    if (garbled_ > 0) {
      --garbled_;
      answer(*urb, -EPROTO, {});
    } else {
      Bytes packet = std::move(ready.front());
      ready.pop_front();
      answer(*urb, packet.size() > urb->length ? -EOVERFLOW : 0, packet);
    }
    urb = waiting_.erase(urb);
  }
}

void UsbipDevice::give(std::uint8_t endpoint, Bytes packet) {
  const Lock lock(mutex_);
  ready_[endpoint].push_back(std::move(packet));
  feed();
}

void UsbipDevice::halt(std::uint8_t endpoint) {
  const Lock lock(mutex_);
  halted_.insert(endpoint);
  for (const Urb& urb : waiting_) {
    if (urb.endpoint == endpoint) answer(urb, -EPIPE, {});
  }
  std::erase_if(waiting_, [endpoint](const Urb& urb) { return urb.endpoint == endpoint; });
}

void UsbipDevice::garble(int count) {
  const Lock lock(mutex_);
  garbled_ = count;
  feed();
}

void UsbipDevice::hold(bool on) {
  const Lock lock(mutex_);
  holding_ = on;
  if (on) return;
  for (const Urb& urb : std::exchange(held_, {})) act(urb);
}

int UsbipDevice::waiting() {
  const Lock lock(mutex_);
  return static_cast<int>(waiting_.size());
}

int UsbipDevice::held() {
  const Lock lock(mutex_);
  return static_cast<int>(held_.size());
}

int UsbipDevice::taken_back() {
  const Lock lock(mutex_);
  return taken_back_;
}

}  // namespace fencepost::guest
