// Counts of a reader's lines and records, for the result document and the summary on stderr.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/record/kinds.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::record {

struct RejectCount {
  std::uint32_t lines = 0;
  std::uint32_t first_line = 0;  ///< 1-based; 0 while lines is 0
  friend constexpr bool operator==(const RejectCount&, const RejectCount&) = default;
};

/// Every line is in exactly one of `records`, `foreign` and `rejected`.
struct Counts {
  std::uint32_t records = 0;                            ///< accepted, all kinds
  std::array<std::uint32_t, kKinds> records_by_kind{};  ///< by Kind
  std::uint32_t foreign = 0;                            ///< lines that do not start with $FP, empty ones included
  std::array<RejectCount, kRejectReasons> rejects{};    ///< by Reject

  [[nodiscard]] constexpr std::uint32_t records_of(Kind kind) const {
    return records_by_kind[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] constexpr const RejectCount& rejected(Reject reason) const {
    return rejects[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] constexpr std::uint32_t rejected() const {
    std::uint32_t sum = 0;
    for (const RejectCount& reason : rejects) sum += reason.lines;
    return sum;
  }
  friend constexpr bool operator==(const Counts&, const Counts&) = default;
};

}  // namespace fencepost::record
