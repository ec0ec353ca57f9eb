#include "host/import/csv/csv.hpp"

#include <algorithm>
#include <cmath>

#include "host/import/csv/columns.hpp"
#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"

namespace fencepost::host {
namespace {

using Column = std::optional<std::size_t>;

/// A box, however its columns say it.
struct BoxColumns {
  Column x1, y1, x2, y2;                  ///< inclusive pixels
  Column x, y, left, top, width, height;  ///< a centre, or the upper left pixel
  Column cx, cy;                          ///< the centroid; where there is no width, a bearing

  explicit BoxColumns(const CsvReader& csv)
      : x1(csv.find({"x1", "xmin", "x_min"})),
        y1(csv.find({"y1", "ymin", "y_min"})),
        x2(csv.find({"x2", "xmax", "x_max", "right"})),
        y2(csv.find({"y2", "ymax", "y_max", "bottom"})),
        x(csv.find({"x", "xcenter", "x_center", "center_x"})),
        y(csv.find({"y", "ycenter", "y_center", "center_y"})),
        left(csv.find({"left"})),
        top(csv.find({"top"})),
        width(csv.find({"width", "w"})),
        height(csv.find({"height", "h"})),
        cx(csv.find({"cx", "centroid_x"})),
        cy(csv.find({"cy", "centroid_y"})) {
    if (!x1) x1 = left;
    if (!y1) y1 = top;
    if (x && x1) csv.refuse_both(*x, *x1);
    if (y && y1) csv.refuse_both(*y, *y1);
    if (x1 && y1 && x2 && y2) return;
    if (left && top && width && height) return;
    if (cx && cy && !width && !x2) return;
    // The messages are about the form that most programs write.
    static_cast<void>(csv.need({"x", "xcenter", "x_center", "center_x", "x1", "left"}));
    static_cast<void>(csv.need({"y", "ycenter", "y_center", "center_y", "y1", "top"}));
    static_cast<void>(csv.need({"width", "w", "x2", "right"}));
    static_cast<void>(csv.need({"height", "h", "y2", "bottom"}));
  }

  [[nodiscard]] bool has_nothing(const CsvRow& row) const { return !has_columns(row) && !has_centroid(row); }

  void read(const CsvRow& row, ImportedBlob& blob) const {
    if (cx && !row.empty(*cx)) blob.cx = row.number(*cx);
    if (cy && !row.empty(*cy)) blob.cy = row.number(*cy);
    blob.bearing = !has_columns(row);
    if (blob.bearing) {
      if (!blob.cx || !blob.cy) {
        throw ImportProblem{row.place(), "is a centre of which one number is missing",
                            "a bearing has cx and cy, and no x1, x2 or width"};
      }
      return;
    }
    if (x1 && y1 && x2 && y2) {
      blob.x1 = row.number(*x1);
      blob.y1 = row.number(*y1);
      blob.x2 = row.number(*x2);
      blob.y2 = row.number(*y2);
    } else {
      const double w = row.number(*width);
      const double h = row.number(*height);
      blob.x1 = left ? row.number(*left) : row.number(*x) - std::floor(w / 2);
      blob.y1 = top ? row.number(*top) : row.number(*y) - std::floor(h / 2);
      blob.x2 = blob.x1 + w - 1;
      blob.y2 = blob.y1 + h - 1;
    }
    if (blob.x1 > blob.x2 || blob.y1 > blob.y2) {
      throw ImportProblem{row.place(), "is a box of no size", "x1 is left of x2, y1 above y2; width and height are px"};
    }
  }

 private:
  // Does it say where the box is in a row of the image? One of two columns alone is refused where it is read.
  [[nodiscard]] bool has_columns(const CsvRow& row) const {
    const auto says = [&](const Column& column) { return column && !row.empty(*column); };
    if (x1 && x2) return says(x1) || says(x2);
    return says(left) || (says(x) && width) || says(width);
  }
  [[nodiscard]] bool has_centroid(const CsvRow& row) const {
    return (cx && !row.empty(*cx)) || (cy && !row.empty(*cy));
  }
};

/// "timestamp tx ty tz qx qy qz qw", the format of the TUM RGB-D benchmark: the first line that is no comment has them.
bool is_tum(std::string_view text) {
  for (const std::string_view line : lines_of(text)) {
    if (trimmed_text(line).empty() || line.front() == '#') continue;
    const auto words = words_of(line);
    return words.size() == 8 &&
           std::ranges::all_of(words, [](const auto& word) { return number_in(word).has_value(); });
  }
  return false;
}

std::vector<TimedPose> parse_tum(std::string_view text, const std::string& file) {
  std::vector<TimedPose> poses;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (trimmed_text(line).empty() || line.front() == '#') continue;
    std::vector<double> v;
    for (const std::string_view word : words_of(line)) v.push_back(number_in(word).value_or(NAN));
    if (v.size() != 8 || std::ranges::any_of(v, [](double value) { return std::isnan(value); })) {
      throw ImportProblem{file + ":" + std::to_string(number), "is no pose",
                          "expected: timestamp tx ty tz qx qy qz qw"};
    }
    constexpr double kRounding = 0.1;  // of a quaternion's length, printed with two decimals
    if (std::fabs(v[4] * v[4] + v[5] * v[5] + v[6] * v[6] + v[7] * v[7] - 1) > kRounding) {
      throw ImportProblem{file + ":" + std::to_string(number), "has a quaternion whose length is not 1",
                          "expected: timestamp tx ty tz qx qy qz qw"};
    }
    // z up, as a robot's poses are; the heading is that of its x axis.
    poses.push_back(
        {v[0], v[1], v[2], std::atan2(2 * (v[7] * v[6] + v[4] * v[5]), 1 - 2 * (v[5] * v[5] + v[6] * v[6]))});
  }
  return poses;
}

class BlobTable {
 public:
  BlobTable(std::string_view text, const std::string& file)
      : csv_(text, file),
        time_(csv_.need({"t", "time", "timestamp", "seconds", "sec"})),
        box_(csv_),
        signature_(csv_.find({"signature", "sig", "id", "class_id", "class"})),
        name_(csv_.find({"name", "colour", "color", "label"})),
        pixels_(csv_.find({"pixels", "area"})) {}

  Taken take() {
    csv_.each([this](const CsvRow& row) { take_row(row); });
    if (taken_.frames.empty()) {
      throw ImportProblem{csv_.file(), "has names of columns and no rows", "check that the copy is complete"};
    }
    for (const auto& [name, number] : numbers_) taken_.names[number] = name;
    return std::move(taken_);
  }

 private:
  void take_row(const CsvRow& row) {
    const double t = row.number(time_);
    if (taken_.frames.empty() || taken_.frames.back().t != t) taken_.frames.push_back({t, {}});
    if (box_.has_nothing(row)) return;
    ImportedBlob blob;
    box_.read(row, blob);
    blob.signature = signature_of(row);
    if (pixels_ && !row.empty(*pixels_)) blob.pixels = static_cast<std::uint32_t>(std::max(0.0, row.number(*pixels_)));
    taken_.frames.back().blobs.push_back(blob);
  }

  int signature_of(const CsvRow& row) {
    const std::string name = name_ ? std::string(row.text(*name_)) : std::string();
    if (signature_ && number_in(row.text(*signature_))) {
      const int number = static_cast<int>(row.number(*signature_));
      if (!name.empty()) taken_.names[number] = name;
      return number;
    }
    const std::string word = signature_ ? std::string(row.text(*signature_)) : name;
    if (word.empty()) return 1;
    return numbers_.try_emplace(word, static_cast<int>(numbers_.size()) + 1).first->second;
  }

  CsvReader csv_;
  std::size_t time_;
  BoxColumns box_;
  Column signature_, name_, pixels_;
  std::map<std::string, int> numbers_;
  Taken taken_;
};

}  // namespace

std::vector<TimedPose> parse_pose_table(std::string_view text, const std::string& file) {
  if (is_tum(text)) return parse_tum(text, file);
  const CsvReader csv(text, file);
  const std::size_t t = csv.need({"t", "time", "timestamp", "seconds", "sec"});
  const std::size_t x = csv.need({"x", "px", "pos_x"});
  const std::size_t y = csv.need({"y", "py", "pos_y"});
  const std::size_t heading = csv.need({"heading", "theta", "yaw", "pa"});
  std::vector<TimedPose> poses;
  csv.each([&](const CsvRow& row) {
    poses.push_back({row.number(t), row.number(x), row.number(y), row.number(heading)});
  });
  return poses;
}

Taken take_csv(std::string_view blobs, const std::string& file) { return BlobTable(blobs, file).take(); }

ImportResult import_csv(std::string_view blobs, const std::string& file, const TakeSettings& settings) {
  try {
    return log_of(take_csv(blobs, file), settings, file, "import-csv");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
