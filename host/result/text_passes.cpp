#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/result/lookup.hpp"
#include "host/result/text.hpp"

namespace fencepost::host {
namespace {

const SideRule* rule_for(const ResultDocument& document, const PassResult& pass, const std::vector<SideRule>& sides) {
  const std::string name = signature_name(document, pass.signature);
  const auto rule = std::find_if(sides.begin(), sides.end(), [&](const SideRule& side) { return side.name == name; });
  return rule == sides.end() ? nullptr : &*rule;
}

bool wrong(const ResultDocument& document, const PassResult& pass, const std::vector<SideRule>& sides) {
  const SideRule* rule = rule_for(document, pass, sides);
  return rule != nullptr && rule->on_the_right != pass.on_the_right;
}

std::string bearing_words(double bearing) {
  const long degrees = std::lround(bearing * 180 / std::numbers::pi);
  if (degrees == 0) return "ahead";
  return fmt::format("{} deg {}", std::labs(degrees), degrees > 0 ? "left" : "right");
}

}  // namespace

std::string_view side_word(const PassResult& pass) { return pass.on_the_right ? "right" : "left"; }

std::string pass_table(const ResultDocument& document, const std::vector<SideRule>& sides) {
  if (document.passes.empty()) return "Nothing was passed.\n";
  std::string text = "  passed at  id name       on its  nearest  known at  then\n";
  for (const PassResult& pass : document.passes) {
    text += fmt::format("{:>9.3f} s {:>3} {:<10.10} {:<6} {:>6.2f} m {:>7.2f} s  {:.2f} m, {}", pass.t, pass.id,
                        signature_name(document, pass.signature), side_word(pass), pass.distance, pass.known_at,
                        pass.known_distance, bearing_words(pass.bearing));
    text += wrong(document, pass, sides) ? "  WRONG SIDE\n" : "\n";
  }
  return text;
}

std::size_t wrong_sides(const ResultDocument& document, const std::vector<SideRule>& sides) {
  return static_cast<std::size_t>(std::count_if(document.passes.begin(), document.passes.end(),
                                                [&](const PassResult& pass) { return wrong(document, pass, sides); }));
}

}  // namespace fencepost::host
