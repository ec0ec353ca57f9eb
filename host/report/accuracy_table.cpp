#include <fmt/format.h>

#include <algorithm>

#include "host/report/accuracy.hpp"
#include "host/report/markup.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using markup::escaped;
using markup::figure;

std::string head(const std::vector<std::string>& models) {
  std::string html =
      "<thead><tr><th rowspan=\"2\">object</th><th rowspan=\"2\">is</th>"
      "<th rowspan=\"2\" class=\"n\">position error, cm</th>";
  for (const std::string& name : models) html += fmt::format("<th colspan=\"2\" class=\"c\">{}</th>", escaped(name));
  html += "</tr><tr>";
  for (std::size_t i = 0; i < models.size(); ++i) html += "<th class=\"n\">R, %</th><th class=\"n\">P, %</th>";
  return html + "</tr></thead>\n";
}

std::string row(const ObjectAccuracy& accuracy, const Scene& truth, const std::vector<std::string>& models) {
  std::string html = fmt::format("<tr><td>{}</td><td class=\"name\">{}</td><td class=\"n\">{}</td>", accuracy.id,
                                 escaped(truth.objects[accuracy.truth].name),
                                 accuracy.position_error ? figure(*accuracy.position_error * 100, 1) : "\u2013");
  for (const std::string& name : models) {
    const auto model = std::find_if(accuracy.models.begin(), accuracy.models.end(),
                                    [&](const ModelScore& m) { return m.model == name; });
    if (model == accuracy.models.end()) {
      html += "<td class=\"n\">\u2013</td><td class=\"n\">\u2013</td>";
    } else {
      html += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td>", figure(model->score.recklessness * 100, 1),
                          model->score.empty ? "\u2013" : figure(model->score.paranoia * 100, 1));
    }
  }
  return html + "</tr>\n";
}

/// "Not found: ..." and "Without a counterpart: ...".
std::string leftovers(const ResultDocument& document, const Scene& truth, const std::vector<ObjectAccuracy>& all) {
  std::string missing;
  for (std::size_t i = 0; i < truth.objects.size(); ++i) {
    const bool found = std::any_of(all.begin(), all.end(), [&](const auto& a) { return a.truth == i; });
    if (!found) missing += (missing.empty() ? "" : ", ") + escaped(truth.objects[i].name);
  }
  std::string extra;
  for (const ObjectResult& object : document.objects) {
    const bool matched = std::any_of(all.begin(), all.end(), [&](const auto& a) { return a.id == object.id; });
    if (!matched) {
      extra += fmt::format("{}{} {} ({})", extra.empty() ? "" : ", ", object.id,
                           escaped(signature_name(document, object.signature)), record::name(object.state));
    }
  }
  std::string html;
  if (!missing.empty()) html += "<p>True objects that were not found: " + missing + ".</p>\n";
  if (!extra.empty()) html += "<p>Objects without a true counterpart: " + extra + ".</p>\n";
  return html;
}

}  // namespace

std::string accuracy_table(const ResultDocument& document, const Scene& truth) {
  const std::vector<ObjectAccuracy> all = measure_accuracy(document, truth);
  const std::vector<std::string> models = model_names(document);
  std::string html;
  if (!all.empty()) {
    html += "<div class=\"scroll\"><table>" + head(models) + "<tbody>\n";
    for (const ObjectAccuracy& accuracy : all) html += row(accuracy, truth, models);
    html += "</tbody></table></div>\n";
  }
  html += leftovers(document, truth, all);
  return html +
         "<p class=\"note\">R, recklessness: share of the true footprint outside the model. P, paranoia: share "
         "of the model outside the true footprint. 0 is perfect; a model without area has R 100 and no P. "
         "An object means the true one of its signature near which it lies.</p>\n";
}

}  // namespace fencepost::host
