// The robot's own lines: the record stream, which OpenMV and MaixCAM speak too, and the console's input.
#include "tests/firmware/record/lines.hpp"
#include "drivers/pixy1/pixy1.hpp"
#include "firmware/console/input_lines.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/drivers/states/reveal.hpp"
#include "tests/drivers/states/scanned.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
FENCEPOST_REVEAL(LinesBuffer, &record::StreamReader::buffer_);
FENCEPOST_REVEAL(LinesSize, &record::StreamReader::size_);
FENCEPOST_REVEAL(LinesLines, &record::StreamReader::lines_);
FENCEPOST_REVEAL(LinesRules, &record::LineReader::rules_);
FENCEPOST_REVEAL(LinesImage, &record::RunRules::image_);
FENCEPOST_REVEAL(LinesLastOdometry, &record::RunRules::last_odometry_);
FENCEPOST_REVEAL(LinesLastFrame, &record::RunRules::last_frame_);
FENCEPOST_REVEAL(LinesBegin, &console::InputLines::begin_);
FENCEPOST_REVEAL(LinesScanned, &console::InputLines::scanned_);
FENCEPOST_REVEAL(LinesEnd, &console::InputLines::end_);
FENCEPOST_REVEAL(LinesAfterReturn, &console::InputLines::after_return_);
FENCEPOST_REVEAL(LinesTooLong, &console::InputLines::too_long_);

namespace {

// In a buffer of `Room`; with `Rules`, what the lines before allow is part of the state.
template <std::size_t Room, bool Rules>
struct Stream : Seen {
  Stream() : reader(memory) {}
  Stream(const Stream& other) : Seen(other), memory(other.memory), reader(other.reader) {
    reader.*revealed(LinesBuffer{}) = std::span<char>(memory).first(Room);
  }

  template <class Record>
  void accept(const Record& record) {
    ++outputs;
    if constexpr (std::same_as<Record, sensor::OdometrySample>) right = record.x.raw == 42;
  }
  void feed(std::uint8_t byte) {
    right = false;
    const std::uint32_t before = reader.line_number();
    const auto outcome = reader.push(static_cast<char>(byte), *this);
    if (outcome.has_value() != (byte == '\n')) trouble = "an outcome elsewhere than at a line's end";
    if (reader.line_number() - before != (byte == '\n' ? 1U : 0U)) trouble = "lines are miscounted";
    if (reader.counts().records != outputs) trouble = "records are miscounted";
    if (size() > Room + 1) trouble = "a line beyond its buffer";
    if (memory.back() != kCanary) trouble = "written behind the buffer";
  }
  void rest() { (void)reader.finish(); }
  [[nodiscard]] bool idle() const { return size() == 0; }
  void control(Key& key) const {
    key.u8(boundary(size(), Room));
    key.u8(std::string_view(memory.data(), std::min<std::size_t>(size(), 3)) == record::kRecordStart);
    if (!Rules) return;
    const record::RunRules& rules = reader.*revealed(LinesLines{}).*revealed(LinesRules{});
    key.u8((rules.*revealed(LinesImage{})).has_value());
    key.u8((rules.*revealed(LinesLastOdometry{})).has_value());
    key.u8((rules.*revealed(LinesLastFrame{})).has_value());
  }
  [[nodiscard]] std::size_t size() const { return reader.*revealed(LinesSize{}); }

  static constexpr char kCanary = '\x5A';
  std::array<char, Room + 1> memory = [] {
    std::array<char, Room + 1> all{};
    all.back() = kCanary;
    return all;
  }();
  record::StreamReader reader;
};

template <std::size_t Room, bool Rules>
Walked walk_stream() {
  sensor::OdometrySample odometry;
  odometry.x.raw = 42;
  sensor::BlobFrame frame;
  (void)frame.blobs.push_back({1, 140, 85, 179, 115, {1'595}, {1'000}, 0, {}});
  const auto filler = [](std::string_view start, std::size_t size) {
    return text(start) + Bytes(size - start.size(), 'x') + Bytes{'\n'};
  };
  Plan plan;
  plan.good = text("\n" + record::encoded(record::Header{}) + record::encoded(odometry));
  plan.way_back = plan.good.size();
  plan.shortest = 8;
  plan.samples = {{plan.good, 2},
                  {text(record::encoded(pixy1::kProfile))},
                  {text(record::encoded(frame))},
                  {text(record::encoded(odometry) + record::encoded(odometry)), 1},
                  {text(record::sealed("FPXXX,1") + "\n"), 0},
                  {text(record::sealed("FPHDR,9,a,b,c,d") + "\n"), 0}};
  for (const std::size_t size : {Room - 1, Room, Room + 1}) {
    plan.samples.push_back({filler("$FP", size), 0});
  }
  return walk(Stream<Room, Rules>{}, plan);
}

// Takes lines as soon as they are there, or not before there is no room.
template <bool Eager>
struct Console : Seen {
  void feed(std::uint8_t byte) {
    right = false;
    if (lines.room().empty()) take_all();
    const std::span<std::uint8_t> room = lines.room();
    if (room.empty()) {
      trouble = "no room after all lines were taken";
      return;
    }
    room[0] = byte;
    lines.filled(1);
    if (Eager || byte == 0x04) take_all();
    const auto order = {lines.*revealed(LinesBegin{}), lines.*revealed(LinesScanned{}), lines.*revealed(LinesEnd{})};
    if (!std::is_sorted(order.begin(), order.end()) || *(order.end() - 1) > record::kMaxLine)
      trouble = "marks out of order";
  }
  void take_all() {
    while (const auto line = lines.front()) {
      ++outputs;
      const std::string_view text(line->text.data(), line->text.size());
      if (text.find_first_of("\r\n") != std::string_view::npos) trouble = "a line with a line end";
      if (line->too_long && text.size() < 16) trouble = "too little is kept of a line that is too long";
      right = right || (!line->too_long && text == "status");
      lines.pop_front();
    }
  }
  void rest() { feed('\n'), take_all(), feed('x'), feed('\n'), take_all(); }
  [[nodiscard]] bool idle() const {
    return lines.*revealed(LinesBegin{}) == lines.*revealed(LinesEnd{}) && !(lines.*revealed(LinesTooLong{}));
  }
  void control(Key& key) const {
    const std::uint16_t begin = lines.*revealed(LinesBegin{});
    const std::uint16_t end = lines.*revealed(LinesEnd{});
    key.u8(boundary(static_cast<std::size_t>(end - begin), record::kMaxLine));
    key.u8(boundary(end, record::kMaxLine));
    key.u8(end == lines.*revealed(LinesScanned{}));
    key.u8(lines.*revealed(LinesAfterReturn{}));
    key.u8(lines.*revealed(LinesTooLong{}));
  }

  console::InputLines lines;
};

template <bool Eager>
Walked walk_console() {
  // Who is late takes lines at a byte 4, which is then the first of the next one.
  const Bytes late = Eager ? Bytes{} : Bytes{'\n', 4, '\n'};
  Plan plan;
  plan.good = late + text("\nstatus\r\n") + (Eager ? Bytes{} : Bytes{4});
  plan.way_back = plan.good.size();
  plan.samples = {{plan.good, Eager ? 2U : 4U}};
  for (const std::size_t size : {record::kMaxLine - 2, record::kMaxLine - 1, record::kMaxLine, record::kMaxLine + 1}) {
    plan.samples.push_back({Bytes(size, 'x') + Bytes{'\r', '\n'} + (Eager ? Bytes{} : Bytes{4}), 1});
  }
  return walk(Console<Eager>{}, plan);
}

const RegisteredWalk kLines[] = {
    {"firmware/record", "stream", walk_stream<128, true>},
    {"firmware/record", "lines of all lengths", walk_stream<record::StreamReader::kBuffer, false>},
    {"firmware/console", "lines taken at once", walk_console<true>},
    {"firmware/console", "lines taken late", walk_console<false>}};

}  // namespace
}  // namespace fencepost::test
