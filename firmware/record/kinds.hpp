// The kinds of record by name, and how many fields each has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "firmware/record/records.hpp"

namespace fencepost::record {

template <class... Records>
struct RecordList {};

/// By Kind. Encoder, decoder and sinks are made from this list.
using AllRecords = RecordList<Header, sensor::CameraIntrinsics, Signature, sensor::OdometrySample, sensor::BlobFrame,
                              Position, ObjectReport, AlertReport, DigestReport, LinkReport, StatusReport, Setting,
                              Heartbeat, CalibrationDoubt, sensor::CarSample, SectorReport, WayReport, SpeedLimit>;

/// The length of the list if it is not in there.
template <class Record, class... Records>
constexpr std::size_t index_in(RecordList<Records...> /*list*/) {
  std::size_t index = 0;
  static_cast<void>(((std::is_same_v<Record, Records> || (++index, false)) || ...));
  return index;
}

inline constexpr std::string_view kRecordStart = "$FP";  ///< a line that starts otherwise is foreign
inline constexpr std::size_t kKinds = 18;
inline constexpr std::size_t kBlobFields = 9;  ///< fields of one blob within FPFRM; its id is one more

struct KindInfo {
  std::string_view name;  ///< as on the line, without the '$'
  std::uint8_t fields;    ///< after the name; before the items of a list
  std::uint8_t more = 0;  ///< that may follow, since later versions
  bool list = false;      ///< items follow, as many as the last of the fields says
};

/// By Kind.
inline constexpr KindInfo kKindInfo[kKinds] = {
    {"FPHDR", 5},  {"FPCAM", 14, 1}, {"FPSIG", 3, 2}, {"FPODO", 4},          {"FPFRM", 3, 0, true}, {"FPPOS", 6},
    {"FPOBJ", 13}, {"FPALR", 8},     {"FPDIG", 2},    {"FPLNK", 4},          {"FPSTA", 10},         {"FPCFG", 2},
    {"FPALV", 4},  {"FPCAL", 3},     {"FPCAR", 4},    {"FPSEC", 2, 0, true}, {"FPWAY", 2, 0, true}, {"FPSPD", 2}};

template <class Record>
concept RecordType = index_in<Record>(AllRecords{})
< kKinds;

template <RecordType Record>
inline constexpr Kind kKindOf = static_cast<Kind>(index_in<Record>(AllRecords{}));
static_assert(kKindOf<Header> == Kind::kHeader && kKindOf<SpeedLimit> == Kind::kSpeedLimit);

constexpr const KindInfo& info(Kind kind) { return kKindInfo[static_cast<std::size_t>(kind)]; }

constexpr std::string_view name(Kind kind) { return info(kind).name; }

}  // namespace fencepost::record
