// The alerts of a replay, of which there may be more than fit into memory.
#pragma once

#include <cstring>
#include <functional>
#include <type_traits>

#include "host/cli/spool.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host::cli {

class AlertSpool final : public AlertSink {
 public:
  void run_begins() override {
    spool_.clear();
    count_ = 0;
  }
  void hear(const record::AlertReport& alert) override {
    Slot slot{};
    std::memcpy(slot.bytes, &alert, sizeof alert);
    spool_.append({slot.bytes, sizeof slot});
    ++count_;
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// In order.
  void each(const std::function<void(const record::AlertReport&)>& visit) const {
    spool_.read([&](std::string_view portion) {
      for (; !portion.empty(); portion.remove_prefix(sizeof(Slot))) {
        record::AlertReport alert;
        std::memcpy(&alert, portion.data(), sizeof alert);
        visit(alert);
      }
    });
  }

 private:
  struct Slot {
    char bytes[64];  // NOLINT(modernize-avoid-c-arrays): plain bytes
  };
  static_assert(std::is_trivially_copyable_v<record::AlertReport> && sizeof(record::AlertReport) <= sizeof(Slot));
  static_assert(Spool::kInMemory % sizeof(Slot) == 0);

  Spool spool_;
  std::uint64_t count_ = 0;
};

}  // namespace fencepost::host::cli
