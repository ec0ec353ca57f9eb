// The kinds of record by name, and how many fields each has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/record/records.hpp"

namespace fencepost::record {

inline constexpr std::string_view kRecordStart = "$FP";  ///< a line that starts otherwise is foreign
inline constexpr std::size_t kKinds = 12;
inline constexpr std::size_t kBlobFields = 9;  ///< fields of one blob within FPFRM

struct KindInfo {
  std::string_view name;  ///< as on the line, without the '$'
  std::uint8_t fields;    ///< after the name; FPFRM: before its blobs
};

/// By Kind.
inline constexpr KindInfo kKindInfo[kKinds] = {{"FPHDR", 5}, {"FPCAM", 14}, {"FPSIG", 3},  {"FPODO", 4},
                                               {"FPFRM", 3}, {"FPPOS", 6},  {"FPOBJ", 13}, {"FPALR", 8},
                                               {"FPDIG", 2}, {"FPLNK", 4},  {"FPSTA", 10}, {"FPCFG", 2}};

constexpr const KindInfo& info(Kind kind) { return kKindInfo[static_cast<std::size_t>(kind)]; }

constexpr std::string_view name(Kind kind) { return info(kind).name; }

}  // namespace fencepost::record
