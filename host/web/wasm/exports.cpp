// What the page's script calls. One log at a time; texts and the path are read from memory where these say.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "host/web/page_replay.hpp"

namespace fencepost::host {
namespace {

constexpr std::array<std::string_view, 4> kProfiles = {"", "full", "small", "micro"};
enum Text : std::uint32_t { kResult, kState, kStateWithAlerts, kPage };

std::array<char, 65536> input;
std::unique_ptr<PageReplay> replayed;
std::string text;

}  // namespace
}  // namespace fencepost::host

#define FENCEPOST_EXPORT(name) extern "C" __attribute__((export_name(#name))) auto fencepost_##name

namespace page = fencepost::host;

/// `profile`: 0 the log's, 1 full, 2 small, 3 micro.
FENCEPOST_EXPORT(open)(std::uint32_t profile)->void {
  page::replayed = nullptr;
  page::replayed = std::make_unique<page::PageReplay>(page::kProfiles.at(profile));
}

/// Where `feed` takes its bytes from.
FENCEPOST_EXPORT(input)()->char* { return page::input.data(); }
FENCEPOST_EXPORT(input_size)()->std::size_t { return page::input.size(); }

/// Of `size` bytes at `input`, how many were used: up to the first input at or after `until`, s, or to a new run.
FENCEPOST_EXPORT(feed)(std::size_t size, double until)->std::size_t {
  return page::replayed->feed({page::input.data(), size}, until);
}
FENCEPOST_EXPORT(finish)()->void { page::replayed->finish(); }
FENCEPOST_EXPORT(ended)()->bool { return page::replayed->log().ended(); }
FENCEPOST_EXPORT(time)()->double { return page::replayed->log().time(); }
FENCEPOST_EXPORT(runs)()->std::uint32_t { return page::replayed->log().runs(); }

/// The path so far: poses of four doubles t, x, y, heading.
FENCEPOST_EXPORT(path)()->const page::PoseResult* { return page::replayed->log().path().data(); }
FENCEPOST_EXPORT(path_size)()->std::size_t { return page::replayed->log().path().size(); }
static_assert(sizeof(page::PoseResult) == 4 * sizeof(double));

/// Makes a text at `text` and returns its size: 0 the result document, 1 the same without path and alerts, 2 without
/// path, 3 what else the page shows.
FENCEPOST_EXPORT(write)(std::uint32_t what)->std::size_t {
  page::text = what == page::kResult ? page::replayed->result()
               : what == page::kPage ? page::replayed->page()
                                     : page::replayed->state(what == page::kStateWithAlerts);
  return page::text.size();
}
FENCEPOST_EXPORT(text)()->const char* { return page::text.data(); }
