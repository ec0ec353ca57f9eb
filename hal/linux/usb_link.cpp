#include "hal/linux/usb_link.hpp"

#include <utility>

#include "hal/linux/usb_worker.hpp"

namespace fencepost::linux {
namespace {

Opened<UsbWorkerOwner> start(const UsbSettings& settings) {
  Opened<SignalFlag> flag = SignalFlag::open();
  if (!flag) return Problem{flag.problem()};
  UsbWorkerOwner worker(new UsbWorker(settings, std::move(*flag)));
  if (!worker->first_try()) return Problem{worker->problem()};
  return worker;
}

}  // namespace

void EndUsbWorker::operator()(UsbWorker* worker) const {
  if (worker->stop()) delete worker;
}

UsbPipes::UsbPipes(UsbWorkerOwner worker) : worker_(std::move(worker)) {}
UsbPipes::~UsbPipes() = default;
UsbPipes::UsbPipes(UsbPipes&&) noexcept = default;
UsbPipes& UsbPipes::operator=(UsbPipes&&) noexcept = default;

void UsbPipes::tend(base::Time now) { worker_->tend(now); }
bool UsbPipes::connected() const { return worker_->connected(); }
std::string UsbPipes::problem() const { return worker_->problem(); }
UsbCounters UsbPipes::counters() const { return worker_->counters(); }
int UsbPipes::descriptor() const { return worker_->descriptor(); }

Opened<UsbPacketLink> UsbPacketLink::open(const UsbSettings& settings) {
  Opened<UsbWorkerOwner> worker = start(settings);
  if (!worker) return Problem{worker.problem()};
  return UsbPacketLink(std::move(*worker));
}

base::Result<std::size_t> UsbPacketLink::send(std::span<const std::uint8_t> out) { return worker_->send(out, true); }
base::Result<std::size_t> UsbPacketLink::receive(std::span<std::uint8_t> in) { return worker_->receive(in); }

Opened<UsbByteLink> UsbByteLink::open(const UsbSettings& settings) {
  Opened<UsbWorkerOwner> worker = start(settings);
  if (!worker) return Problem{worker.problem()};
  return UsbByteLink(std::move(*worker));
}

base::Result<std::size_t> UsbByteLink::read(std::span<std::uint8_t> in) { return worker_->read(in); }
base::Result<std::size_t> UsbByteLink::write(std::span<const std::uint8_t> out) { return worker_->send(out, false); }

}  // namespace fencepost::linux
