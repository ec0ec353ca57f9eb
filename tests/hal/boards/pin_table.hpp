// The permitted uses of a board's pins, from the tables beside this, and the faults of a use of them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fencepost::test {

/// A pin, and what for.
struct PinUse {
  std::string what;  ///< "console sends"
  std::string pin;   ///< as the table has it
  /// The part's peripheral and its signal, "USART2_TX"; none if the program drives or reads the pin by itself.
  std::string signal = {};
  unsigned function = 0;
  /// The board's own part at the pin, where that is meant: "led".
  std::string meant = {};
  /// Of two uses in the same group, one image has one.
  std::string group = {};
};

/// host/share/doc/pins.md has this line of a table.
bool document_has(const std::string& row);

class PinTable {
 public:
  /// `board`, and `functions` unless any pin can be anything: CSV files in tests/hal/boards. Throws std::runtime_error
  /// where they cannot be read.
  PinTable(const std::string& board, const std::string& functions);

  /// A sentence for each fault.
  [[nodiscard]] std::vector<std::string> faults(const std::vector<PinUse>& uses) const;

  /// On the header; empty if it is not there.
  [[nodiscard]] std::string header(const std::string& pin) const;

 private:
  struct Pin {
    std::string header;
    std::string reserved;
  };

  void add_place_faults(const PinUse& use, std::vector<std::string>& faults) const;
  void add_function_faults(const PinUse& use, std::vector<std::string>& faults) const;

  std::map<std::string, Pin> pins_;
  bool any_function_ = false;
  std::map<std::pair<std::string, unsigned>, std::string> signals_;
};

}  // namespace fencepost::test
