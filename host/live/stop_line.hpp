// A line that holds the motors: released only while the robot may drive.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "hal/linux/output_line.hpp"
#include "host/live/alert_now.hpp"

namespace fencepost::host {

/// `CHIP:LINE[,active-high]`
struct StopLineSpec {
  std::string chip;
  std::string line;
  bool active_high = false;  ///< high stops; else low does, as a wire that is off does
};
/// errors: a sentence that says what is wrong and what is allowed
base::Result<StopLineSpec, std::string> parse_stop_line(std::string_view text);

/// A process of its own has the line. It holds the motors unless it got a go within kPatience: while this program
/// hangs, and after it has ended for whatever reason.
class StopLine final : public AlertOutput {
 public:
  static constexpr base::Duration kPatience = base::milliseconds(300);

  /// Forks: before the program has threads. `line` stops now, and `name` is for messages.
  static linux::Opened<std::unique_ptr<StopLine>> hold(std::unique_ptr<linux::OutputLine> line, bool active_high,
                                                       std::string name);
  ~StopLine() override;
  StopLine(const StopLine&) = delete;
  StopLine& operator=(const StopLine&) = delete;

  void show(const AlertNow& alert, base::Time now) override;
  void end(base::Time now) override;
  std::vector<std::string> messages() override;

 private:
  StopLine(linux::Descriptor socket, int process, std::string name)
      : socket_(std::move(socket)), process_(process), name_(std::move(name)) {}
  void send(bool may_move);
  void note(int error);

  linux::Descriptor socket_;  ///< to the process: go or stop. From it: errors
  int process_;
  std::string name_;
  std::optional<bool> sent_;
  base::Time sent_at_;
  int said_ = 0;  ///< the error that was last said
  std::vector<std::string> messages_;
};

}  // namespace fencepost::host
