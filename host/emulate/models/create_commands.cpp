#include "host/emulate/models/create_commands.hpp"

#include <algorithm>
#include <iterator>

namespace fencepost::emulate {
namespace {

constexpr unsigned kCreate1 = 1;
constexpr unsigned kCreate2 = 2;
constexpr unsigned kBoth = kCreate1 | kCreate2;

unsigned bit(CreateModel model) { return model == CreateModel::kOne ? kCreate1 : kCreate2; }

struct Opcode {
  int opcode;
  unsigned models;
  std::size_t arguments;
  std::size_t counted = 0;  ///< bytes a unit of the last argument
};

constexpr Opcode kOpcodes[] = {
    {7, kCreate2, 0},       // reset
    {128, kBoth, 0},        // start
    {129, kBoth, 1},        // baud
    {130, kBoth, 0},        // control, an older name of safe
    {131, kBoth, 0},        // safe
    {132, kBoth, 0},        // full
    {133, kCreate2, 0},     // power
    {134, kBoth, 0},        // spot
    {135, kBoth, 0},        // cover, clean
    {136, kCreate1, 1},     // demo
    {136, kCreate2, 0},     // max
    {137, kBoth, 4},        // drive
    {138, kBoth, 1},        // low side drivers, motors
    {139, kBoth, 3},        // LEDs
    {140, kBoth, 2, 2},     // song: number, notes
    {141, kBoth, 1},        // play
    {142, kBoth, 1},        // sensors
    {143, kBoth, 0},        // cover and dock, seek dock
    {144, kBoth, 3},        // PWM of drivers and motors
    {145, kBoth, 4},        // drive direct
    {146, kCreate2, 4},     // drive PWM
    {147, kCreate1, 1},     // digital outputs
    {148, kBoth, 1, 1},     // stream
    {149, kBoth, 1, 1},     // query list
    {150, kBoth, 1},        // pause or resume the stream
    {151, kCreate1, 1},     // send IR
    {152, kCreate1, 1, 1},  // script
    {153, kCreate1, 0},     // play script
    {154, kCreate1, 0},     // show script
    {155, kCreate1, 1},     // wait time
    {156, kCreate1, 2},     // wait distance
    {157, kCreate1, 2},     // wait angle
    {158, kCreate1, 1},     // wait event
    {162, kCreate2, 2},     // scheduling LEDs
    {163, kCreate2, 4},     // digits' segments
    {164, kCreate2, 4},     // digits' characters
    {165, kCreate2, 1},     // buttons
    {167, kCreate2, 15},    // schedule
    {168, kCreate2, 3},     // day and time
    {173, kCreate2, 0},     // stop
};

struct Group {
  int id;
  unsigned models;
  int first;
  int last;
};

constexpr Group kGroups[] = {
    {0, kBoth, 7, 26},       {1, kBoth, 7, 16},       {2, kBoth, 17, 20},      {3, kBoth, 21, 26},
    {4, kBoth, 27, 34},      {5, kBoth, 35, 42},      {6, kBoth, 7, 42},       {100, kCreate2, 7, 58},
    {101, kCreate2, 43, 58}, {106, kCreate2, 46, 51}, {107, kCreate2, 54, 58},
};

constexpr int kFirstPacket = 7;
constexpr int kLastPacketOfOne = 42;
constexpr int kLastPacketOfTwo = 58;
constexpr int kWords[] = {19, 20, 22, 23, 25, 26, 27, 28, 29, 30, 31, 33, 39, 40,
                          41, 42, 43, 44, 46, 47, 48, 49, 50, 51, 54, 55, 56, 57};

}  // namespace

std::optional<std::size_t> create_arguments(CreateModel model, std::string_view command) {
  const int opcode = static_cast<unsigned char>(command[0]);
  const auto* known = std::find_if(std::begin(kOpcodes), std::end(kOpcodes), [&](const Opcode& candidate) {
    return candidate.opcode == opcode && (candidate.models & bit(model)) != 0;
  });
  if (known == std::end(kOpcodes)) return std::nullopt;
  const bool counts = known->counted > 0 && command.size() > known->arguments;
  const std::size_t units = counts ? static_cast<unsigned char>(command[known->arguments]) : 0;
  return known->arguments + units * known->counted;
}

std::size_t create_packet_size(CreateModel model, int id) {
  const int last = model == CreateModel::kOne ? kLastPacketOfOne : kLastPacketOfTwo;
  if (id < kFirstPacket || id > last) return 0;
  return std::find(std::begin(kWords), std::end(kWords), id) != std::end(kWords) ? 2 : 1;
}

std::vector<int> create_group(CreateModel model, int id) {
  std::vector<int> packets;
  for (const Group& group : kGroups) {
    if (group.id != id || (group.models & bit(model)) == 0) continue;
    for (int packet = group.first; packet <= group.last; ++packet) packets.push_back(packet);
  }
  return packets;
}

}  // namespace fencepost::emulate
