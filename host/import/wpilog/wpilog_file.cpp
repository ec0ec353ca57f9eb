#include "host/import/wpilog/wpilog_file.hpp"

#include <unordered_map>

#include "host/import/fields.hpp"
#include "host/import/table.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kWpilogMagic = "WPILOG";
/// The major part of the version 0x0100, which determines the layout.
constexpr unsigned kMajor = 1;
/// Names in one log. Robots have some thousand; more than this is damage, and would take memory.
constexpr std::size_t kMaxEntries = 1U << 16U;

enum Control : std::uint8_t { kStart, kFinish, kSetMetadata };

struct Entry {
  std::string_view name;
  std::string_view type;
};

/// `size` bytes, 1 to 8.
std::uint64_t number(Fields& fields, unsigned size) {
  std::uint64_t value = 0;
  const std::string_view part = fields.take(size);
  for (std::size_t i = 0; i < part.size(); ++i) {
    value |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(part[i])) << (8 * i);
  }
  return value;
}

class WpilogReader {
 public:
  WpilogReader(const std::string& file, const std::function<void(const WpilogRecord&)>& visit)
      : file_(file), visit_(visit) {}

  WpilogEnd read(std::string_view bytes) {
    Fields fields(bytes);
    if (fields.take(kWpilogMagic.size()) != kWpilogMagic) {
      throw ImportProblem{file_, "is no WPILOG", "it begins with the letters WPILOG; is it the right file?"};
    }
    const unsigned minor = fields.integer<std::uint8_t>();
    const unsigned major = fields.integer<std::uint8_t>();
    if (!fields.ended_early() && major != kMajor) {
      throw ImportProblem{file_, "is a WPILOG of version " + std::to_string(major) + "." + std::to_string(minor),
                          "version 1.0 can be read"};
    }
    static_cast<void>(fields.string());  // the extra header
    while (!fields.rest().empty() && !fields.ended_early()) record(fields);
    end_.truncated = fields.ended_early();
    return end_;
  }

 private:
  // The first byte has the lengths of the three numbers that follow it.
  void record(Fields& fields) {
    const unsigned lengths = fields.integer<std::uint8_t>();
    const auto entry = static_cast<std::uint32_t>(number(fields, (lengths & 3U) + 1));
    const std::uint64_t size = number(fields, (lengths >> 2U & 3U) + 1);
    const std::uint64_t time = number(fields, (lengths >> 4U & 7U) + 1);
    const std::string_view data = fields.take(size);
    if (fields.ended_early()) return;
    if (entry == 0) return control(data);
    const auto found = entries_.find(entry);
    if (found == entries_.end()) {
      ++end_.unknown;
      return;
    }
    visit_({found->second.name, found->second.type, 1e-6 * static_cast<double>(static_cast<std::int64_t>(time)), data});
  }

  void control(std::string_view data) {
    Fields fields(data);
    const auto kind = fields.integer<std::uint8_t>();
    const auto entry = fields.integer<std::uint32_t>();
    if (kind == kStart) {
      const std::string_view name = fields.string();
      entries_[entry] = {name, fields.string()};
      if (entries_.size() > kMaxEntries) {
        throw ImportProblem{file_, "has more than " + std::to_string(kMaxEntries) + " entries",
                            "it may be damaged; copy it again"};
      }
    } else if (kind == kFinish) {
      entries_.erase(entry);
    }
    if (fields.ended_early() || kind > kSetMetadata) {
      throw ImportProblem{file_, "has a damaged control record", "copy it again, or open it with AdvantageScope"};
    }
  }

  const std::string& file_;
  const std::function<void(const WpilogRecord&)>& visit_;
  std::unordered_map<std::uint32_t, Entry> entries_;
  WpilogEnd end_;
};

}  // namespace

WpilogEnd read_wpilog(std::string_view bytes, const std::string& file,
                      const std::function<void(const WpilogRecord&)>& visit) {
  return WpilogReader(file, visit).read(bytes);
}

}  // namespace fencepost::host
