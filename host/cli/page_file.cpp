#include "host/cli/page_file.hpp"

#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/share.hpp"

namespace fencepost::host::cli {
namespace {

template <class Fill>
std::string filled(const Fill& fill) {
  const std::string page = find_page();
  const std::optional<std::string> html = fill(read_input(page));
  if (!html) throw Failure(Exit::kUnreadable, page + " is not the page of this version; install again");
  return *html;
}

}  // namespace

std::string page_of_logs(const std::vector<GivenLog>& logs, std::string_view profile) {
  return filled([&](const std::string& page) { return page_with(page, logs, profile); });
}

std::size_t empty_page_size() { return page_of_logs({}).size(); }

std::string page_of_run(std::string_view name, std::string_view stream) {
  return filled([&](const std::string& page) { return page_of_stream(page, name, stream); });
}

}  // namespace fencepost::host::cli
