#include "host/devices/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/devices/catalogue.hpp"
#include "host/devices/open_devices.hpp"
#include "host/text/device_word.hpp"

namespace fencepost::devices {
namespace {

using host::listed;

struct Sign {
  const Option& option;

  std::string operator()(const Words& values) const {
    std::string text = fmt::format("{}={}", *option.name, fmt::join(values.words, "|"));
    const bool first = values.words.front() == *option.fallback;
    return first ? text : text + fmt::format(" ({})", *option.fallback);
  }
  std::string operator()(const Whole& /*values*/) const { return fmt::format("{}={}", *option.name, *option.fallback); }
  std::string operator()(const Metres& /*values*/) const {
    return fmt::format("{}={}", *option.name, *option.fallback);
  }
  std::string operator()(const AnyText& /*values*/) const { return fmt::format("{}=TEXT", *option.name); }
};

/// "address=0x54": the option with its default, or the first of several words.
std::string sign(const Option& option) { return std::visit(Sign{option}, *option.values); }

std::string shown_place(PlaceKind place, Use use) {
  if (use != Use::kEmulated || place == PlaceKind::kCan) return std::string(place_pattern(place));
  return place == PlaceKind::kTcp ? "tcp:[HOST:]PORT" : "a pty";
}

std::vector<std::string> shown_places(const std::vector<PlaceKind>& places, Use use) {
  std::vector<std::string> words;
  for (const PlaceKind place : places) {
    std::string word = shown_place(place, use);
    if (!word.empty()) words.push_back(std::move(word));
  }
  return words;
}

/// `serial=TEXT` of the one that is meant (usb).
std::string explained(const Option& option, Use use, std::size_t places) {
  std::string text = "`" + sign(option) + "`";
  if (!option.help.empty()) text += " " + option.help;
  const bool some = !option.places.empty() && option.places.size() < places;
  if (!some || *option.name == "baud") return text;
  std::vector<std::string> words;
  for (const std::string& place : shown_places(option.places, use)) words.push_back("`" + place + "`");
  return text + " (" + listed(words) + ")";
}

std::string explained_options(const Row& row, Use use) {
  std::string text;
  for (const Option& option : options_of(row, use)) {
    text += (text.empty() ? "" : "; ") + explained(option, use, places_of(row, use).size());
  }
  // A bar would end the table's cell.
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string image_of_row(const emulate::ImageLimits& image) {
  std::string text = fmt::format("{} x {}, {:g} /s", image.width, image.height, image.max_rate);
  if (image.first_signature > 0 || image.last_signature < 255) {
    text += fmt::format(", signatures {} to {}", image.first_signature, image.last_signature);
  }
  if (image.max_blobs < 16) text += fmt::format(", {} blobs", image.max_blobs);
  if (image.max_of_signature < image.max_blobs) text += fmt::format(", {} of a signature", image.max_of_signature);
  return text;
}

std::string told(const Emulated& emulated) {
  const std::string image = emulated.image ? image_of_row(*emulated.image) : "";
  return image + (image.empty() || emulated.tells->empty() ? "" : "; ") + *emulated.tells;
}

std::string live_table(Use use, std::string_view title) {
  std::string text = fmt::format("| {} | | places | on a board |\n|---|---|---|---|\n", title);
  for (const Row* row : rows_for(use)) {
    std::vector<std::string> places;
    for (const std::string& place : shown_places(places_of(*row, use), use)) {
      places.push_back(place.starts_with("a ") ? place : "`" + place + "`");
    }
    std::vector<std::string> images;
    for (const std::string& image : row->images) images.push_back("`" + image + "`");
    text += fmt::format("| [`{0}`](sensors/{0}.md) | {1} | {2} | {3} |\n", *row->name, *row->about, listed(places),
                        listed(images));
  }
  return text;
}

std::string options_table() {
  std::string text = "| device | options of `run` |\n|---|---|\n";
  for (const Use use : {Use::kCamera, Use::kOdometry}) {
    for (const Row* row : rows_for(use))
      text += fmt::format("| `{}` | {} |\n", *row->name, explained_options(*row, use));
  }
  return text;
}

std::string lens_table() {
  std::string text =
      "| camera | image | across | focal length, px | lens, k1 | latency | source |\n|---|---|---|---|---|---|---|\n";
  for (const Row* row : rows_for(Use::kCamera)) {
    const auto& driver = std::get<CameraDriver>((*row->live)->driver);
    const auto seen = nominal_camera(*row);
    if (!seen) continue;
    const bool fisheye = seen->lens == sensor::Lens::kEquidistant;
    const double half = 0.5 * seen->width / seen->fx.to_double();
    const double across = 2 * (fisheye ? half : std::atan(half)) * 180 / std::numbers::pi;
    text += fmt::format("| `{}` | {} x {} | {:.1f} deg | {:.2f} x {:.2f} | {}, {:g} | {:g} ms | {} |\n", *row->name,
                        seen->width, seen->height, across, seen->fx.to_double(), seen->fy.to_double(), name(seen->lens),
                        seen->k1.to_double(), 1e3 * seen->latency.to_double(), *driver.lens);
  }
  return text;
}

std::string unready_table() {
  std::string text = "| device | why, or what to try |\n|---|---|\n";
  for (const Use use : {Use::kCamera, Use::kOdometry}) {
    for (const Row* row : rows_for(use)) {
      if (places_of(*row, use).front() == PlaceKind::kNone) continue;  // the console
      text += fmt::format("| `{}` | {} |\n", *row->name, *(*row->live)->unready);
    }
  }
  return text;
}

std::string emulated_table() {
  std::string text = "| device | what it can tell |\n|---|---|\n";
  for (const Row* row : rows_for(Use::kEmulated)) {
    const bool can = places_of(*row, Use::kEmulated).front() == PlaceKind::kCan;
    text += fmt::format("| `{}{}` | {} |\n", *row->name, can ? ":INTERFACE" : "", told(**row->emulated));
  }
  return text;
}

}  // namespace

std::string help_for(Use use, std::span<const std::string> kinds) {
  std::string text;
  for (const Row* row : rows_for(use)) {
    if (!kinds.empty() && std::ranges::find(kinds, *row->name) == kinds.end()) continue;
    std::string about = *row->about;
    std::erase(about, '`');
    text += fmt::format("  {:<10}  {}\n", *row->name, about);
    const std::string places = listed(shown_places(places_of(*row, use), use));
    if (use != Use::kEmulated && !places.empty()) text += fmt::format("  {:<10}    at {}\n", "", places);
    std::vector<std::string> options;
    for (const Option& option : options_of(*row, use)) options.push_back(sign(option));
    if (!options.empty()) text += fmt::format("  {:<10}    {}\n", "", fmt::join(options, " "));
  }
  return text;
}

std::string devices_document() {
  return R"(# Devices

The cameras and wheels that Fencepost knows, as `fencepost devices` lists them. A name leads to its page. Nobody has
connected the real things: the facts come from makers' documents and sources, or from others. Latencies are assumed,
until [calibrated](calibrate.md).

A device is named `KIND:PLACE[,option=value...]`; of an option's words the first is the default. On a board `set camera`
and `set odometry` ([console](console.md)) choose by the name in the last column. [`emulate`](emulate.md) plays all but
the console, webcams and films. Here it is a Pixy2, in two terminals in the top folder of the sources:

    fencepost emulate pixy2 create2 host/share/doc/sensors/pixy2.json --link ./camera --link ./wheels
    fencepost run --camera pixy2:./camera --odometry create2:./wheels --robot host/share/doc/sensors/pixy2.json --seconds 14 --log run.log

Each camera has a scene beside its page, a red box 1.8 m ahead of a robot that stops before it. A CMUcam is run with
`settle=0`. [`fencepost doctor --camera KIND:PLACE`](doctor.md#devices) tries a real one.

)" + live_table(Use::kCamera, "camera") +
         "\n" + live_table(Use::kOdometry, "odometry");
}

std::string device_facts() {
  return options_table() + "\n" + lens_table() + "\n" + unready_table() + "\n" + emulated_table();
}

}  // namespace fencepost::devices
