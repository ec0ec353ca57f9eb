#include "host/cli/report_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>
#include <utility>

#include "host/cli/alert_spool.hpp"
#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/packed_log.hpp"
#include "host/cli/replay_run.hpp"
#include "host/live/record_line.hpp"
#include "host/web/thinned_run.hpp"
#include "host/web/with_calibration.hpp"

namespace fencepost::host::cli {
namespace {

// A page unpacks a log into its memory.
constexpr std::size_t kMaxUnpacked = 64'000'000;
constexpr PackedLog::Room kWholeRoom = {32'000'000, 400'000'000};  ///< as text of a page 43 MB, as a log some 200
constexpr std::size_t kMinRoom = 30'000;

/// Bytes that base64 of this length unpacks to.
std::size_t unpacked_base64(std::size_t text) { return text / 4 * 3; }
std::size_t base64_of(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// Short ones first; pipes, of which nobody knows, last.
std::vector<std::size_t> by_size(const std::vector<std::string>& logs) {
  std::vector<std::uintmax_t> sizes;
  for (const std::string& log : logs) {
    std::error_code error;
    const bool file = log != "-" && std::filesystem::is_regular_file(log, error);
    sizes.push_back(file ? std::filesystem::file_size(log, error) : std::numeric_limits<std::uintmax_t>::max());
  }
  std::vector<std::size_t> order(logs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sizes[i]; });
  return order;
}

class NoAlerts final : public AlertSink {
  void run_begins() override {}
  void hear(const record::AlertReport& /*alert*/) override {}
};

void replay_whole(PackedLog& packed, const std::string& name, ReplayOptions options, ReportedLog& log) {
  NoAlerts alerts;  // the page finds them anew
  options.alerts = &alerts;
  options.most_poses = 2;
  log.outcome = replay([&packed] { return packed.next(); }, name, options);
  log.given.log = packed.take_packed();
}

void replay_thinned(PackedLog& packed, const std::string& name, const ReplayOptions& options, std::size_t most,
                    ReportedLog& log) {
  AlertSpool alerts;
  ThinnedRun run(options, alerts);
  for (std::string_view bytes = packed.next(); !bytes.empty() && !run.log().ended(); bytes = packed.next()) {
    run.take(bytes);
  }
  run.finish();
  ThinnedText text = run.text([&](const auto& visit) { alerts.each(visit); }, most);
  log.given.log = std::move(text.packed);
  log.given.thinned = true;
  log.thinned = std::move(text.said);
  log.outcome = {run.log().now(false), run.log().check(), run.log().complaints(), run.log().why_unreadable(name),
                 run.log().runs()};
}

void read_report_log(const ReportInputs& inputs, const std::string& path, std::size_t room, ReportedLog& log) {
  LogInput input(path);
  ReplayProgress progress(input);
  LogSource source = [&] { return progress.next(); };
  if (inputs.options.camera) {
    const auto filter = std::make_shared<WithCalibration>(source, record_line(*inputs.options.camera));
    source = [filter] { return filter->next(); };
  }
  const std::string name = input_name(path);
  const std::size_t most = unpacked_base64(room);
  PackedLog packed(source, inputs.whole ? kWholeRoom : PackedLog::Room{most, kMaxUnpacked});
  if (packed.whole()) return replay_whole(packed, name, inputs.options, log);
  if (!inputs.whole) return replay_thinned(packed, name, inputs.options, most, log);
  throw Failure(
      Exit::kUnreadable,
      fmt::format(
          "{} has more than {} MB as gzip packs it, or {} as it is, too much for a browser; leave out --whole, or {}",
          name, kWholeRoom.packed / 1'000'000, kWholeRoom.unpacked / 1'000'000, how_to_make_a_part(path)));
}

}  // namespace

std::string title_of(const std::string& log) {
  return log == "-" ? input_name("-") : std::filesystem::path(log).filename().string();
}

std::vector<ReportedLog> read_report_logs(const ReportInputs& inputs, std::size_t page_size) {
  std::vector<ReportedLog> logs(inputs.logs.size());
  std::size_t used = page_size;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    logs[i].given = {title_of(inputs.logs[i]), {}, inputs.scenes[i]};
    used += bytes_around(logs[i].given);
  }
  std::size_t left = logs.size();
  for (const std::size_t i : by_size(inputs.logs)) {
    const std::size_t room = std::max(kMaxReport - std::min(used, kMaxReport), left * kMinRoom) / left;
    try {
      read_report_log(inputs, inputs.logs[i], room, logs[i]);
    } catch (const Failure& failure) {
      logs[i].failure = failure;
    }
    used += base64_of(logs[i].given.log.size());
    --left;
  }
  return logs;
}

}  // namespace fencepost::host::cli
