#include "host/report/top_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/map_axes.hpp"
#include "host/report/map_frame.hpp"
#include "host/report/map_objects.hpp"
#include "host/report/map_path.hpp"
#include "host/report/markup.hpp"
#include "host/report/palette.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

using markup::px;

constexpr double kRightMargin = 16;   ///< px
constexpr double kBottomMargin = 48;  ///< px: tick labels and the axis title

std::string legend_entry(const std::string& layer, const std::string& text, const std::string& sample,
                         bool shown = true) {
  return fmt::format(R"(<input type="checkbox" id="show-{0}"{3}/><label for="show-{0}">)"
                     R"(<svg width="34" height="16" viewBox="0 0 34 16" aria-hidden="true">{2}</svg>{1}</label>)",
                     layer, text, sample, shown ? R"( checked="checked")" : "");
}

std::string model_sample(const std::string& name) {
  const ModelStyle style = model_style(name);
  return fmt::format(
      R"(<rect x="2" y="2" width="30" height="12" rx="{}" fill="#334" fill-opacity="{}" stroke="#334" stroke-width="{}" stroke-dasharray="{}"/>)",
      name.rfind("cylinder", 0) == 0 ? 6 : 0, px(style.fill_opacity), px(style.width),
      style.dash.empty() ? "none" : style.dash);
}

std::string legend(const std::vector<std::string>& models, bool truth) {
  std::string html;
  if (truth) {
    html += legend_entry("truth", "true footprint",
                         R"svg(<rect class="footprint" x="2" y="2" width="30" height="12"/>)svg");
  }
  for (const std::string& name : models) {
    html += legend_entry(markup::slug(name), markup::escaped(name), model_sample(name), model_style(name).shown);
  }
  return html + legend_entry("path", "robot",
                             R"(<path class="track" d="M2 8h30"/><path class="tick" d="M13 3.5L20 8L13 12.5"/>)");
}

std::string outside_note(const MapFrame& f, const ResultDocument& document) {
  const auto outside = std::count_if(document.objects.begin(), document.objects.end(), [&](const ObjectResult& o) {
    const std::optional<Point> at = object_position(o);
    return at && !f.shows(*at);
  });
  if (outside == 0) return {};
  return fmt::format("<p class=\"note\">{} tentative object{} outside the drawing; see the table.</p>", outside,
                     outside == 1 ? " lies" : "s lie");
}

}  // namespace

std::string top_view_rules(const ResultDocument& document, const std::optional<Scene>& truth) {
  std::vector<std::string> layers = {"path"};
  if (truth) layers.emplace_back("truth");
  for (const std::string& name : model_names(document)) layers.push_back(markup::slug(name));
  std::string css;
  for (const std::string& layer : layers) {
    css += fmt::format("#show-{0}:not(:checked)~.figure .layer-{0}{{display:none}}\n", layer);
  }
  return css;
}

std::string top_view(const ResultDocument& document, const std::optional<Scene>& truth) {
  const MapFrame f = fit_map(document, truth);
  std::vector<std::string> models = model_names(document);
  std::string html = "<section><h2>Map</h2><div class=\"map\">" + legend(models, truth.has_value());
  html += fmt::format(
      R"(<div class="figure"><svg id="map" viewBox="0 0 {} {}" role="img" aria-label="Top view of the run">)",
      px(f.left + f.width + kRightMargin), px(f.top + f.height + kBottomMargin));
  html += R"(<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse" )"
          R"svg(patternTransform="rotate(45)"><path d="M0 0v6" stroke="#6b7683" stroke-width="1.6"/></pattern>)svg";
  html += fmt::format(R"(<clipPath id="plot"><rect x="{}" y="{}" width="{}" height="{}"/></clipPath></defs>)",
                      px(f.left), px(f.top), px(f.width), px(f.height));
  html += "\n" + draw_grid(f) + R"svg(<g clip-path="url(#plot)">)svg" + "\n";
  html += draw_origin(f);
  if (truth) html += draw_truth(f, *truth);
  std::stable_sort(models.begin(), models.end(), [](const std::string& a, const std::string& b) {
    return model_style(a).layer < model_style(b).layer;
  });
  for (const std::string& name : models) html += draw_model(f, document, name);
  LabelSpace space({f.left, f.top, f.left + f.width, f.top + f.height});
  const std::string names = draw_labels(f, document, truth, space);  // before the times, which may be left out
  html += draw_path(f, document.path, space) + names + "</g>\n" + draw_scale_bar(f);
  html +=
      "</svg></div></div><p class=\"note\">Arrow heads on the path show where the robot faced. "
      "Tick models above the map to show or hide them.</p>";
  return html + outside_note(f, document) + "</section>\n";
}

}  // namespace fencepost::host
