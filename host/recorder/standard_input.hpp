// Standard input as the port that is recorded: a pipe from another program, or a file.
#pragma once

#include "host/live/port.hpp"

namespace fencepost::host {

/// Nothing can be sent to it. It is connected until it ends, and never again.
class StandardInput final : public BytePort {
 public:
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return !ended_; }
  [[nodiscard]] std::string problem() const override { return problem_; }
  [[nodiscard]] int descriptor() const override;
  base::Result<std::size_t> read(std::span<std::uint8_t> in) override;
  base::Result<std::size_t> write(std::span<const std::uint8_t> /*out*/) override { return base::Error::kRefused; }

 private:
  bool ended_ = false;
  std::string problem_;
};

}  // namespace fencepost::host
