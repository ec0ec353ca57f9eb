// One output that is high or low.
#pragma once

namespace fencepost::linux {

class OutputLine {
 public:
  virtual ~OutputLine() = default;
  /// 0, or the error of the system (errno).
  virtual int set(bool high) = 0;
};

}  // namespace fencepost::linux
