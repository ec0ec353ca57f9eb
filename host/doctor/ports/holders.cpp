#include "host/doctor/ports/holders.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

#include "host/text/printable.hpp"

namespace fencepost::host::doctor {
namespace {

namespace fs = std::filesystem;

pid_t process_number(const std::string& name) {
  pid_t pid = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
  return error == std::errc() && end == name.data() + name.size() ? pid : 0;
}

/// Whether it has it open; nothing where that is not shown.
std::optional<bool> has_open(const fs::path& process, const fs::path& node) {
  std::error_code problem;
  for (auto entry = fs::directory_iterator(process / "fd", problem); !problem && entry != fs::directory_iterator();
       entry.increment(problem)) {
    std::error_code gone;
    if (fs::read_symlink(entry->path(), gone) == node) return true;
  }
  if (problem == std::errc::permission_denied) return std::nullopt;
  return false;
}

// These take hold of serial ports by themselves.
std::string service_of(const std::vector<Holder>& programs) {
  for (const Holder& holder : programs) {
    if (holder.program == "ModemManager" || holder.program == "brltty") return holder.program;
  }
  return {};
}

}  // namespace

Holders holders_of(const Roots& roots, const std::string& path) {
  Holders holders;
  std::error_code problem;
  const fs::path node = fs::canonical(path, problem);
  if (problem) return holders;
  for (auto entry = fs::directory_iterator(roots.proc, problem); !problem && entry != fs::directory_iterator();
       entry.increment(problem)) {
    const pid_t pid = process_number(entry->path().filename().string());
    if (pid == 0 || pid == ::getpid()) continue;
    const std::optional<bool> open = has_open(entry->path(), node);
    if (!open) holders.all_seen = false;
    if (!open.value_or(false)) continue;
    std::string program;
    std::ifstream file(entry->path() / "comm");
    std::getline(file, program);
    holders.programs.push_back({pid, printable(program)});
  }
  std::ranges::sort(holders.programs, {}, &Holder::pid);
  return holders;
}

std::string holders_text(const Holders& holders) {
  std::string text;
  for (const Holder& holder : holders.programs) {
    text += fmt::format("{}{} (pid {})", text.empty() ? "" : ", ", holder.program, holder.pid);
  }
  if (text.empty()) return holders.all_seen ? "a program that has ended meanwhile" : "a program of another user";
  return text;
}

std::string holders_remedy(const Holders& holders, const std::string& path) {
  if (holders.programs.empty()) return fmt::format("'sudo fuser -v {}' names it", path);
  const std::string service = service_of(holders.programs);
  if (!service.empty()) return fmt::format("type 'sudo systemctl stop {}'", service);
  return fmt::format("close it, or type 'kill {}'", holders.programs.front().pid);
}

}  // namespace fencepost::host::doctor
