// One figure of the page: drawings, its numbers as CSV, and what the numbers say about the paper's words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/paper/chart.hpp"
#include "host/paper/evaluation_data.hpp"
#include "host/paper/plan.hpp"
#include "host/render/picture.hpp"

namespace fencepost::host {

struct PaperFile {
  std::string name;
  std::string bytes;
};

enum class ClaimKind : unsigned char {
  kMatches,  ///< the paper's statement holds here too
  kDiffers,  ///< it does not, with the reason
  kBeyond,   ///< not in the paper: better than the paper's algorithms
  kWorse,    ///< not in the paper, and no better
};

/// One sentence, plain text. Its numbers are computed.
struct Claim {
  ClaimKind kind = ClaimKind::kMatches;
  std::string key;  ///< of the figure's claims only this one; the same for other data
  std::string text;
  bool of_scenes = true;   ///< may hold in one scene and not in the next
  std::size_t scenes = 0;  ///< that were looked at one by one, and allow to say anything about it
  std::size_t holds = 0;   ///< number of them in which it does

  [[nodiscard]] bool good() const { return kind == ClaimKind::kMatches || kind == ClaimKind::kBeyond; }
};

struct PaperFigure {
  std::string number;  ///< "4", "12b"
  std::string title;
  std::string html;
  std::vector<Claim> claims;
  std::vector<PaperFile> files;

  /// Adds a chart or plan to the page and as a file.
  void add_svg(const std::string& name, const std::string& svg, std::string_view css_class);
  /// Adds an image with a caption below it (HTML), and its file.
  void add_picture(const std::string& name, const Picture& picture, const std::string& caption);
  void add_file(std::string name, std::string bytes) { files.push_back({std::move(name), std::move(bytes)}); }
  /// A claim of the paper. `holds`: the claim is kMatches, otherwise kDiffers and `otherwise` is appended.
  void say(const std::string& key, bool holds, const std::string& text, const std::string& otherwise = {});
  /// Compares an algorithm that the paper does not have with the paper's own.
  void compare(const std::string& key, bool better, const std::string& text);
  void add(const std::string& markup) { html += markup; }
};

/// Fields are escaped where they must be.
class Csv {
 public:
  explicit Csv(std::string header) : text_(std::move(header) + "\n") {}
  void row(const std::vector<std::string>& fields);
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Fixed decimals; empty if not finite.
std::string csv_number(double value, int decimals = 4);
/// "12.3 %"; a dash if not finite.
std::string percent(double share, int decimals = 1);
std::string landmark_name(std::size_t landmark);

/// Where an axis of image numbers ends.
double axis_end(const PaperData& data);
/// "20 scenes", or "this run" for a recorded one.
std::string scenes_text(const PaperData& data, std::size_t scenes);

/// The first frame from `from` on (else before it) that shows both landmarks whole; `from` if there is none.
std::size_t frame_with_both(const Tour& tour, std::size_t from);

/// The geometry that `algorithm` has of `landmark` at a snapshot; may be empty.
MultiPolygon model_geometry(const SequenceData& data, const Algorithm& algorithm, std::size_t landmark,
                            std::size_t snapshot);

/// " Empty, so that nothing is rendered: red by space carving." of the models of all images of the sequence that is
/// drawn; nothing if none is.
std::string shown_empty(const PaperData& data);

/// Arrows where the first `images` lenses were.
std::vector<PlanLens> first_lenses(const Tour& tour, std::size_t images);

/// The true footprint of a landmark and what every algorithm has of it after `images`.
Plan model_plan(const SequenceData& data, std::size_t landmark, std::size_t images, double side);

PaperFigure figure_4(const PaperData& data);
PaperFigure figure_5(const PaperData& data);
PaperFigure figure_6(const PaperData& data);
PaperFigure figure_7(const PaperData& data);
PaperFigure figure_8(const PaperData& data);
PaperFigure figure_9(const PaperData& data);
PaperFigure figure_10(const PaperData& data);
PaperFigure figure_11(const PaperData& data);
PaperFigure figure_12(const PaperData& data);
PaperFigure figure_12b(const PaperData& data);
PaperFigure figure_13(const PaperData& data);
PaperFigure figure_14(const PaperData& data);

}  // namespace fencepost::host
