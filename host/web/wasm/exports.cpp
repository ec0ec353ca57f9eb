// The functions that the page's script calls. One log, drive or camera at a time; texts and the path are read from
// memory where these say.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "host/configure/configure.hpp"
#include "host/scene/json_reader.hpp"
#include "host/scene/load.hpp"
#include "host/web/board.hpp"
#include "host/web/drive.hpp"
#include "host/web/page_replay.hpp"
#include "host/web/webcam.hpp"

namespace fencepost::host {
namespace {

constexpr std::array<std::string_view, 4> kProfiles = {"", "full", "small", "micro"};
enum Text : std::uint32_t { kResult, kState, kStateWithAlerts, kPage, kDriven, kTruth, kScore };

std::array<char, 65536> input;
std::unique_ptr<PageReplay> replayed;
std::unique_ptr<Drive> driven;
std::unique_ptr<Webcam> watched;
std::string scene;
std::string text;
std::vector<std::string> given;  // the page's words of a request
std::string board_image;

// A scene with a fault ends in __cxa_throw.
Scene given_scene() { return *parse_scene(std::exchange(scene, {}), "scene"); }
LiveLog& live() { return watched ? watched->live() : driven->live(); }
const PageReplay& shown() { return replayed ? *replayed : live().page(); }

}  // namespace
}  // namespace fencepost::host

#define FENCEPOST_EXPORT(name) extern "C" __attribute__((export_name(#name))) auto fencepost_##name

namespace page = fencepost::host;

/// `profile`: 0 the log's, 1 full, 2 small, 3 micro.
FENCEPOST_EXPORT(open)(std::uint32_t profile)->void {
  page::replayed = nullptr;
  page::driven = nullptr;
  page::replayed = std::make_unique<page::PageReplay>(page::kProfiles.at(profile));
}

/// Where `feed` takes its bytes from.
FENCEPOST_EXPORT(input)()->char* { return page::input.data(); }
FENCEPOST_EXPORT(input_size)()->std::size_t { return page::input.size(); }

/// Feeds `size` bytes at `input` and returns the number used: up to the first input at or after `until`, s, or to a new
/// run.
FENCEPOST_EXPORT(feed)(std::size_t size, double until)->std::size_t {
  return page::replayed->feed({page::input.data(), size}, until);
}
FENCEPOST_EXPORT(finish)()->void { page::replayed->finish(); }
FENCEPOST_EXPORT(ended)()->bool { return page::replayed->log().ended(); }
FENCEPOST_EXPORT(time)()->double { return page::shown().log().time(); }
FENCEPOST_EXPORT(runs)()->std::uint32_t { return page::replayed->log().runs(); }

/// The path so far: poses of four doubles t, x, y, heading.
FENCEPOST_EXPORT(path)()->const page::PoseResult* { return page::shown().log().path().data(); }
FENCEPOST_EXPORT(path_size)()->std::size_t { return page::shown().log().path().size(); }
static_assert(sizeof(page::PoseResult) == 4 * sizeof(double));

/// Makes a text at `text` and returns its size. 0: the result document, 1: the same without path and alerts, 2: without
/// path, 3: what else the page shows. Of a drive or a camera, 4: as 1 with the alerts since the last time; of a
/// drive, 5: the truth, 6: the score.
FENCEPOST_EXPORT(write)(std::uint32_t what)->std::size_t {
  switch (what) {
    case page::kResult: page::text = page::shown().result(); break;
    case page::kPage: page::text = page::shown().page(); break;
    case page::kDriven: page::text = page::live().state(); break;
    case page::kTruth: page::text = page::driven->truth(); break;
    case page::kScore: page::text = page::driven->score(); break;
    default: page::text = page::shown().state(what == page::kStateWithAlerts);
  }
  return page::text.size();
}
/// The score of the log's map of now against the scene that was given, as JSON at `text`. A fault in it traps as in
/// `drive`.
FENCEPOST_EXPORT(score)()->std::size_t {
  const fencepost::host::LogReplay& log = page::replayed->log();
  page::text = page::to_json(page::map_score(log.now(false).objects, page::given_scene(), log.time()));
  return page::text.size();
}
FENCEPOST_EXPORT(text)()->const char* { return page::text.data(); }
FENCEPOST_EXPORT(text_size)()->std::size_t { return page::text.size(); }

/// `size` more bytes at `input` of the scene that is given next.
FENCEPOST_EXPORT(scene)(std::size_t size)->void { page::scene.append(page::input.data(), size); }
/// A robot is driven through that scene; or the world becomes it. One with a fault traps, and `text` says what it is.
FENCEPOST_EXPORT(drive)()->void { page::driven = std::make_unique<page::Drive>(page::given_scene()); }
FENCEPOST_EXPORT(change)()->void { page::driven->change(page::given_scene()); }
FENCEPOST_EXPORT(steer)(double forward, double turn)->void { page::driven->steer(forward, turn); }
FENCEPOST_EXPORT(obey)(bool stops)->void { page::driven->obey(stops); }
FENCEPOST_EXPORT(advance)(double seconds)->bool { return page::driven->advance(seconds); }
FENCEPOST_EXPORT(end)()->void { page::live().finish(); }
FENCEPOST_EXPORT(log)()->const char* { return page::live().text().data(); }
FENCEPOST_EXPORT(log_size)()->std::size_t { return page::live().text().size(); }

/// A camera is looked through whose pictures have that size; each is put at `pixels`.
FENCEPOST_EXPORT(watch)(std::uint32_t width, std::uint32_t height)->void {
  page::watched = std::make_unique<page::Webcam>(static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(height));
}
FENCEPOST_EXPORT(pixels)()->std::uint8_t* { return page::watched->pixels().data(); }
FENCEPOST_EXPORT(look)(double t)->bool { return page::watched->look(t); }
/// Trains the colour at a pixel, or writes the file of the colours. The answer is at `text`, its size returned.
FENCEPOST_EXPORT(train)(std::int32_t u, std::int32_t v)->std::size_t {
  page::text = page::watched->train(u, v);
  return page::text.size();
}
FENCEPOST_EXPORT(colours)()->std::size_t {
  page::text = page::watched->colours();
  return page::text.size();
}

/// `size` more bytes at `input`: a word of the request, or the next part of an image's file.
FENCEPOST_EXPORT(word)(std::size_t size)->void { page::given.emplace_back(page::input.data(), size); }
FENCEPOST_EXPORT(image)(std::size_t size)->void { page::board_image.append(page::input.data(), size); }
/// Writes the choices of that image as JSON at `text`. One with a fault traps, and `text` says what it is; so does the
/// next one.
FENCEPOST_EXPORT(board)()->std::size_t {
  const auto choices = page::board_choices(page::board_image);
  page::text = choices.ok() ? choices->json : choices.error();
  if (!choices.ok()) __builtin_trap();
  return page::text.size();
}
/// The board's file, at `image_file`, and JSON at `text`. Words: format, robot file, then each setting's key and value.
FENCEPOST_EXPORT(configure)()->std::size_t {
  page::BoardRequest request;
  if (page::given.size() < 2) __builtin_trap();
  request.format = page::given[0];
  request.robot = page::given[1];
  for (std::size_t i = 2; i + 1 < page::given.size(); i += 2) {
    request.settings.emplace_back(page::given[i], page::given[i + 1]);
  }
  auto made = page::board_file(page::board_image, request);
  page::text = made.ok() ? made->said : made.error();
  if (!made.ok()) __builtin_trap();
  page::board_image = std::move(made->bytes);
  return page::text.size();
}
FENCEPOST_EXPORT(image_file)()->const char* { return page::board_image.data(); }
FENCEPOST_EXPORT(image_file_size)()->std::size_t { return page::board_image.size(); }

// Readers of JSON throw a SceneProblem, the work on an image throws a ConfigureProblem, and nothing else throws. There
// is no catching here: this ends the call.
extern "C" void* __cxa_allocate_exception(std::size_t size) noexcept { return std::malloc(size); }
extern "C" [[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*)(void*)) {
  if (*type == typeid(page::ConfigureProblem)) {
    page::text = static_cast<const page::ConfigureProblem*>(thrown)->message;
  } else {
    const auto& problem = *static_cast<const page::SceneProblem*>(thrown);
    const char* file = page::given.empty() ? "scene" : "robot.json";
    page::text = page::SceneError{file, problem.where, problem.what, problem.remedy}.message();
  }
  __builtin_trap();
}
