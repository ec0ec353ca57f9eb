// The result document as text for a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/result/result.hpp"

namespace fencepost::host {

struct TextOptions {
  bool colour = false;        ///< ANSI colours; only for a terminal
  bool changes_only = false;  ///< alerts: leave out those that repeat the object's last level
  std::size_t areas = 2;      ///< objects: columns with models' areas, at most; more do not fit into 80 columns
};

/// One line per object under a head of two lines (names, units), at most 80 columns for values of ordinary size.
/// "-" where a model has no area. Says so when there is no object.
std::string object_table(const ResultDocument& document, const TextOptions& options = {});

/// One sentence: `12.380 s  STOP    red  0.24 m  12 deg left  in 1.1 s  (object 3)`.
std::string alert_sentence(const ResultDocument& document, const record::AlertReport& alert,
                           const TextOptions& options = {});

/// One sentence per alert, in order.
std::string alert_list(const ResultDocument& document, const TextOptions& options = {});

/// The robot's own advice what to check.
std::string calibration_sentence(const record::CalibrationDoubt& doubt);

/// One line for each change of the robot's opinion of its calibration: `12.380 s  check the camera's pitch ...`.
std::string calibration_list(const ResultDocument& document);

/// "left" or "right": on which side of the object the robot went.
std::string_view side_word(const PassResult& pass);
/// A table of the objects that were driven past. `sides`: by the name of a signature, where it has to be passed; those
/// are marked that were not.
struct SideRule {
  std::string name;
  bool on_the_right = false;
};
std::string pass_table(const ResultDocument& document, const std::vector<SideRule>& sides = {});
/// How many of them were passed on the other side.
std::size_t wrong_sides(const ResultDocument& document, const std::vector<SideRule>& sides);

/// `3 objects (2 confirmed), 8 alerts, 201 frames`.
std::string counts(const ResultDocument& document, std::uint64_t alerts);
/// One line: the counts, profile and digest.
std::string summary_line(const ResultDocument& document);
/// With the number of alerts, which the document need not hold.
std::string summary_line(const ResultDocument& document, std::uint64_t alerts);

}  // namespace fencepost::host
