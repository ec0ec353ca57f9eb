// Writes beside the loop: a disk that is slow or stuck costs the robot none of its time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hal/base/units.hpp"
#include "hal/linux/opened.hpp"

namespace fencepost::host {

/// Where the bytes go in the end. Each call may take as long as the disk does.
class Sink {
 public:
  using Fault = std::optional<linux::Problem>;

  virtual ~Sink() = default;
  /// Whole lines, all of them or a fault; `now` is when the last one was handed over.
  [[nodiscard]] virtual Fault write(std::string_view lines, base::Time now) = 0;
  /// About once a second.
  [[nodiscard]] virtual Fault tend(base::Time now) = 0;
  /// All is where a power cut does not reach it.
  [[nodiscard]] virtual Fault close() = 0;
  /// For messages.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Written so far.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

/// A bounded queue of lines and the thread that writes them. Lines that do not fit are refused, and the caller sees it.
/// So a loop that uses an input only if its record was accepted agrees with its log. After a fault nothing is accepted.
class WriteBehind {
 public:
  using Fault = Sink::Fault;

  /// Minutes of any robot's records.
  static constexpr std::size_t kCapacity = 1 << 20;

  explicit WriteBehind(std::unique_ptr<Sink> sink, std::size_t capacity = kCapacity);
  /// Does not wait: see `close`.
  ~WriteBehind();
  WriteBehind(const WriteBehind&) = delete;
  WriteBehind& operator=(const WriteBehind&) = delete;

  /// Takes as many of the lines as there is room for, and answers their length. Never waits for the disk.
  std::size_t put(std::string_view lines, base::Time now);
  /// Once per loop iteration.
  void tend(base::Time now);
  /// Waits until all is written and closed, as long as something is written every `patience`. Without that it leaves
  /// the rest to the thread, which the end of the program ends, and answers false.
  bool close(std::chrono::milliseconds patience);

  [[nodiscard]] Fault fault() const;
  /// Bytes taken that are not written yet.
  [[nodiscard]] std::size_t waiting() const;
  /// How long something has been waiting while nothing was written, by the loop's clock; asked once a turn.
  base::Duration stalled(base::Time now);
  /// Bytes taken that will never be written.
  [[nodiscard]] std::uint64_t lost() const;
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Shared;

  std::shared_ptr<Shared> shared_;
  std::uint64_t portions_seen_ = 0;
  base::Time moved_;
};

}  // namespace fencepost::host
