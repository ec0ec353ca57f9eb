#include "tests/hal/boards/pin_table.hpp"

#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace fencepost::test {
namespace {

using Row = std::vector<std::string>;

// Of three columns; comments and the names of the columns are passed over.
void for_each_row(const std::string& name, const std::function<void(const Row&)>& take) {
  const std::string path = std::string(FENCEPOST_PIN_TABLES) + "/" + name + ".csv";
  std::ifstream file(path);
  std::string line;
  bool named = false;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    Row row(3);
    for (std::string& word : row) std::getline(words, word, ',');
    if (named) take(row);
    named = true;
  }
  if (!named) throw std::runtime_error("no table in " + path);
}

}  // namespace

bool document_has(const std::string& row) {
  std::ifstream file(FENCEPOST_PIN_DOCUMENT);
  std::string line;
  while (std::getline(file, line)) {
    if (line == row) return true;
  }
  return false;
}

PinTable::PinTable(const std::string& board, const std::string& functions) : any_function_(functions.empty()) {
  for_each_row(board, [this](const Row& row) { pins_[row[0]] = {row[1], row[2]}; });
  if (any_function_) return;
  for_each_row(functions, [this](const Row& row) {
    signals_[{row[0], static_cast<unsigned>(std::stoul(row[1]))}] = row[2];
  });
}

std::string PinTable::header(const std::string& pin) const {
  const auto found = pins_.find(pin);
  return found == pins_.end() ? std::string() : found->second.header;
}

void PinTable::add_place_faults(const PinUse& use, std::vector<std::string>& faults) const {
  const auto found = pins_.find(use.pin);
  if (found == pins_.end()) {
    faults.push_back(use.what + ": the board has no " + use.pin);
    return;
  }
  const Pin& pin = found->second;
  if (pin.reserved != use.meant) {
    const std::string is = pin.reserved.empty() ? "free" : pin.reserved;
    faults.push_back(use.what + ": " + use.pin + " is " + is + (use.meant.empty() ? "" : ", not " + use.meant));
  }
  if (use.meant.empty() && pin.header.empty()) faults.push_back(use.what + ": " + use.pin + " is not on the header");
}

void PinTable::add_function_faults(const PinUse& use, std::vector<std::string>& faults) const {
  if (use.signal.empty() || any_function_) return;
  const auto found = signals_.find({use.pin, use.function});
  const std::string is = found == signals_.end() ? "nothing" : found->second;
  if (is == use.signal) return;
  faults.push_back(use.what + ": function " + std::to_string(use.function) + " of " + use.pin + " is " + is + ", not " +
                   use.signal);
}

std::vector<std::string> PinTable::faults(const std::vector<PinUse>& uses) const {
  std::vector<std::string> faults;
  std::map<std::string, const PinUse*> used;
  for (const PinUse& use : uses) {
    add_place_faults(use, faults);
    add_function_faults(use, faults);
    const auto [before, first] = used.emplace(use.pin, &use);
    const bool one_of_two =
        !first && !use.group.empty() && !before->second->group.empty() && use.group != before->second->group;
    if (!first && !one_of_two) faults.push_back(use.what + ": " + use.pin + " is that of: " + before->second->what);
  }
  return faults;
}

}  // namespace fencepost::test
