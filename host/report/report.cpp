#include "host/report/report.hpp"

#include <fmt/format.h>

#include "host/report/accuracy.hpp"
#include "host/report/markup.hpp"
#include "host/report/page_parts.hpp"
#include "host/report/tables.hpp"
#include "host/report/timeline.hpp"
#include "host/report/top_view.hpp"

namespace fencepost::host {
namespace {

std::string section(const char* title, const std::string& content) {
  return fmt::format("<section><h2>{}</h2>\n{}</section>\n", title, content);
}

std::string head(const ResultDocument& document, const std::optional<Scene>& truth, const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\"/>"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/><title>" +
         title + "</title>\n<style>" + std::string(kStylesheet) + top_view_rules(document, truth) +
         "</style></head>\n<body><main>\n";
}

}  // namespace

std::string write_report(const ResultDocument& document, const std::optional<Scene>& truth,
                         const ReportOptions& options) {
  const std::string title = markup::escaped(options.title);
  std::string html = head(document, truth, title);
  html += "<header><h1>" + title + "</h1><p>What the robot's own loop made of this run.</p>";
  if (!options.note.empty()) html += "<p>" + markup::escaped(options.note) + "</p>";
  html += "</header>\n";
  html += headline_figures(document);
  html += top_view(document, truth);
  html += section("Objects", object_rows(document));
  if (truth) html += section("Against the truth", accuracy_table(document, *truth));
  html += section("Alerts", alert_timeline(document) + alert_table(document));
  html += section("Recording", record_counts(document));
  html += "<footer>Written by " + markup::escaped(options.generator) + ". Lengths in metres, map frame.</footer>\n";
  return html + "</main></body></html>\n";
}

}  // namespace fencepost::host
