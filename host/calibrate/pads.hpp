// Boxes that are too wide by the same px on each side at every distance, as networks' are.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/calibrate/calibrate.hpp"
#include "host/calibrate/solver.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {

/// px. A robot takes whole pixels off, so less than this changes nothing.
inline constexpr double kMinPad = 0.5;

/// Fewer objects say nothing about others: their shapes may be what does not fit, and looks like a pad.
inline constexpr std::size_t kMinPadObjects = 4;

/// As a robot takes it off: whole px, of at most 100.
std::int8_t whole_pad(double pad);

/// Solves again what `freed` and `free` say, with the noise that they leave. Nothing changes where that fails.
void adopt(StartedProblem freed, SolverOptions free, StartedProblem& started, SolverOptions& options,
           std::optional<CalibratedMatrix>& matrix);

/// Frees the pads that the log is sure of and solves again with them. Signatures with few objects share one pad, with
/// all others if these are too few together. Nothing changes where the log is sure of none.
void free_pads(StartedProblem& started, SolverOptions& options, std::optional<CalibratedMatrix>& matrix);

/// The pads that are free with these options, by signature. `signatures`: the log's, whose pads were taken off before.
/// `matrix`: variances of the whole problem.
std::vector<FoundPad> pads_of(const StartedProblem& started, const SolverOptions& options,
                              const CalibratedMatrix& matrix, const std::vector<record::Signature>& signatures);

/// The log's signatures, with what was found.
std::vector<record::Signature> with_pads(std::vector<record::Signature> signatures, const std::vector<FoundPad>& pads);

}  // namespace fencepost::host
