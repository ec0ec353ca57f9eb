// Keeps labels from overlapping, and within the drawing.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// About, px, of the drawings' bold text; rather too wide.
double text_width(std::string_view text);

/// Names as far as they fit: what is longer is cut in its middle, and never so that two different ones read alike.
class ShortNames {
 public:
  explicit ShortNames(double widest) : widest_(widest) {}
  std::string shortened(const std::string& name);

 private:
  double widest_;                             ///< px
  std::map<std::string, std::string> shown_;  ///< texts by the short label in their place
};

class LabelSpace {
 public:
  /// Labels stay between these, px.
  struct Bounds {
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
  };
  explicit LabelSpace(const Bounds& bounds) : bounds_(bounds) {}

  struct Placed {
    Point at;                   ///< the middle of its baseline
    std::optional<Point> from;  ///< it had to go so far that a line should lead to it, from there
  };
  static constexpr double kReach = 260;  ///< px, the furthest that a label goes
  /// The best place is centred at the baseline `best`, above (`direction` -1) or below (+1) the named thing, whose
  /// middle is `named`. Else some lines further that way, then around it, ever further. Nothing where there is no place
  /// left.
  std::optional<Placed> place(Point best, Point named, std::string_view text, int direction, double reach = kReach);

 private:
  struct Taken {
    Point at;
    double half_width;
  };
  [[nodiscard]] bool clear(const Taken& label) const;
  [[nodiscard]] bool inside(const Taken& label) const;
  [[nodiscard]] std::optional<Point> find(const Taken& best, Point named, int direction, double reach) const;
  Bounds bounds_;
  std::vector<Taken> taken_;
};

}  // namespace fencepost::host
