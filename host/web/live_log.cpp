#include "host/web/live_log.hpp"

#include <algorithm>
#include <utility>

#include "host/result/to_json.hpp"

namespace fencepost::host {

LiveLog::LiveLog()
    : page_([this] {
        ReplayOptions options;
        options.alerts = this;
        return options;
      }()) {}

void LiveLog::add(std::string_view line) {
  text_ += line;
  while (!line.empty()) line.remove_prefix(page_.feed(line, kLongest));
}

void LiveLog::hear(const record::AlertReport& alert) {
  fresh_.push_back(alert);
  std::erase_if(in_force_, [&](const record::AlertReport& old) { return old.id == alert.id; });
  in_force_.push_back(alert);
}

bool LiveLog::stopped() const {
  return std::any_of(in_force_.begin(), in_force_.end(),
                     [](const record::AlertReport& alert) { return alert.level == record::AlertLevel::kStop; });
}

std::string LiveLog::state() {
  ResultDocument document = page_.log().now(false);
  document.alerts = std::exchange(fresh_, {});
  for (ObjectResult& object : document.objects) {
    std::erase_if(object.models,
                  [](const ModelResult& model) { return model.name != "hybrid" && model.name != "cylinder"; });
  }
  return to_json(document);
}

}  // namespace fencepost::host
