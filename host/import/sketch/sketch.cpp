#include "host/import/sketch/sketch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"

namespace fencepost::host {
namespace {

constexpr double kDay = 86'400;  // s
constexpr double kMaxBack = 1;   // s, by which a computer's clock may be put back during a recording

/// Centre rounded down; columns count the pixels, rows of a Pixy the difference of the edges (drivers/pixy2).
ImportedBlob centred(double x, double y, double width, double height, bool pixy) {
  ImportedBlob blob;
  blob.x1 = x - std::floor(width / 2);
  blob.x2 = blob.x1 + width - 1;
  blob.y1 = y - std::floor(height / 2);
  blob.y2 = blob.y1 + height - (pixy ? 0 : 1);
  return blob;
}

class Reader {
 public:
  /// `rate`: of frames without the monitor's times.
  Reader(const std::string& file, double rate) : file_(file), rate_(rate) {}

  /// errors: ImportProblem: a clock that runs backwards
  void take(std::string_view line) {
    ++line_;
    const StampedLine stamped = without_stamp(line);
    note_time(stamped.t);
    const std::string_view text = trimmed_text(stamped.text);
    if (text.empty()) return;
    if (take_pixy(text) || take_huskylens(text) || take_cmucam(text)) return;
    ++taken_.skipped["lines of no known form"];
  }

  Taken finish() {
    if (!stamped_ && !taken_.frames.empty()) {
      taken_.notes.push_back("the text has no times: frames are taken to come " + std::to_string(std::lround(rate_)) +
                             " times a second (--rate); the monitor of the Arduino IDE can show them");
    }
    return std::move(taken_);
  }

 private:
  void note_time(std::optional<double> t) {
    if (!t) return;
    stamped_ = true;
    if (*t + days_ + kDay / 2 < now_) days_ += kDay;  // past midnight
    if (*t + days_ + kMaxBack < now_) {
      throw ImportProblem{file_ + ":" + std::to_string(line_), "has an earlier time than a line above it",
                          "save each recording to a file of its own"};
    }
    now_ = std::max(now_, *t + days_);
  }
  void begin_frame() {
    TakenFrame frame;
    frame.t = stamped_ ? now_ : static_cast<double>(taken_.frames.size()) / rate_;
    taken_.frames.push_back(std::move(frame));
    announced_ = true;
  }

  /// "Detected 2", "  block 0: sig: 1 x: 5 y: 6 width: 7 height: 8 index: 9 age: 10", "CC block sig: 12 (10 decimal) x:
  /// ...".
  bool take_pixy(std::string_view text) {
    if (text.starts_with("Detected ") || text.starts_with("Number of blocks: ")) {
      begin_frame();
      return true;
    }
    const auto signature = value_after(text, "sig");
    const auto x = value_after(text, "x");
    const auto y = value_after(text, "y");
    const auto width = value_after(text, "width");
    const auto height = value_after(text, "height");
    if (!signature || !x || !y || !width || !height) return false;
    if (text.find("CC block") != std::string_view::npos || *signature > 7 || *signature < 1) {
      ++taken_.skipped["colour codes"];
      return true;
    }
    const bool first = text.find("block 0:") != std::string_view::npos;
    // Some take the announcement out; the blocks' numbers then say where a frame begins, or nothing does.
    if (taken_.frames.empty() || (first && !announced_) || (!numbered(text) && !announced_)) begin_frame();
    announced_ = false;
    add(centred(*x, *y, *width, *height, true), *signature);
    return true;
  }
  static bool numbered(std::string_view text) { return text.find("block ") != std::string_view::npos; }

  /// "###########", "Block:xCenter=1,yCenter=2,width=3,height=4,ID=5", "Arrow:...".
  bool take_huskylens(std::string_view text) {
    const bool nothing = text.starts_with("No block or arrow appears");
    if (nothing || text.find_first_not_of('#') == std::string_view::npos) {
      begin_frame();
      return true;
    }
    if (text.starts_with("Arrow:")) {
      ++taken_.skipped["arrows"];
      return true;
    }
    if (!text.starts_with("Block:")) return false;
    const auto x = value_after(text, "xCenter");
    const auto y = value_after(text, "yCenter");
    const auto width = value_after(text, "width");
    const auto height = value_after(text, "height");
    const auto id = value_after(text, "ID");
    if (!x || !y || !width || !height || !id) return false;
    if (*id == 0) {  // seen, but not learned
      ++taken_.skipped["blocks that were not learned"];
      return true;
    }
    if (taken_.frames.empty()) begin_frame();
    add(centred(*x, *y, *width, *height, false), *id);
    return true;
  }

  /// "T mx my x1 y1 x2 y2 pixels confidence", and the eight numbers alone; all zero: nothing seen.
  bool take_cmucam(std::string_view text) {
    std::vector<std::string_view> words = words_of(text);
    if (!words.empty() && words.front() == "T") words.erase(words.begin());
    std::array<double, 8> v{};
    if (words.size() != v.size()) return false;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto value = number_in(words[i]);
      if (!value || *value < 0 || *value != std::floor(*value)) return false;
      v[i] = *value;
    }
    if (v[2] > v[4] || v[3] > v[5]) return false;
    begin_frame();
    if (v[7] == 0) return true;  // no confidence
    ImportedBlob blob;
    blob.cx = v[0];
    blob.cy = v[1];
    blob.x1 = v[2];
    blob.y1 = v[3];
    blob.x2 = v[4];
    blob.y2 = v[5];
    add(blob, 1);
    return true;
  }

  void add(ImportedBlob blob, double signature) {
    blob.signature = static_cast<int>(signature);
    taken_.frames.back().blobs.push_back(blob);
  }

  const std::string& file_;
  std::size_t line_ = 0;
  double rate_;
  Taken taken_;
  double now_ = 0;
  double days_ = 0;
  bool stamped_ = false;
  bool announced_ = false;  ///< a frame has begun of which no blob was read yet
};

}  // namespace

ImportResult import_sketch(std::string_view text, const std::string& file, const TakeSettings& settings) {
  try {
    Reader reader(file, settings.rate);
    for (const std::string_view line : lines_of(text)) reader.take(line);
    return log_of(reader.finish(), settings, file, "import-sketch");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
