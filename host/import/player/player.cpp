#include "host/import/player/player.hpp"

#include <algorithm>
#include <set>

#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"

namespace fencepost::host {
namespace {

// time, host, robot, interface, index, type, subtype
constexpr std::size_t kHead = 7;
constexpr std::size_t kBlobFields = 10;  // id, color, area, x, y, left, right, top, bottom, range

class PlayerLog {
 public:
  explicit PlayerLog(const std::string& file) : file_(file) {}

  void take(std::string_view line, std::size_t number) {
    if (trimmed_text(line).empty() || line.front() == '#') return;
    words_ = words_of(line);
    place_ = file_ + ":" + std::to_string(number);
    if (words_.size() < kHead || !number_in(words_[0]) || !number_in(words_[4])) {
      ++taken_.skipped["lines of no known form"];
      return;
    }
    const bool data = words_[5] == "001" || words_[5] == "1";
    if (!data) return;  // geometries, and replies to requests
    if (words_[3] == "position2d" || words_[3] == "position") {
      take_pose();
    } else if (words_[3] == "blobfinder") {
      take_blobs();
    } else {
      ++taken_.skipped["records of other interfaces"];
    }
  }

  Taken finish() {
    // Most drivers leave the id at 0 and distinguish colours by the colour itself.
    std::set<int> ids;
    for (const auto& frame : taken_.frames) {
      for (const ImportedBlob& blob : frame.blobs) ids.insert(blob.signature);
    }
    if (ids == std::set<int>{0}) number_by_colour();
    return std::move(taken_);
  }

 private:
  [[nodiscard]] double value(std::size_t at) const {
    if (at >= words_.size())
      throw ImportProblem{place_, "ends too early", "the log was cut off there; take the line out"};
    if (const auto number = number_in(words_[at])) return *number;
    throw ImportProblem{place_, quoted(words_[at]) + " is not a number", "correct the line or take it out"};
  }

  void take_pose() {
    if (words_[6] != "001" && words_[6] != "1") return;
    if (!position_) position_ = words_[4];
    if (words_[4] != *position_) {
      ++taken_.skipped["poses of another position2d"];
      return;
    }
    taken_.poses.push_back({value(0), value(kHead), value(kHead + 1), value(kHead + 2)});
  }

  void take_blobs() {
    const int width = static_cast<int>(value(kHead));
    const int height = static_cast<int>(value(kHead + 1));
    const double count = value(kHead + 2);
    if (width > 0 && height > 0) taken_.image = {width, height};
    TakenFrame frame{value(0), {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::clamp(count, 0.0, 1000.0)); ++i) {
      const std::size_t at = kHead + 3 + i * kBlobFields;
      ImportedBlob blob;
      blob.signature = static_cast<int>(value(at));
      const auto colour = static_cast<std::uint32_t>(value(at + 1));
      blob.rgb = sensor::Rgb{static_cast<std::uint8_t>(colour >> 16U), static_cast<std::uint8_t>(colour >> 8U),
                             static_cast<std::uint8_t>(colour)};
      blob.pixels = static_cast<std::uint32_t>(std::max(0.0, value(at + 2)));
      blob.cx = value(at + 3);
      blob.cy = value(at + 4);
      blob.x1 = value(at + 5);
      blob.x2 = value(at + 6);
      blob.y1 = std::min(value(at + 7), value(at + 8));
      blob.y2 = std::max(value(at + 7), value(at + 8));
      static_cast<void>(value(at + 9));
      frame.blobs.push_back(blob);
    }
    taken_.frames.push_back(std::move(frame));
  }

  void number_by_colour() {
    std::map<std::uint32_t, int> numbers;
    for (auto& frame : taken_.frames) {
      for (ImportedBlob& blob : frame.blobs) {
        const sensor::Rgb rgb = *blob.rgb;
        const std::uint32_t colour = rgb.red * 65'536U + rgb.green * 256U + rgb.blue;
        blob.signature = numbers.try_emplace(colour, static_cast<int>(numbers.size()) + 1).first->second;
      }
    }
    taken_.notes.emplace_back("all blobs have id 0: signatures are numbered by colour");
  }

  std::string file_;
  std::string place_;
  std::vector<std::string_view> words_;
  std::optional<std::string_view> position_;
  Taken taken_;
};

}  // namespace

ImportResult import_player(std::string_view text, const std::string& file, const TakeSettings& settings) {
  try {
    PlayerLog log(file);
    std::size_t number = 0;
    for (const std::string_view line : lines_of(text)) log.take(line, ++number);
    return log_of(log.finish(), settings, file, "import-player");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
